"""Checks of the pages: links and paths, words and spelling."""
import os
import re

import tree

pages = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md", *tree.docs]

# ---- Every relative link, image and #anchor has a target, and so has every path of the repository that the text names as code, such as
# `tools/test`; CHANGELOG.md may name what is gone. docs/index.md links every page of docs, README leads to all, mkdocs.yml lists all.

path = re.compile(r"`((?:base|cmake|data|docs|renderer|scenes|terrain|tests|texture|tools)/[\w/.-]+)`")
link = re.compile(r"!?\[(?:[^\[\]]|\[[^\[\]]*\])*\]\(\s*<?([^()\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)|(?:href|src)=\"([^\"]+)\"")


def prose(text):
    """Lines of a page without code: fenced blocks, and code within a line."""
    fence = ""
    for number, line in enumerate(text.split("\n"), 1):
        mark = re.match(r" {0,3}(```+|~~~+)", line)
        if mark and (not fence or mark.group(1).startswith(fence)):
            fence = "" if fence else mark.group(1)
        elif not fence:
            yield number, line


def slug(title):
    """The anchor that GitHub gives a heading; mkdocs.yml makes the site do the same."""
    title = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", title).replace("`", "").replace("*", "").strip().lower()
    return re.sub(r"[^\w\- ]", "", title).replace(" ", "-")


def anchors_of(text):
    seen, anchors = {}, set(re.findall(r"(?:id|name)=\"([^\"]+)\"", text))
    for _, line in prose(text):
        heading = re.match(r"#{1,6} +(.*?)(?: +#+)?$", line)
        if heading:
            anchor = slug(heading.group(1))
            count = seen[anchor] = seen.get(anchor, -1) + 1
            anchors.add(f"{anchor}-{count}" if count else anchor)
    return anchors


def check_links():
    anchors = {page: anchors_of(tree.text(page)) for page in pages}
    faults, links = [], {page: set() for page in pages}
    for page in pages:
        for number, line in prose(tree.text(page)):
            for name in path.findall(line) if page != "CHANGELOG.md" else ():
                # A unit is named without the extension of its header; NAME and the like are placeholders.
                if not re.search(r"[A-Z]{3}", name) and not any(tree.exists(name + extension) for extension in ("", ".h", ".cpp")):
                    faults.append(f"{page}:{number}: `{name}`: no such file")
            for found in link.finditer(re.sub(r"(?<![`\[])`[^`]+`(?!\])", "", line)):
                target = found.group(1) or found.group(2)
                if re.match(r"[a-z][a-z0-9+.-]*:", target):
                    continue
                name, _, anchor = target.partition("#")
                file = os.path.normpath(os.path.join(tree.folder_of(page), name)) if name else page
                if not tree.exists(file):
                    faults.append(f"{page}:{number}: {target}: no such file")
                    continue
                links[page].add(file)
                if anchor and file in anchors and anchor not in anchors[file]:
                    faults.append(f"{page}:{number}: {target}: {os.path.basename(file)} has no such heading")
    reached, ahead = set(), ["README.md"]
    while ahead:
        page = ahead.pop()
        if page in links and page not in reached:
            reached.add(page)
            ahead += links[page]
    for page in tree.docs:
        name = os.path.basename(page)
        if page != "docs/index.md" and page not in links.get("docs/index.md", ()):
            faults.append(f"docs/index.md: has no link to {name}")
        if page not in reached:
            faults.append(f"README.md: no chain of links leads to {page}")
        if not re.search(rf"[\s:]{re.escape(name)}\s*$", tree.text("mkdocs.yml"), re.MULTILINE):
            faults.append(f"mkdocs.yml: does not list {name}")
    return faults, ""


# ---- Words that docs/glossary.md retired are in no code, message, comment, scene, test or page. One spelling as well: British, as in
# colour, grey, centre, neighbour. CHANGELOG.md and the tables of former names may hold what is gone.

kinds = (".cpp", ".h", ".md", ".toml", ".txt", ".js", ".css", ".html", ".py", ".cmake", ".yml", ".sh", "")
# The only places that may name them.
exempt = re.compile(r"CHANGELOG\.md|docs/glossary\.md|tools/check/pages\.py|former_(keys|options)(_test)?\.(cpp|h)$|\.schema\.json$")
retired = {
    r"\bhang(s|ing)? on\b": "depends on",
    r"\banew\b": "again",
    r"\bmade[- _]up\b(?! of)": "synthetic",
    r"\bMadeUp": "Synthetic",
    r"\b(guess(es|ed|ing)?|Guess(ed)?[A-Z]\w*|guess(es|ed)?_\w+)\b": "inferred, estimate",
    r"\bunlikeness\b": "dissimilarity",
    r"\b(un)?[kK]nit(s|ted|ting|ting)?(_\w+)?\b": "synthesize the seam",
    r"\bin the mean\b": "on average",
    r"\bbeside each other\b": "side by side",
    r"\bwithout end\b": "unbounded",
    r"\b(least|most)_(?!likely|common|squares|used\b)[a-z]\w*": "min_, max_",
    r"\b(?!at_)\w+_(least|most)\b": "_min, _max",
    r"\b(living_of_land|HttpManners|RemoteErrand|GoldenWay|see_mirrored|still_to_make|cost_of_way|find_ways)\b": "the name in CHANGELOG.md",
    r"\bwish(es|ed)?\b": "request",
    r"\bthe likest\b": "the most similar",
}
retired = [(re.compile(pattern), use) for pattern, use in retired.items()]
any_retired = re.compile("|".join(f"(?:{pattern.pattern})" for pattern, _ in retired))
spelling = re.compile(r"[a-zA-Z_]*(?:[cC]olor(?!ado)|[gG]ray|[cC]enter|[nN]eighbor)(?!imetr)[a-zA-Z_]*")
british = {"color": "colour", "gray": "grey", "center": "centre", "neighbor": "neighbour"}
# Names of foreign interfaces, as they are there.
foreign = re.compile(
    r"^(GDAL|cms|GCI|OCIO|OIIO|Pdf|Jxl|OpenColorIO|colorspaces?$)|ColorSpace|ColorEntry|ColorInterp|color_channels|colormap|^Color$"
    r"|DeviceColor|^gray_?$"
)
# Spelling counts in C++ outside strings and comments, and in prose outside code.
string = re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])\'|//.*')
span = re.compile(r"`[^`]*`|\]\([^)]*\)|<[^>]*>|https?://\S+")
unspelled = {".cpp": string, ".h": string, ".md": span}


def faults_of_words(name, text):
    if any_retired.search(text):
        for number, line in enumerate(text.split("\n"), 1):
            for pattern, use in retired if "renamed in version" not in line else ():
                for found in pattern.finditer(line):
                    yield f'{name}:{number}: "{found[0]}": use {use}'
    kind, fenced = os.path.splitext(name)[1], False
    if kind in unspelled and spelling.search(text):
        for number, line in enumerate(text.split("\n"), 1):
            fenced ^= kind == ".md" and line.lstrip().startswith("```")
            for found in () if fenced else spelling.finditer(unspelled[kind].sub("", line)):
                if not foreign.search(found[0]):
                    use = next(b for a, b in british.items() if a in found[0].lower())
                    yield f'{name}:{number}: "{found[0]}": spelled {use}'


def check_words():
    faults = []
    for name in ["README.md", "CONTRIBUTING.md", *sorted(tree.files)]:
        if os.path.splitext(name)[1] in kinds and not exempt.search(name) and (tree.root / name).stat().st_size <= 400_000:
            try:
                faults += faults_of_words(name, tree.text(name))
            except UnicodeDecodeError:
                pass  # a file without text
    return faults, ""
