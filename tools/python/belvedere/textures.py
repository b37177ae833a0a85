"""Textures as statistics (docs/textures.md)."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from belvedere import _belvedere
from belvedere._error import Error
from belvedere._progress import Progress, run

if TYPE_CHECKING:
    import numpy as np


#: Statistics of pairs of pixels, about a kilobyte: text (TOML), types (of pairs), bytes, save(path).
Model = _belvedere.TextureModel


def load(path: str | os.PathLike[str]) -> Model:
    """Reads a model file."""
    return _belvedere.read_model(os.fspath(path))


def learn(
    crop: np.ndarray, *, mask: np.ndarray | None = None, types: int = 40, levels: int = 3, threads: int = 0,
    progress: Progress = "auto"
) -> Model:
    """Learns a texture from a crop of a painting, as `belvedere texture learn`.

    crop: uint8 (height, width, 3), encoded sRGB, at least 48 px on a side; not copied in C order. mask: uint8
    (height, width), 0 is left out. types: at most, 16…200. levels: of the pyramid, 0…4.
    """
    from belvedere import _arrays

    picture = _arrays.picture(crop, "crop")
    counted = None if mask is None else _arrays.numbers(mask, "mask")
    if counted is not None:
        _arrays.same_size(counted, "mask", picture, "crop")
    if not 16 <= types <= 200:
        raise Error("types", f"{types}", "16 … 200")
    if not 0 <= levels <= 4:
        raise Error("levels", f"{levels}", "0 … 4")
    return _belvedere.learn_texture(picture, counted, types, levels, run(progress, threads))


def make(
    model: Model, width: int, height: int, *, seed: int = 1, threads: int = 0, progress: Progress = "auto"
) -> np.ndarray:
    """Makes a texture of any size in which nothing is copied and nothing repeats.

    width, height: px. Returns uint8 (height, width, 3), encoded sRGB.
    """
    if width < 1 or height < 1:
        raise Error("width, height", f"{width} × {height} px", "1 px or more")
    return _belvedere.make_texture(model, width, height, seed, run(progress, threads))
