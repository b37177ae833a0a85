"""Guidance buffers: what each pixel of a picture shows."""

from __future__ import annotations

import functools
import os
from typing import TYPE_CHECKING, Any, Iterator, Mapping, NamedTuple, Sequence, Union

from belvedere import _belvedere
from belvedere._error import Error
from belvedere._progress import Progress, run

if TYPE_CHECKING:
    import numpy as np

    Numbers = Union[float, "np.ndarray"]


class Channel(NamedTuple):
    """unit: "" if it has none. nodata: the value of the sky. file_names: in guidance.exr, one for each
    number of a pixel."""

    name: str
    unit: str
    meaning: str
    nodata: float | int | tuple[float, ...]
    file_names: tuple[str, ...]


class _Row(NamedTuple):
    channel: Channel
    of_paintings: bool  # example paintings alone have it


@functools.cache
def _rows() -> dict[str, _Row]:
    rows: dict[str, _Row] = {}
    for names, unit, meaning, sky, is_id, of_paintings in _belvedere.channel_rows():
        # "altitude.V" is altitude, "N.X" … are N.
        stem, _, last = names[0].partition(".")
        name = stem if len(names) > 1 or last in ("V", "A") else names[0]
        name = names[0] if name in rows else name
        nodata = tuple(sky) if len(sky) > 1 else int(sky[0]) if is_id else sky[0]
        rows[name] = _Row(Channel(name, unit, meaning, nodata, tuple(names)), of_paintings)
    return rows


def channels() -> dict[str, Channel]:
    """All channels of guidance by name, as docs/guidance.md has them."""
    return {name: row.channel for name, row in _rows().items()}


def _named(name: str) -> Channel:
    for row in _rows().values():
        if name == row.channel.name or name in row.channel.file_names:
            return row.channel
    known = ", ".join(name for name, row in _rows().items() if not row.of_paintings)
    raise Error("channels", f'"{name}" is not a channel of guidance', known)


def first_names(names: Sequence[str] | None) -> list[str]:
    """For the module _belvedere; None: all that a picture has."""
    if names is None:
        return [row.channel.file_names[0] for row in _rows().values() if not row.of_paintings]
    if isinstance(names, str):
        names = names.split(",")
    asked = [_named(name) for name in names]
    for channel in asked:
        if _rows()[channel.name].of_paintings:
            raise Error("channels", f'"{channel.name}" exists in example paintings only', "one of a picture")
    return [channel.file_names[0] for channel in asked]


class Guidance(Mapping):
    """What each pixel of a picture shows: a mapping of NumPy arrays by the names of channels ("Z",
    "altitude", "N", "landcover.id").

    float32, or whole numbers of ids; (height, width), or (height, width, 2 or 3) of vectors. Values are in
    full precision; guidance.exr has some of them as half floats.
    """

    def __init__(self, arrays: dict[str, np.ndarray], origin_m: tuple, view: Any) -> None:
        self._arrays = {_named(name).name: array for name, array in arrays.items()}
        self._view = view
        #: East, north and up that the channel P is relative to, m of the scene's CRS.
        self.origin_m: tuple[float, float, float] = origin_m

    @classmethod
    def read(cls, path: str | os.PathLike[str], *, progress: Progress = "auto") -> Guidance:
        """Reads guidance.exr. Directions are unit vectors again; lonlat and pixel are not known."""
        return cls(*_belvedere.read_guidance(os.fspath(path), run(progress)))

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width, px."""
        return next(iter(self._arrays.values())).shape[:2] if self._arrays else (0, 0)

    @property
    def channels(self) -> dict[str, Channel]:
        """Unit, meaning and nodata of each channel, by name."""
        return {name: _named(name) for name in self._arrays}

    @property
    def crs(self) -> str:
        """The scene's coordinate system, WKT; empty where there is none."""
        return self._view.crs if self._view is not None else ""

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __len__(self) -> int:
        return len(self._arrays)

    def __contains__(self, name: object) -> bool:
        return name in self._arrays

    def get(self, name: str, default: Any = None) -> Any:
        return self._arrays.get(name, default)

    def __getitem__(self, name: str) -> np.ndarray:
        channel = _named(name)
        if channel.name not in self._arrays:
            raise Error("guidance", f'"{name}" was not asked for', ", ".join(self._arrays))
        return self._arrays[channel.name]

    def __repr__(self) -> str:
        height, width = self.shape
        return f"<belvedere.Guidance {width} × {height} px: {', '.join(self._arrays)}>"

    def lonlat(self, x_px: Numbers, y_px: Numbers, crs: str | None = "EPSG:4326") -> tuple[Numbers, Numbers]:
        """The ground that pixels show, NaN in the sky: longitude and latitude, degrees, or coordinates of
        another crs; None: metres of the scene.

        x_px, y_px: to the right and down from the outer corner of the first pixel; numbers or arrays.
        """
        return self._located("to_ground", x_px, y_px, crs)[:2]

    def altitude_m(self, x_px: Numbers, y_px: Numbers) -> Numbers:
        """Altitude above the datum of the ground that pixels show, m; NaN in the sky."""
        return self._located("to_ground", x_px, y_px, None)[2]

    def pixel(self, lon: Numbers, lat: Numbers, crs: str | None = "EPSG:4326") -> tuple[Numbers, Numbers]:
        """Where ground is drawn: x and y, px, also outside the picture and behind mountains; NaN outside
        the terrain. lon, lat: degrees, or coordinates of another crs; None: metres of the scene."""
        return self._located("to_pixels", lon, lat, crs)[:2]

    def visible(self, lon: Numbers, lat: Numbers, crs: str | None = "EPSG:4326") -> Any:
        """Whether ground is in the picture and not hidden, as pixel: bool."""
        import numpy as np

        seen = np.asarray(self._located("to_pixels", lon, lat, crs)[2]) > 0
        return seen if seen.ndim else bool(seen)

    def _located(self, how: str, x: Numbers, y: Numbers, crs: str | None) -> tuple:
        import numpy as np

        if self._view is None:
            found = "the view is not known: it was read from a file, or its terrain is larger than memory"
            raise Error("guidance", found, "the guidance that scene.guidance() makes")
        if crs and not self._view.crs:
            raise Error("terrain.crs", "the terrain has no coordinate system", "crs=None: metres of the scene", 3)
        x, y = np.broadcast_arrays(np.asarray(x, np.float64), np.asarray(y, np.float64))
        points = np.stack([x.ravel(), y.ravel()], axis=1)
        found = getattr(self._view, how)(points, crs or "")
        return tuple(column.reshape(x.shape) if x.ndim else float(column[0]) for column in found.T)

    def to_xarray(self) -> Any:
        """An xarray.Dataset with dimensions y, x and (for vectors) a number, unit and meaning of each."""
        import xarray

        variables = {}
        for name, array in self._arrays.items():
            channel = _named(name)
            dimensions = ("y", "x", f"{name}.number")[: array.ndim]
            attributes = {"units": channel.unit, "long_name": channel.meaning, "nodata": channel.nodata}
            variables[name] = xarray.Variable(dimensions, array, attributes)
        return xarray.Dataset(variables, attrs={"origin_m": self.origin_m})
