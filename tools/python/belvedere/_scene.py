"""Scenes: what a panorama shows and how it looks."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any, Iterator, Mapping, MutableMapping, Sequence, Union

from belvedere import _belvedere
from belvedere._error import Error
from belvedere._guidance import Guidance, first_names
from belvedere._progress import Progress, run

if TYPE_CHECKING:
    import numpy as np

Path = Union[str, "os.PathLike[str]"]


def _toml(value: Any, key: str) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, str)) and not hasattr(value, "tolist"):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, float):
        return repr(float(value))
    if hasattr(value, "tolist"):  # NumPy's
        return _toml(value.tolist(), key)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(element, key) for element in value) + "]"
    if isinstance(value, Mapping):
        inside = (f"{json.dumps(str(name))} = {_toml(element, key)}" for name, element in value.items())
        return "{ " + ", ".join(inside) + " }"
    if isinstance(value, os.PathLike):
        return _toml(os.fspath(value), key)
    raise Error(key, f"has a value of the type {type(value).__name__}", "a number, a text, a bool, a list or a dict")


def _paths(paths: Path | Sequence[Path]) -> list[str]:
    if isinstance(paths, (str, os.PathLike)):
        paths = [paths]
    return [os.fspath(path) for path in paths]


class Scene(MutableMapping):
    """A panorama: terrain, view, light and look.

    A scene is used like a dictionary of its keys ("sun.azimuth_deg", see docs/scene.md); each value is
    checked when it is set, with the messages of `belvedere --set`. Lengths are metres of the scene's
    coordinate system, angles degrees. Parameters of all methods that take long: threads, 0 for all;
    memory_mib, 0 for three quarters of the machine's; cache, whether slow products are kept for the
    next run; progress, see docs/python.md.
    """

    def __init__(self, scene: _belvedere.SceneText) -> None:
        self._scene = scene

    @classmethod
    def load(cls, path: Path, *, data: Path | Sequence[Path] = (), set: Mapping[str, Any] = {}) -> Scene:
        """Reads a scene file. data: folders with its files, searched after its own; set: values."""
        file = os.fspath(path)
        _belvedere.check_toml(file)  # for its messages
        with open(file, encoding="utf-8", newline="") as text:
            return cls.parse(text.read(), name=file, folder=os.path.dirname(file), data=data, set=set)

    @classmethod
    def parse(
        cls, text: str, *, name: str = "scene.toml", folder: Path = "", data: Path | Sequence[Path] = (), set: Mapping[str, Any] = {}
    ) -> Scene:
        """A scene from the text of a file, whose other files are searched in the folder."""
        scene = cls(_belvedere.SceneText(text, name, os.fspath(folder), _paths(data)))
        if set:
            scene.update(set)
        return scene

    @classmethod
    def demo(cls, *, set: Mapping[str, Any] = {}) -> Scene:
        """The built-in demo, which needs no data."""
        return cls.parse(_belvedere.demo_text(), name="demo.toml", folder=".", set=set)

    @property
    def text(self) -> str:
        """The scene as TOML, comments included."""
        return self._scene.text

    @property
    def name(self) -> str:
        """The name of its file without extension."""
        return self._scene.name

    def save(self, path: Path) -> None:
        """Writes the text to a file."""
        _belvedere.save_text(path, self.text)

    def copy(self) -> Scene:
        """A scene of its own with the same values."""
        return Scene(self._scene.copy())

    def to_dict(self) -> dict[str, Any]:
        """All values in effect, defaults included, in the order of docs/scene.md."""
        return {key: json.loads(value) for key, value in self._scene.values()}

    def __iter__(self) -> Iterator[str]:
        return iter([key for key, _ in self._scene.values()])

    def __len__(self) -> int:
        return len(self._scene.values())

    def __contains__(self, key: object) -> bool:
        return key in list(self)

    def __getitem__(self, key: str) -> Any:
        values = dict(self._scene.values())
        if key not in values:
            hint = _belvedere.nearest_word_hint(key, list(values))
            raise Error(key, f"has no value in this scene{hint}", "a key of docs/scene.md that is set or has a default")
        return json.loads(values[key])

    def get(self, key: str, default: Any = None) -> Any:
        return self[key] if key in self else default

    def __setitem__(self, key: str, value: Any) -> None:
        self.update({key: value})

    def update(self, values: Mapping[str, Any]) -> None:
        """Sets several keys at once, or none of them where one is refused."""
        self._scene.set([(key, _toml(value, key)) for key, value in values.items()])

    def __delitem__(self, key: str) -> None:
        self._scene.remove(key)

    def __repr__(self) -> str:
        return f"<belvedere.Scene {self.name}, {self['output.width']} × {self['output.height']} px>"

    def draw(
        self, width: int = 1000, *, threads: int = 0, memory_mib: int = 0, cache: bool = True, progress: Progress = "auto"
    ) -> np.ndarray:
        """The picture in memory, without files: uint8 (height, width, 3), encoded sRGB.

        width: 64…16384 px; the height follows in proportion. The pixels are those of panorama.png of
        render at that output.width. What pictures of one scene share is made once.
        """
        if not 64 <= width <= 16384:
            raise Error("width", f"{width} px", "64 … 16384 px; render makes sheets of any size")
        return self._scene.draw(width, run(progress, threads, memory_mib, cache))

    def render(
        self, out: Path, *, draft: bool = False, part: tuple[int, int, int, int] | None = None, match: bool = False,
        layers: Sequence[str] = (), channels: str = "", resume: bool = False, force: bool = False, threads: int = 0,
        memory_mib: int = 0, cache: bool = True, progress: Progress = "auto"
    ) -> list[str]:
        """Writes the panorama and guidance.exr into a folder; returns the paths of the files.

        part: x, y, width, height on the sheet, px. layers: of "ora", "psd", "exr". channels: of
        guidance.exr, "Z,landcover.id", or "none" for no file. The others are those of `belvedere render`.
        """
        folder = os.fspath(out)
        names = self._scene.render(
            folder, draft, part, match, list(layers), channels, resume, force, run(progress, threads, memory_mib, cache)
        )
        return [path for path in (os.path.join(folder, name) for name in names) if os.path.exists(path)]

    def guidance(
        self, *, width: int | None = None, channels: Sequence[str] | None = None, threads: int = 0, memory_mib: int = 0,
        cache: bool = True, progress: Progress = "auto"
    ) -> Guidance:
        """What each pixel shows, without painting.

        width: px; default: the scene's. channels: names as in belvedere.channels(); default: all that a
        picture has, about 170 bytes per pixel.
        """
        width = self["output.width"] if width is None else width
        if width < 16:
            raise Error("width", f"{width} px", "16 px or more")
        request = run(progress, threads, memory_mib, cache)
        return Guidance(*self._scene.guidance(width, first_names(channels), request))


def new(
    dem: Path | Sequence[Path], *, towards: str | float | None = None, from_: tuple[float, float] | None = None,
    include: Sequence[str] = (), format: str = "2:1", style: str = "", plain: bool = False, land_cover: Path = "", legend: str = "",
    crs: str = "", title: str = "", out: Path | None = None, progress: Progress = "auto"
) -> Scene:
    """A scene of a region with the best view that its elevation offers; nothing is written.

    dem: one or more elevation files. towards: "south", "NE" or an azimuth in degrees, clockwise from
    north. from_: longitude and latitude of the viewer, degrees. include: places that must be seen,
    "name|lon,lat". format: "2:1", "A2", "cylinder" … out: where the scene will be saved, beside which it
    finds its files; default: beside the first elevation file. The others are options of `belvedere new`.
    """
    options = dict(locals())
    files = _paths(dem)
    if not files:
        raise Error("dem", "no file is named", "an elevation file, or several")
    name = os.path.splitext(files[0])[0] + ".toml" if out is None else os.fspath(out)
    data = list(dict.fromkeys(os.path.dirname(os.path.abspath(file)) for file in files))
    options.update({"out": name, "data": data, "include": list(include), "land_cover": os.fspath(land_cover)})
    options["towards"] = "" if towards is None else str(towards)
    options["from"] = "" if from_ is None else f"{from_[0]},{from_[1]}"
    text = _belvedere.new_scene(files, options, run(progress))
    return Scene.parse(text, name=name, folder=os.path.dirname(name), data=data)
