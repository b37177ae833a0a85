"""Examples in README.md, CONTRIBUTING.md and docs/*.md are valid for the program.

  commands   each `belvedere …` is compared with what `belvedere man` prints: command, options, their values, keys of --set;
             each tools/… and scenes/… in a command must exist
  TOML       scenes and parts of scenes are read by `belvedere check`, without data; palettes by `belvedere palette check`; other
             files (legends, rules, styles …) must be valid TOML
  keys       each `table.key` in the text that begins with a table of scenes must be a key
  quick      a block of commands after a line <!-- quick --> is executed in an empty folder; for commands without data, under a second

The program starts in half a second, so all scenes are given to it at once.
"""
import json
import os
import pathlib
import re
import shlex
import subprocess
import tempfile
import tomllib

import tree

press_profile = pathlib.Path("/usr/share/color/icc/ghostscript/default_cmyk.icc")  # of libgs-common
generated = {"docs/scene.md"}  # its one example is checked, its keys are the program's own
# Files other than scenes, by a key that only they have; the first key of a file that is one of these counts.
other_files = {
    "painting's style": ("brushwork", "origin"),
    "palette": ("based_on", "classes"),
    "legend": ("codes", "csv"),
    "class rules": ("terms", "rivers", "parameters"),
    "map source": ("url",),
    "layers": ("inputs", "ground"),
    "regions": ("region",),
    "sheet": ("panel", "panels", "width"),
    "style": ("kind", "kinds", "style"),
    "label style": ("leader", "font"),
    "lock": ("inputs.", "program"),
    "composite": ("label",),
}
other_files = {key: kind for kind, keys in other_files.items() for key in keys}
extensions = "tif png exr jxl ora psd toml csv svg geojson gpkg md json jpg lock js h cpp".split()


# ---- Content of a page


def blocks_of(text):
    """(kind of fence or "", number of the first line, lines, whether it is marked quick); spans of code as ("`", line, [text], False)."""
    lines = text.split("\n")
    i, quick = 0, False
    while i < len(lines):
        line = lines[i]
        mark = re.match(r"( *)(```+)(\w*)", line)
        if mark:
            end = i + 1
            while end < len(lines) and not lines[end].strip().startswith(mark.group(2)):
                end += 1
            yield mark.group(3), i + 2, [inner.removeprefix(mark.group(1)) for inner in lines[i + 1 : end]], quick
            i, quick = end + 1, False
        elif line.startswith("    ") and (i == 0 or not lines[i - 1].strip()):
            end = i
            while end < len(lines) and (lines[end].startswith("    ") or not lines[end].strip()):
                end += 1
            yield "indented", i + 1, [inner[4:] for inner in lines[i:end]], quick
            i, quick = end, False
        else:
            quick = line.strip() == "<!-- quick -->" or (quick and not line.strip())
            for span in re.findall(r"(?<!`)`([^`]+)`(?!`)", line):
                yield "`", i + 1, [span], False
            i += 1


def is_toml(kind, lines):
    first = next((line for line in lines if line.strip() and not line.startswith("#")), "")
    return kind == "toml" or (kind == "indented" and re.match(r"\[\[?[a-z_.]+\]\]?|[a-z_]+ = ", first) is not None)


def shell_words(text):
    """Words of a line of shell, with ; | > and the like as words of their own; comments and explanations are removed."""
    text = re.sub(r"(^|\s)#.*", "", text)
    text = re.sub(r"^(belvedere \w+) +(?=\S*[./])", r"\1 ", text)  # arguments of several lines, one below the other
    text = re.sub(r"(?<=\S) {2,}(?=-)", " ", text)
    text = re.sub(r"(?<=\S) {2,}.*", "", text)
    lexer = shlex.shlex(text, posix=True, punctuation_chars=";|&<>")
    lexer.whitespace_split, lexer.commenters = True, ""
    return list(lexer)


# ---- What the program says of itself


class Program:
    def __init__(self, path):
        self.path = path
        self.commands = {}  # command: {"options": {name: words of its value}, "needs": options that must be given, "arguments": so many}
        self.keys, self.open_tables = set(), set()  # keys of a scene as a.b.c; tables whose keys are the user's own, as land_cover.settings
        status, text = self.run(["man"])
        if status != 0:
            raise SystemExit(f"{path} man: {text}")
        self.read_manual(text.replace("\\-", "-").replace("\\(aq", "'").replace("\\e", "\\"))
        self.read_schema(json.loads(self.run(["schema"])[1]), [])

    def run(self, arguments, folder=None):
        done = subprocess.run([self.path, *arguments], cwd=folder, timeout=60, **output)
        return done.returncode, done.stdout

    def read_manual(self, text):
        for part in re.split(r"^\.SS belvedere ", text, flags=re.MULTILINE)[1:]:
            synopsis = next(line for line in part.split("\n") if line.startswith("\\fBbelvedere "))
            rest = synopsis.split("\\fR", 1)[1].replace("[\\fIOPTION\\fR ...]", "")
            arguments = re.sub(r"\\fB--[\w-]+\\fR( \\fI[^\\]*\\fR)?", "", rest)
            options = {}
            for names, value in re.findall(r"^\.TP\n((?:\\fB--?[\w-]+\\fR(?:, )?)+)(?: \\fI(.*)\\fR)?$", part, flags=re.MULTILINE):
                for option in re.findall(r"\\fB(--?[\w-]+)\\fR", names):
                    options[option] = len(value.split()) if value else 0
            self.commands[part.split("\n", 1)[0].strip()] = {
                "options": options,
                "needs": re.findall(r"\\fB(--[\w-]+)\\fR", re.sub(r"\[[^\]]*\]", "", rest)),
                "arguments": len(re.findall(r"\\fI", re.sub(r"\[[^\]]*\]", "", arguments))),
            }

    def read_schema(self, schema, path):
        for part in schema.get("allOf", []) + schema.get("anyOf", []):
            self.read_schema(part, path)
        if isinstance(schema.get("items"), dict):
            self.read_schema(schema["items"], path)
        for name, inner in schema.get("properties", {}).items():
            self.keys.add(".".join([*path, name]))
            self.read_schema(inner, [*path, name])
        if isinstance(schema.get("additionalProperties"), dict):
            self.open_tables.add(".".join(path))

    def has_key(self, path):
        path = re.sub(r"\.\d+(?=\.|$)", "", path)
        return path in self.keys or any(path.startswith(table + ".") for table in self.open_tables)


output = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True, "errors": "replace"}

# A missing file is the last error that the program reports before it would begin to work.
missing_terrain = '[[terrain.sources]]\nfile = "missing.tif"\n'
missing_points = '[[labels.points]]\nfile = "missing.csv"\n'


class Examples:
    def __init__(self, program):
        self.program = program
        self.faults = set()  # page, line, text
        self.scenes = []  # page, line, what stands before the example, example, settings
        self.counts = {"commands": 0, "TOML": 0, "keys": 0, "quick": 0}

    def fault(self, page, line, text):
        self.faults.add((page, line, text))

    def check_page(self, page):
        tables = {key.split(".")[0] for key in self.program.keys if "." in key}
        for kind, first, lines, quick in blocks_of(tree.text(page)):
            if kind == "`":
                if lines[0].startswith("belvedere "):
                    self.counts["commands"] += 1
                    self.check_commands(page, first, lines, whole=False)
                path = re.match(r"([a-z_]+(?:\.[a-z_0-9]+)+)(?: =.*)?$", lines[0])
                parts = path.group(1).split(".") if path and page not in generated else [""]
                if parts[0] in tables and parts[-1] not in extensions:
                    self.counts["keys"] += 1
                    if not self.program.has_key(path.group(1)):
                        self.fault(page, first, f"a scene has no key {path.group(1)}")
            elif is_toml(kind, lines):
                self.counts["TOML"] += 1
                self.check_toml(page, first, lines)
            elif kind in ("sh", "bash", "console", "indented", ""):
                self.counts["commands"] += sum("belvedere " in line for line in lines)
                self.check_commands(page, first, lines, whole=True)
                if quick:
                    self.counts["quick"] += 1
                    self.run_quick(page, first, lines)

    # ---- TOML

    def check_toml(self, page, first, lines):
        text = "\n".join(lines) + "\n"
        try:
            keys = tomllib.loads(text)
        except tomllib.TOMLDecodeError as error:
            at = re.search(r"at line (\d+)", str(error))
            return self.fault(page, first - 1 + int(at.group(1) if at else 1), f"no TOML: {error}")
        kind = next((other_files[key] for key in keys if key in other_files), "scene")
        if kind == "palette" and press_profile.exists() and "based_on" in keys:
            self.check_palette(page, first, text)
        elif kind == "scene":
            missing = missing_points if "synthetic" in keys.get("terrain", {}) else missing_terrain
            self.scenes.append((page, first, "" if "version" in keys else "version = 1\n", text + missing, []))

    def check_palette(self, page, first, text):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "example.toml").write_text(text, encoding="utf-8")
            status, said = self.program.run(["palette", "check", "example.toml", "--profile", str(press_profile)], folder)
        if status not in (0, 1):
            self.scene_fault(page, first, 0, said.removeprefix("belvedere: ").strip())

    def scene_fault(self, page, first, before, said):
        at = re.search(r"\w+\.toml:(\d+):", said)
        said = re.sub(r"\w+\.toml:[\d:]+ ", "", said).replace("\n  allowed:", "; allowed:").replace("\n", " ")
        self.fault(page, first - 1 + (int(at.group(1)) - before if at else 1), said)

    def check_scenes(self):
        """All at once, by `belvedere verify` and locks with the settings; each ends at the missing file, or at an error before it."""
        with tempfile.TemporaryDirectory() as folder:
            for i, (_, _, before, text, settings) in enumerate(self.scenes):
                (pathlib.Path(folder) / f"example{i}.toml").write_text(before + text, encoding="utf-8")
                lock = f'version = 1\nprogram = ""\nscene = ""\nwidth = 800\nheight = 400\nsettings = {json.dumps(settings)}\n[products]\n'
                (pathlib.Path(folder) / f"example{i}.lock").write_text(lock, encoding="utf-8")
            names = [f"example{i}.toml" for i in range(len(self.scenes))]
            _, said = self.program.run(["verify", *names, "--json", "--quiet"], folder)
        for (page, first, before, _, _), found in zip(self.scenes, json.loads(said)["scenes"], strict=True):
            if found.get("error_status") != 3 or "missing." not in found.get("error", ""):
                self.scene_fault(page, first, before.count("\n"), found.get("error", "no file is missing"))

    # ---- Commands

    def check_commands(self, page, first, lines, whole):
        joined, start = "", first
        for number, line in enumerate(lines, first):
            if not joined:
                start = number
            joined += line.rstrip()
            if joined.endswith("\\"):
                joined = joined[:-1].rstrip() + " "
                continue
            self.check_line(page, start, joined.strip(), whole)
            joined = ""

    def check_line(self, page, line, text, whole):
        if not re.search(r"belvedere|tools/", text):
            return
        try:
            words = shell_words(text)
        except ValueError as error:
            return self.fault(page, line, f"{text}: {error}")
        command = []
        for word in [*words, ";"]:
            if re.fullmatch(r"[;|&]+", word) or (command and word == "belvedere" and command[0] == "belvedere"):
                self.check_command(page, line, command, whole)
                command = [word] if word == "belvedere" else []
            else:
                command.append(word)
                if re.match(r"\S*belvedere \w", word):
                    self.check_line(page, line, word, whole)  # a command in quotes

    def check_command(self, page, line, words, whole):
        words = list(words)
        while words and re.match(r"[A-Z_]+=", words[0]):
            words.pop(0)
        if words and words[0] in ("parallel", "sudo", "time", "nice"):
            words.pop(0)
            whole = False
        if words and words[0].startswith("tools/") and not re.search(r"[*…]", words[0]):
            if not tree.exists(words[0]):
                self.fault(page, line, f"{words[0]}: no such file")
            return
        if not words or not re.fullmatch(r"(\S*/)?belvedere", words[0]) or len(words) == 1:
            return
        redirected = next((i for i, word in enumerate(words) if word in (">", ">>", "<")), len(words))
        words = words[1:redirected]
        if not words or words[0] in ("--help", "--version", "COMMAND", "…"):
            return
        name = words.pop(0)
        subcommands = [full.split()[1] for full in self.program.commands if full.startswith(name + " ")]
        if subcommands:
            if not words or words[0].startswith("-"):
                if whole and not (words and words[0] == "--help"):
                    self.fault(page, line, f"belvedere {name}: no subcommand; there are {', '.join(subcommands)}")
                return
            name += " " + words.pop(0)
        if name not in self.program.commands:
            return self.fault(page, line, f"belvedere {name}: no such command")
        self.check_arguments(page, line, name, words, whole)

    def check_arguments(self, page, line, name, words, whole):
        command = self.program.commands[name]
        given, arguments, settings = set(), 0, []
        elliptic = not whole or any("…" in word for word in words)
        i = 0
        while i < len(words):
            word = words[i]
            i += 1
            if word in ("…", "...") or word.startswith("["):
                elliptic = True
            elif not re.match(r"--?[a-z]", word):
                arguments += 1
                self.check_file(page, line, word)
            else:
                option, _, value = word.partition("=")
                given.add(option)
                if option not in command["options"]:
                    near = [f"; there is {known}" for known in command["options"] if known.startswith(option)]
                    self.fault(page, line, f"belvedere {name}: no option {option}" + "".join(near[:1]))
                    continue
                values = [value] if value else []
                while len(values) < command["options"][option]:
                    if i == len(words) or re.match(r"--?[a-z]", words[i]):
                        if whole:
                            self.fault(page, line, f"belvedere {name}: {option} without its value")
                        break
                    values.append(words[i])
                    i += 1
                if option == "--set":
                    settings += [value for value in values if self.is_setting(page, line, name, value, whole)]
                for value in values:
                    self.check_file(page, line, value)
        if settings:
            self.scenes.append((page, line, "version = 1\n", missing_terrain, settings))
        if elliptic or "--help" in given:
            return
        missing = [option for option in command["needs"] if option not in given]
        if missing:
            self.fault(page, line, f"belvedere {name}: needs {', '.join(missing)}")
        if arguments < command["arguments"]:
            self.fault(page, line, f"belvedere {name}: an argument is missing")

    def is_setting(self, page, line, name, value, whole):
        """Whether the program shall read this value of --set; reports a key that does not exist."""
        key = value.partition("=")[0]
        if key.isupper():
            return False
        if not self.program.has_key(key):
            self.fault(page, line, f"--set {value}: a scene has no key {key}")
        elif whole and "=" not in value:
            self.fault(page, line, f"--set {value}: no value")
        else:
            return whole and "…" not in value and name != "sweep" and not re.search(r"\.\d", key)
        return False

    def check_file(self, page, line, word):
        """Files that come with the program must exist: scenes and their files."""
        shown = re.match(
            r"(?:\.\./)?(scenes/(?:karwendel|oetztal|rainier|zion|demo|masks|legends)[\w/]*\.(?:toml|csv|geojson|png))$", word
        )
        if shown and not tree.exists(shown.group(1)):
            self.fault(page, line, f"{word}: no such file")

    def run_quick(self, page, first, lines):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("scenes", "docs"):
                (pathlib.Path(folder) / name).symlink_to(tree.root / name)
            (pathlib.Path(folder) / "bin").mkdir()
            (pathlib.Path(folder) / "bin/belvedere").symlink_to(self.program.path)
            environment = os.environ | {"PATH": f"{folder}/bin:{os.environ['PATH']}", "BELVEDERE_CACHE": f"{folder}/cache"}
            try:
                command = ["bash", "-euo", "pipefail", "-c", "\n".join(lines)]
                done = subprocess.run(command, cwd=folder, env=environment, timeout=20, **output)
                if done.returncode != 0:
                    self.fault(page, first, f"ends with status {done.returncode}: {done.stdout.strip()[-300:]}")
            except subprocess.TimeoutExpired:
                self.fault(page, first, "is marked as quick and takes more than 20 s")


def check_examples(program=tree.root / "build/release/belvedere"):
    program = pathlib.Path(program).resolve()
    if not program.exists():
        return [f"{program}: no such program; build it with tools/build release belvedere"], ""
    examples = Examples(Program(program))
    for page in ["README.md", "CONTRIBUTING.md", *tree.docs]:
        examples.check_page(page)
    examples.check_scenes()
    said = "Examples: " + ", ".join(f"{count} {what}" for what, count in examples.counts.items())
    wrong = f"; {len(examples.faults)} wrong" if examples.faults else ""
    return [f"{page}:{line}: {text}" for page, line, text in sorted(examples.faults)], said + wrong
