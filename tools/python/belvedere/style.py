"""Styles of paintings (docs/style.md)."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Union

from belvedere import _belvedere
from belvedere._progress import Progress, run

if TYPE_CHECKING:
    import numpy as np

    FileOrArray = Union[str, "os.PathLike[str]", "np.ndarray"]


#: The look of a painting as numbers: text (TOML), name, notes (what was derived and from what), save(path) for scene["style"] = path.
Style = _belvedere.Style


def load(name_or_path: str | os.PathLike[str]) -> Style:
    """A built-in style by its name, "segantini", or a style file."""
    return _belvedere.read_style(os.fspath(name_or_path))


def fit(
    painting: FileOrArray, *, classes: FileOrArray | None = None, name: str = "", origin: str = "", licence: str = "",
    threads: int = 0, progress: Progress = "auto"
) -> Style:
    """Fits the style of a landscape painting, as `belvedere style fit`.

    painting: a file (PNG, TIFF, JPEG), or uint8 (height, width, 3), encoded sRGB; at least 500 px wide.
    classes: a mask of class numbers, a file or uint8 (height, width): 200 for distant ranges in haze colour,
    255 for unused pixels; default: inferred.
    """
    import numpy as np

    from belvedere import _arrays

    file = os.fspath(painting) if _arrays.is_path(painting) else ""
    mask_file = os.fspath(classes) if _arrays.is_path(classes) else ""
    picture = None if file else np.divide(_arrays.picture(painting, "painting"), np.float32(255))
    mask = None if classes is None or mask_file else _arrays.numbers(classes, "classes")
    name = name or os.path.splitext(os.path.basename(file))[0] or "painting"
    return _belvedere.fit_style(picture, file, mask, mask_file, name, origin, licence, run(progress, threads))
