"""What the plugin reads of scene files and writes to them. A scene names its files by their names
alone; the folders that hold them stand in a comment, which the program does not read."""
import json
import os
import re
from typing import Dict, Iterable, List, Tuple

MARK = "# data folders: "


def read(path: str) -> str:
    with open(path, encoding="utf-8") as file:
        return file.read()


def write(path: str, text: str) -> None:
    with open(path, "w", encoding="utf-8", newline="\n") as file:
        file.write(text)


def data_folders(path: str) -> List[str]:
    """The folders of the comment of a scene."""
    for line in read(path).splitlines():
        if line.startswith(MARK):
            return json.loads(line[len(MARK) :])
    return []


def with_folders(text: str, scene: str, folders: Iterable[str]) -> str:
    """The text of a scene with the comment for these folders, except the scene's own."""
    own = os.path.dirname(os.path.abspath(scene))
    known = list(dict.fromkeys(os.path.abspath(folder) for folder in folders))
    kept = "\n".join(line for line in text.splitlines() if not line.startswith(MARK))
    others = [folder for folder in known if folder != own]
    comment = f"\n{MARK}{json.dumps(others, ensure_ascii=False)}" if others else ""
    return kept.rstrip("\n") + "\n" + comment + ("\n" if comment else "")


def extended(scene: str, out: str, blocks: str, folders: Iterable[str]) -> None:
    """Writes the scene with further blocks to `out`, where it finds the same files."""
    known = [os.path.dirname(os.path.abspath(scene)), *data_folders(scene), *folders]
    text = with_folders(read(scene), scene, []).rstrip("\n")
    write(out, with_folders(f"{text}\n\n{blocks}", out, known))


def size(path: str) -> Tuple[int, int]:
    """Width and height of the picture, px."""
    values = {"width": 2400, "height": 1100}  # the program's defaults
    inside = False
    for line in read(path).splitlines():
        if line.lstrip().startswith("["):
            inside = line.split("#")[0].strip() == "[output]"
        found = re.match(r"\s*(?:output\.)?(width|height)\s*=\s*(\d+)", line)
        if found and (inside or line.lstrip().startswith("output.")):
            values[found[1]] = int(found[2])
    return values["width"], values["height"]


def block(table: str, values: Dict[str, object]) -> str:
    """A table of a scene; [[…]] makes a further one. Empty values are left out."""
    lines = [f"{key} = {json.dumps(value, ensure_ascii=False)}" for key, value in values.items()
             if value not in (None, "")]
    return "\n".join([table, *lines]) + "\n\n"
