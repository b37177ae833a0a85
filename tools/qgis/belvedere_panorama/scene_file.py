"""What the plugin reads of scene files and writes to them. A scene names its files by their names
alone; the folders that hold them stand in a comment, which the program does not read."""
import json
import os
import re
from pathlib import Path
from typing import Iterable, List, Tuple

MARK = "# data folders: "


def data_folders(path: str) -> List[str]:
    """The folders of the comment of a scene."""
    lines = Path(path).read_text(encoding="utf-8").splitlines()
    return next((json.loads(line[len(MARK):]) for line in lines if line.startswith(MARK)), [])


def extend(scene: str, out: str, blocks: str, folders: Iterable[str]) -> None:
    """Writes the scene with further blocks to `out`, with a comment for the folders of its files,
    so that it finds the same files from there."""
    own, known = (os.path.dirname(os.path.abspath(path)) for path in (out, scene))
    others = dict.fromkeys([known, *data_folders(scene), *map(os.path.abspath, folders)])
    text = Path(scene).read_text(encoding="utf-8")
    kept = "\n".join(line for line in text.splitlines() if not line.startswith(MARK)).rstrip("\n")
    comment = json.dumps([name for name in others if name != own], ensure_ascii=False)
    end = f"{MARK}{comment}\n" if comment != "[]" else ""
    Path(out).write_text(f"{kept}\n\n{blocks}{end}", encoding="utf-8")


def size(path: str) -> Tuple[int, int]:
    """Width and height of the picture, px."""
    values = {"width": 2400, "height": 1100}  # the program's defaults
    text = Path(path).read_text(encoding="utf-8")
    table = re.search(r"^\[output\]([^\[]*(?:\n(?!\s*\[)[^\n]*)*)", text, re.MULTILINE)
    for name, value in re.findall(r"^\s*(width|height)\s*=\s*(\d+)", table[1] if table else "",
                                  re.MULTILINE):
        values[name] = int(value)
    return values["width"], values["height"]


def block(table: str, **values: object) -> str:
    """A table of a scene; [[…]] makes a further one. Empty values are left out."""
    lines = [f"{key} = {json.dumps(value, ensure_ascii=False)}\n"
             for key, value in values.items() if value != ""]
    return f"{table}\n{''.join(lines)}\n"
