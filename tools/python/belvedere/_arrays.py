"""Arrays as the module _belvedere reads them: without a copy where type and order are the same."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from belvedere._error import Error


def _taken(array: Any, dtype: type, name: str, shape: str, numbers: int) -> np.ndarray:
    given = np.asarray(array)
    wanted = f"an array of {np.dtype(dtype)}, shape {shape}"
    if given.dtype == object:
        raise Error(name, "is not an array of numbers", wanted)
    if given.ndim != (3 if numbers else 2) or given.size == 0 or (numbers and given.shape[2] != numbers):
        raise Error(name, f"has the shape {given.shape}", wanted)
    fits = given.dtype.kind in "fiu" if dtype is np.float32 else given.dtype in (np.uint8, np.bool_)
    if not fits:
        raise Error(name, f"has numbers of the type {given.dtype}", wanted)
    return np.require(given, dtype, ["C", "A"])


def altitudes(array: Any, name: str = "altitude_m") -> np.ndarray:
    """float32 (height, width), m; cells that are masked or not finite are NaN."""
    if isinstance(array, np.ma.MaskedArray):
        array = array.astype(np.float32).filled(np.nan)
    cells = _taken(array, np.float32, name, "(height, width)", 0)
    endless = np.isinf(cells)
    return np.where(endless, np.float32(np.nan), cells) if endless.any() else cells


def picture(array: Any, name: str) -> np.ndarray:
    """uint8 (height, width, 3), encoded sRGB."""
    return _taken(array, np.uint8, name, "(height, width, 3)", 3)


def numbers(array: Any, name: str) -> np.ndarray:
    """uint8 (height, width)."""
    return _taken(array, np.uint8, name, "(height, width)", 0)


def same_size(array: np.ndarray, name: str, other: np.ndarray, of: str) -> None:
    if array.shape[:2] != other.shape[:2]:
        height, width = other.shape[:2]
        found = f"has {array.shape[1]} × {array.shape[0]} values"
        raise Error(name, found, f"{width} × {height}, as {of}")


def is_path(given: Any) -> bool:
    return isinstance(given, (str, os.PathLike))


def pair(given: Any, name: str) -> tuple[float, float]:
    """Two numbers, or one for both."""
    try:
        values = [float(value) for value in given] if np.ndim(given) else 2 * [float(given)]
    except (TypeError, ValueError):
        values = []
    if len(values) != 2:
        raise Error(name, f"is {given!r}", "a number, or two")
    return values[0], values[1]
