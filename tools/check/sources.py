"""Checks of the sources: layers, random draws, names and headers."""
import collections
import concurrent.futures
import os
import re
import subprocess

import tree

# Folder: folders below it that its files may include, besides itself. Top folders stand for all their subfolders. A folder without a row is
# an error, so that a new folder is assigned to a layer before it gets files.
below = {
    "base": "",
    "terrain/io": "base",
    "terrain/shape": "base terrain/io",
    "terrain/climate": "base terrain/io terrain/shape",
    "terrain/cover": "base terrain/io terrain/shape terrain/climate",
    "terrain/fetch": "base terrain/io",
    "terrain/generalize": "base terrain/io terrain/shape",
    "terrain/deform": "base terrain/io terrain/shape",
    "terrain/register": "base terrain/io terrain/deform",
    "terrain/synthetic": "base terrain/io terrain/shape",
    "terrain/layers": "base terrain/io terrain/shape terrain/climate terrain/cover",
    "texture/synthesis": "base",
    "texture/quality": "base texture/synthesis",
    "texture/segment": "base",
    "texture/sheet": "base texture/synthesis",
    "texture/statistical": "base texture/synthesis",
    "texture/composite": "base texture/synthesis texture/statistical",
    "texture/strokes": "base",
    "renderer/image": "base texture/synthesis",
    "renderer/trace": "base terrain",
    "renderer/paint": "base terrain/io terrain/deform texture renderer/image renderer/trace",
    "renderer/mist": "base terrain texture/strokes renderer/trace renderer/paint",
    "renderer/features": "base terrain texture/strokes renderer/trace renderer/paint",
    "renderer/compose": "base terrain renderer/trace",
    "renderer/rock": "base renderer/trace renderer/paint",
    "renderer/close": "base renderer/trace renderer/paint renderer/rock",
    "renderer/style": "base terrain texture renderer/image renderer/trace renderer/paint",
    "renderer/scene": "base terrain texture/synthesis renderer/image renderer/trace renderer/paint renderer/mist renderer/features",
    "renderer/ground": "base terrain renderer/image renderer/trace renderer/features renderer/scene",
    "renderer/world":
        "base terrain texture renderer/image renderer/trace renderer/paint renderer/style renderer/mist renderer/features renderer/rock "
        "renderer/compose renderer/scene renderer/ground",
    "renderer/register": "base terrain texture/synthesis renderer/trace renderer/image renderer/scene renderer/world renderer/exemplar",
    "renderer/labels": "base terrain renderer/trace renderer/image",
    "renderer/press": "base renderer/image renderer/paint",
    "renderer/graph": "base renderer/trace",
    "renderer/stages":
        "base terrain texture renderer/image renderer/trace renderer/paint renderer/style renderer/mist renderer/features renderer/close "
        "renderer/rock renderer/scene renderer/ground renderer/world renderer/graph",
    "renderer/exemplar":
        "base terrain texture renderer/image renderer/trace renderer/paint renderer/rock renderer/scene renderer/ground renderer/world "
        "renderer/stages",
    "renderer/sheet": "base terrain texture renderer/image renderer/trace renderer/paint renderer/scene renderer/graph",
    "renderer/pipeline":
        "base terrain texture renderer/image renderer/trace renderer/paint renderer/mist renderer/features renderer/compose renderer/rock "
        "renderer/style renderer/scene renderer/ground renderer/world renderer/labels renderer/press renderer/graph renderer/stages "
        "renderer/exemplar renderer/sheet",
    "renderer/live":
        "base terrain renderer/image renderer/trace renderer/paint renderer/scene renderer/world renderer/labels renderer/graph "
        "renderer/stages renderer/sheet renderer/pipeline",
    "tools/options": "base",
    "tools/report": "base terrain texture renderer",
    "tools/web": "base terrain texture renderer",
    "tools/studio": "base terrain renderer tools/report tools/web",
    "tools/pick": "base terrain renderer tools/report tools/studio tools/web",
    "tools/cli": "base terrain texture renderer tools/options tools/pick tools/report tools/studio tools/web",
    "tools/python": "base terrain texture renderer tools/cli",
    "tools": "base tools/cli",
    "tools/bench": "base terrain texture renderer tools/options",
    "tools/lab": "base terrain texture renderer tools/options",
    "tools/fuzz": "base terrain texture renderer",
    "tests": " ".join(tree.tops),
}
below = {folder: allowed.split() for folder, allowed in below.items()}

# Third-party header, as the beginning of its name: the files that may include it, because its types must not leave them. A name that ends
# with "/" is a folder, if a library needs more than one file; its headers that include the library are private to it. A library without a
# row is an error. Several entries: Embree for the benchmark that measures it bare; Highway, which compiles a file several times, for the inner loops
# that benefit. "anywhere": libraries of basic values in all layers.
homes = {
    r"glm/": ["anywhere"],
    r"fmt/": ["*.cpp"],
    r"(fcntl|unistd|xmmintrin)\.h|sys/": ["*.cpp"],  # the system's and the processor's
    r"tbb/": ["base/parallel.cpp", "renderer/image/provenance.cpp"],
    r"toml\+\+/": ["base/config.cpp"],
    r"gdal|ogr_|cpl_": ["terrain/io/gdal/"],
    r"hwy/": [
        *("terrain/generalize/generalize_rows.cpp", "texture/synthesis/synth_kernel.cpp", "renderer/paint/picture_filter.cpp"),
        *("renderer/rock/spur_peaks.cpp", "terrain/cover/rule_expression_run.cpp", "base/lines/"),
    ],
    r"iconv|glib\.h": ["base/text/text_encoding.cpp"],
    r"lbfgs": ["terrain/layers/fit/fit_functions.cpp"],
    r"embree[34]/": ["renderer/trace/embree.h"],
    r"OpenImageIO/": ["renderer/image/oiio_file.cpp"],
    r"dlfcn": ["renderer/image/oiio_late.cpp", "tools/python/module.cpp"],
    r"pybind11/": ["tools/python/"],
    r"OpenEXR/|Imath/|Imf|Iex|half\.h": ["renderer/image/exr/"],
    r"tiff": ["renderer/image/tiff_file.cpp"],
    r"libdeflate": ["renderer/image/deflate.cpp"],
    r"png\.h|libpng": ["renderer/image/png_palette.cpp", "renderer/image/layers/layer_png.cpp"],
    r"jxl/": ["renderer/image/jxl_file.cpp"],
    r"pango/|fontconfig/": ["renderer/labels/text_measure.cpp"],
    r"qpdf/": ["renderer/press/print_pdf.cpp"],
    r"librsvg/": ["renderer/press/page_plan.cpp"],
    # Paints names onto pictures; librsvg draws PDF pages with it.
    r"cairo": ["renderer/labels/sheet_painter.cpp", "renderer/press/page_plan.cpp"],
    r"OpenColorIO/": ["renderer/image/display_conversion.cpp"],
    r"lcms2": ["renderer/image/icc/", "terrain/layers/fit/fit_measures.cpp"],  # the latter for how far colours lie apart
    r"malloc\.h": ["base/memory/zeroed_memory.cpp"],
    r"xxhash": ["base/cache/content_hash.cpp"],
    r"CLI/": ["tools/options/options.cpp"],
    r"benchmark/": ["tools/bench/"],
    r"httplib": ["tools/studio/http_server.cpp"],
    r"nlohmann/": ["tools/studio/http_server.cpp"],
}

# Functions of the C library that are not rounded the same way everywhere: base/math_exact.h has them with the same bits on every machine.
# Reports and tests may call the library's; a picture must not depend on it (tools/test_hard libm verifies it for renderings).
inexact = re.compile(r"std::(?:a?(?:sin|cos|tan)h?|atan2|exp2?|expm1|log(?:2|10|1p)?|pow|cbrt|hypot)\(")
inexact_in = ("base", "terrain", "texture", "renderer")


# ---- The layers of docs/architecture.md: includes, what comments cite, files of a folder


def room_of(name):
    """The folder that has a row in `below`; None outside of the project."""
    parts = name.split("/")
    if parts[0] not in tree.tops:
        return None
    return parts[0] if parts[0] in ("base", "tests") or len(parts) < 3 else "/".join(parts[:2])


def may_include(room, target):
    return target == room or any(target == b or target.startswith(b + "/") for b in below.get(room, []))


def at_home(name, allowed):
    """Whether the file is one of those named, or lies in a folder named."""
    return any(
        a in ("anywhere", name) or (a.endswith("/") and name.startswith(a)) or (a == "*.cpp" and name.endswith(".cpp")) for a in allowed
    )


def circles(edges):
    """Sets of nodes that reach each other (Tarjan)."""
    index, low, stack, found = {}, {}, [], []

    def visit(node):
        index[node] = low[node] = len(index)
        stack.append(node)
        for to in edges.get(node, ()):
            if to not in index:
                visit(to)
                low[node] = min(low[node], low[to])
            elif to in stack:
                low[node] = min(low[node], index[to])
        if low[node] == index[node]:
            group = []
            while not group or group[-1] != node:
                group.append(stack.pop())
            if len(group) > 1:
                found.append(sorted(group))

    for node in sorted(edges):
        if node not in index:
            visit(node)
    return found


class Layers:
    def __init__(self):
        self.units = collections.defaultdict(set)  # unit: units that it includes
        self.rooms = collections.defaultdict(set)
        self.private = {}  # header that shows a foreign library: the folder that may include it

    def faults_of_text(self, name):
        """(line, fault) of documents that a source cites and of functions that it calls."""
        for number, line in enumerate(tree.text(name).splitlines(), 1):
            code, _, comment = line.partition("//")
            for document in re.findall(r"[\w./-]+\.md\b", comment):
                if not tree.exists(document):
                    yield number, f"{document} is cited and not in the repository"
            library = inexact.search(code)
            if library and name.startswith(inexact_in):
                yield number, f"{library.group(0)[:-1]} differs between machines: use base/math_exact.h"

    def faults_of_includes(self, name, room):
        for number, mark, header in tree.includes(name):
            if mark == '"':
                target = room_of(header)
                if target is None:
                    yield number, f'"{header}" is not named from the project\'s root'
                elif not may_include(room, target):
                    yield number, f"{room} may not include {target}"
                elif room != "tests" and tree.unit_of(header) != tree.unit_of(name):
                    self.units[tree.unit_of(name)].add(tree.unit_of(header))
                    if target != room:
                        self.rooms[room].add(target)
            elif room != "tests" and ("." in header or "/" in header):  # names of the C++ library have neither
                allowed = next((allowed for pattern, allowed in homes.items() if re.match(pattern, header)), None)
                if allowed is None:
                    yield number, f"<{header}> has no row in tools/check/sources.py"
                elif not at_home(name, allowed):
                    yield number, f"<{header}> may be included only in {', '.join(allowed)}"
                elif name.endswith(".h") and name not in allowed and "anywhere" not in allowed:
                    self.private[name] = next(a for a in allowed if name.startswith(a))


def check_includes():
    page = tree.text("docs/architecture.md")
    faults = [
        f"docs/architecture.md: {room} has no row in the table of folders"
        for room in below
        if f"`{room}" not in page and room not in tree.tops
    ]
    sources = tree.sources((".h", ".cpp"))
    layers = Layers()
    for name in sources:
        room = room_of(name)
        if room not in below:
            faults.append(f"{name}: the folder {room} has no row in tools/check/sources.py")
            continue
        found = sorted([*layers.faults_of_text(name), *layers.faults_of_includes(name, room)], key=lambda fault: fault[0])
        faults += [f"{name}:{number}: {fault}" for number, fault in found]
    for name in sources:
        for number, _, header in tree.includes(name) if room_of(name) in below else ():
            home = layers.private.get(header, "")
            if not name.startswith(home):
                faults.append(f'{name}:{number}: "{header}" is private to {home}, the only one that uses its library')
    for group in circles(layers.units) + circles(layers.rooms):
        faults.append("these include each other in a circle: " + ", ".join(group))
    folders = set(map(tree.folder_of, sources))
    return faults, f"{len(sources)} files in {len(folders)} folders, {len(faults)} errors"


# ---- One random draw per statement: the order of evaluation of a call's arguments is unspecified in C++, so two draws in one call give
# different pictures with gcc and clang. Statements that make only one of their draws (a ? b : c; a && b) are allowed.

draw = re.compile(r"\b\w*(?:seed|draw|draws)\.(?:between|normal|uniform)\s*\(")


def double_draws(text):
    """Statements with two draws, and the line that each begins in."""
    text = re.sub(r"//[^\n]*", "", text)
    at = 0
    for statement in re.split(r"[;{}]", text):
        if len(draw.findall(statement)) > 1 and not re.search(r"\?|&&|\|\|", statement):
            yield text.count("\n", 0, at + len(statement) - len(statement.lstrip())) + 1, " ".join(statement.split())
        at += len(statement) + 1


def check_draws():
    # Self-test, so that a change of the pattern does not disable the check.
    assert list(double_draws("f(seed.between(1, 2), 0.1F * seed.normal());"))
    assert not list(double_draws("a = b ? seed.normal() : seed.uniform();"))
    files = tree.sources(".cpp", ("base", "terrain", "texture", "renderer"))
    faults = [
        f"{file}:{line}: two draws in one statement: {statement[:120]}"
        for file in files
        for line, statement in double_draws(tree.text(file))
    ]
    return faults, f"{len(files)} files, {len(faults)} statements with two draws"


# ---- Unique names in each folder. Several files of a folder are compiled together (cmake/batches.cmake), so a name in an anonymous
# namespace must not be defined again by another file of the folder: no constant, type, alias, test, or function with the same parameters.
# This relies on clang-format: the content of a namespace begins in the first column, and nothing else does but its end.

raw_string = re.compile(r'\bR"(\w*)\(.*?\)\1"', re.S)
comment = re.compile(r"(?<![:\"])//[^\n]*")
first_column = re.compile(r"^(?:[A-Za-z_]|\[\[|\}  // namespace)", re.M)
token = re.compile(r"\w+|::|\[\[.*?\]\]|\"(?:\\.|[^\"\\])*\"|'(?:\\.|[^'\\])+'|->|&&|\S", re.S)
type_of = re.compile(r"(?:struct|class|union|enum(?: class| struct)?) (\w+)(?: final)?\s*[:{;]")
closing = {"(": ")", "{": "}", "[": "]", "<": ">"}
enumerators = {}  # of enum classes in headers, by name
Named = collections.namedtuple("Named", "scope name kind what anonymous line")


def read_enumerators():
    """Names of the values of each enum class in a header, for using enum."""
    for header in tree.sources(".h"):
        if "enum class" in tree.text(header):
            for match in re.finditer(r"enum class (\w+)[^{;]*\{([^}]*)\}", comment.sub("", tree.text(header))):
                enumerators[match.group(1)] = re.findall(r"(\w+)\s*(?:=[^,]*)?(?:,|$)", match.group(2).strip())


def after_brackets(tokens, at):
    """The position after the bracket that closes the one at `at`."""
    depth, opens, closes = 0, tokens[at], closing[tokens[at]]
    for i in range(at, len(tokens)):
        depth += (tokens[i] == opens) - (tokens[i] == closes)
        if depth == 0:
            return i + 1
    return len(tokens)


def parameters_of(tokens):
    """Types of parameters, without names, and how many have no default."""
    types, now, depth, default, needed = [], [], 0, False, 0
    for t in tokens + [","]:
        if t == "," and depth == 0:
            named = len(now) > 1 and re.match(r"[A-Za-z_]\w*$", now[-1]) and now[-2] != "::" and not set(now[:-1]) <= {"const"}
            if now:
                types.append(" ".join(now[:-1] if named else now))
                needed = needed if default else len(types)
            now, default = [], False
            continue
        depth += (t in "([{<") - (t in ")]}>")
        default = default or (t == "=" and depth == 0)
        if not default:
            now.append(t)
    return tuple(types), needed


def same_call(a, b):
    """Whether a call of functions with such parameters may be ambiguous."""
    return any(a[0][:n] == b[0][:n] for n in range(max(a[1], b[1]), min(len(a[0]), len(b[0])) + 1))


def declared(text):
    """Name, kind and distinguishing parameters of each name that a declaration at the beginning of the text defines."""
    if match := re.match(r"TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", text):
        yield ".".join(match.groups()), "test", ""
    elif match := re.match(r"MATCHER\w*\((\w+)", text):
        yield match.group(1), "matcher", ""
    elif match := re.match(r"using (\w+)\s*=\s*([^;]*);", text):
        yield match.group(1), "alias", match.group(2)
    elif match := re.match(r"using ((?:::)?(?:\w+::)+(\w+));", text):
        yield match.group(2), "using", match.group(1).removeprefix("::")
    elif match := re.match(r"using enum (?:\w+::)*(\w+);", text):
        for name in enumerators.get(match.group(1), ()):
            yield name, "using", f"{match.group(1)}::{name}"
    elif re.match(r"using |static_assert|extern |template\b|requires\b|[A-Z_0-9]+\(", text):
        return
    elif match := type_of.match(text):
        yield match.group(1), "type", ""
    else:
        yield from functions_and_constants(token.findall(text))


def functions_and_constants(tokens):
    name, at = "", 0
    while at < len(tokens):
        t = tokens[at]
        if t == "operator":
            to = at + 1
            while tokens[to] != "(" or to == at + 1:
                to += 1
            name, at = "operator" + "".join(tokens[at + 1 : to]), to
        elif t in ("decltype", "alignas", "requires", "noexcept"):
            at = after_brackets(tokens, at + 1)
        elif t == "<":
            at = after_brackets(tokens, at)
        elif t == "(":
            end = after_brackets(tokens, at)
            if tokens[at - 2] == "::":
                return  # a member
            inside = tokens[at + 1 : end - 1]
            if not inside or not (inside[0][0] in "\"'-" or inside[0][0].isdigit() or inside[1:2] in (["("], ["."])):
                yield name, "function", parameters_of(inside)
                return
            yield name, "constant", ""  # its value
            at = end
        elif t in ("=", "{", "[", ";"):
            if tokens[at - 2] != "::":
                yield name, "constant", ""
            # Others may stand behind it: constexpr int width = 3, height = 4;
            while at < len(tokens) and tokens[at] not in (",", ";"):
                at = after_brackets(tokens, at) if tokens[at] in ("(", "{", "[") else at + 1
            if at >= len(tokens) or tokens[at] == ";":
                return
            at += 1
        else:
            name = t if re.match(r"[A-Za-z_]", t) else name
            at += 1


def names_of(text):
    """The names that a file defines in its namespaces."""
    if 'R"' in text:
        text = raw_string.sub(lambda m: '""' + "\n" * m.group(0).count("\n"), text)
    text = comment.sub(lambda m: m.group(0) if m.group(0).startswith("// namespace") else "", text)
    scopes, line, counted = [], 1, 0
    for match in first_column.finditer(text):
        at = match.start()
        if text[at] == "}":
            scopes.pop()
            continue
        head = text[at : text.find("\n", at)]
        if space := re.match(r"namespace ?([\w:]*) \{$", head):
            scopes.append(space.group(1))
            continue
        if head.startswith("namespace ") or not scopes:
            continue
        # A declaration ends before the next thing in the first column; its head, template <…>, stands on lines of its own.
        end = re.compile(r"^\S", re.M).search(text, text.find("\n", at) + 1)
        declaration = text[at : end.start() if end else len(text)]
        line += text.count("\n", counted, at)
        counted = at
        anonymous = "" in scopes or declaration.startswith("static ")
        for name, kind, what in declared(declaration):
            yield Named("::".join(s for s in scopes if s), name, kind, what, anonymous, line)


def clash(a, b):
    """Whether two files that define these cannot be compiled together."""
    if not (a.anonymous or b.anonymous):
        return False
    kinds = {a.kind, b.kind}
    if kinds == {"function"}:
        return same_call(a.what, b.what)
    if len(kinds) == 1 and kinds <= {"using", "alias"}:
        return a.what != b.what  # the same for the same thing may be said twice
    if kinds == {"using", "function"}:
        # An overload, except for enumerators: using LandCoverClass::rock;
        return bool(re.search(r"(?:^|::)[A-Z]\w*::\w+$", a.what if a.kind == "using" else b.what))
    return True


def defined_twice(files):
    """Names defined twice in files of one folder: pairs of (file, name)."""
    by_name = collections.defaultdict(list)
    for file, text in files:
        for named in names_of(text):
            by_name[named.scope, named.name].append((file, named))
    for group in by_name.values():
        seen = set()
        for i, (file, named) in enumerate(group):
            first = next((o for o in group[:i] if o[0] != file and clash(o[1], named)), None)
            if first and file not in seen:
                seen.add(file)
                yield first, (file, named)


def test_names():
    """Self-test, so that a change of the patterns does not disable the check."""

    def found(a, b):
        frame = "namespace belvedere {\nnamespace {\n%s\n}  // namespace\n}  // namespace belvedere\n"
        return [pair[1][1].name for pair in defined_twice([("a", frame % a), ("b", frame % b)])]

    enumerators["Cover"] = ["wood", "rock"]
    assert found("constexpr double cell_m = 3;", "const double cell_m{4};") == ["cell_m"]
    assert found("struct Lake {\n  int a;\n};", "using Lake = int;") == ["Lake"]
    assert found("int f(int a, const X& b = {}) {\n  return 1;\n}", "int f(int,\n      const X& c) {\n  return 2;\n}") == ["f"]
    assert found("int f(int a) {\n}", "int f(int a, int b = 1) {\n}") == ["f"]
    assert found("template <class T>\nvoid f(T a) {\n}", "template <typename T>\nvoid f(T b) {\n}") == ["f"]
    assert found("using LandCoverClass::rock;", "const int a = 1, rock = 2;") == ["rock"]
    assert found("using enum Cover;", "int rock(int a) {\n}") == ["rock"]
    assert not found("using testing::Not;\nint f(int a) {\n}", "using testing::Not;\nint f(double a) {\n}")


def check_names():
    test_names()
    read_enumerators()
    batches = collections.defaultdict(list)  # as in cmake/batches.cmake
    for name in tree.sources(".cpp"):
        if "hwy/foreach_target.h" not in tree.text(name):  # compiled alone
            batches[re.match(r"(tests/)?[a-z]+(/[a-z_]+/)?", name).group(0)].append((name, tree.text(name)))
    faults = []
    for batch in sorted(batches):
        for (file, named), (again, other) in defined_twice(batches[batch]):
            of = f"({', '.join(other.what[0])})" if other.kind == "function" else ""
            of = re.sub(r" ?(::|[<>(,&*]) ?", r"\1", of)
            faults.append(f"{again}:{other.line}: the {other.kind} {other.name}{of} is also defined in its folder by {file}:{named.line}")
    count = sum(map(len, batches.values()))
    return faults, f"{count} files in {len(batches)} folders, {len(faults)} names defined twice"


# ---- Headers: every unit that includes one parses all lines that it reads. The compiler counts foreign ones, which takes some seconds.

max_lines = 96_000  # vector and string are 19,000; with functional, optional, map, variant, memory: 48,000


def lines_of(foreign):
    """Number of lines that the compiler reads for these headers together."""
    flags = ["-I/usr/include/gdal"] if any(header.startswith(("gdal", "ogr", "cpl")) for header in foreign) else []
    done = subprocess.run(
        [os.environ.get("CXX", "g++"), "-std=c++20", *flags, "-E", "-P", "-x", "c++", "-"],
        # Of two versions of a library one is there.
        input="".join(f"#if __has_include(<{header}>)\n#include <{header}>\n#endif\n" for header in sorted(foreign)),
        capture_output=True,
        text=True,
    )
    if done.returncode != 0:
        raise SystemExit(done.stderr)
    return done.stdout.count("\n")


def check_headers(header=None):
    # Those of tools/python need Python's own headers, which are there only where the package is built.
    headers = [name for name in tree.sources(".h", tree.layers) if not name.startswith("tools/python/")]

    def reached(name, seen):
        if name not in seen and name in known:
            seen.add(name)
            for _, mark, included in tree.includes(name):
                if mark == '"':
                    reached(included, seen)
        return seen

    known = set(headers)
    ours = {name: reached(name, set()) for name in headers}
    foreign = {name: frozenset(h for n in ours[name] for _, mark, h in tree.includes(n) if mark == "<") for name in headers}
    own = {name: sum(tree.text(n).count("\n") for n in ours[name]) for name in headers}
    if header is not None:
        if header not in known:
            return [f"{header} is not a header of {', '.join(tree.layers)}"], ""
        size = f"{header}: {lines_of(foreign[header]) + own[header]:,} lines, {own[header]:,} of them the project's"
        return [], "\n".join([size, *sorted(ours[header] - {header}), *(f"<{h}>" for h in sorted(foreign[header]))])
    # A header that includes a subset of another's headers cannot be larger: only those that include most are measured.
    largest = [s for s in set(foreign.values()) if not any(s < other for other in foreign.values())]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        measured = dict(zip(largest, pool.map(lines_of, largest)))
    sizes = sorted(((measured[foreign[h]] + own[h], h) for h in headers if foreign[h] in measured), reverse=True)
    faults = [
        f"{name}: the compiler reads {lines:,} lines for it, at most {max_lines:,}: python3 tools/check headers {name} lists them; forward "
        "declarations, and moving includes to the .cpp, save most"
        for lines, name in sizes
        if lines > max_lines
    ]
    return faults, f"{len(headers)} headers; the largest: " + ", ".join(f"{h} {lines // 1000}k lines" for lines, h in sizes[:3])
