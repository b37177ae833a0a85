"""The checkout as all checks read it: its folders are walked once, and each text is read once."""
import functools
import os
import pathlib
import re

root = pathlib.Path(__file__).resolve().parents[2]
layers = ("base", "terrain", "texture", "renderer", "tools")
tops = (*layers, "tests")


def walk():
    """Files of the repository by their names from its root, by folder. Not from git, which a machine that only builds need not have."""
    for top in (*tops, "docs", "scenes", "data"):
        found = []
        for folder, inside, names in os.walk(root / top):
            inside[:] = set(inside) - {"node_modules", "__pycache__"}
            found += [os.path.relpath(os.path.join(folder, name), root) for name in names]
        yield from sorted(found, key=lambda name: name.split("/"))


files = list(walk())
docs = [name for name in files if re.fullmatch(r"docs/[^/]+\.md", name)]


def sources(ending, of=tops):
    """Sources whose names end so, in these top folders."""
    return [name for name in files if name.endswith(ending) and name.split("/")[0] in of]


def unit_of(name):
    """What a header and its source have in common: the name without its ending."""
    return name.rpartition(".")[0]


def folder_of(name):
    return name.rpartition("/")[0]


def exists(name):
    return (root / name).exists()


@functools.cache
def text(name):
    return (root / name).read_text(encoding="utf-8")


@functools.cache
def includes(name):
    """Line, bracket or quotation mark, and header of each include of a source."""
    found = re.finditer(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"\n]+)[>"]', text(name), re.M)
    return [(text(name).count("\n", 0, match.start()) + 1, *match.groups()) for match in found]
