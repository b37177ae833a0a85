"""Elevation models in memory."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Sequence

from belvedere import _belvedere
from belvedere._error import Error
from belvedere._progress import Progress, run

if TYPE_CHECKING:
    import numpy as np


def generalize_presets() -> dict[str, str]:
    """Names of presets with their meaning."""
    return _belvedere.generalize_presets()


def _cell(cell_m: Any) -> tuple[float, float]:
    from belvedere._arrays import pair

    cell = pair(cell_m, "cell_m")
    if not all(0 < side < 1e7 for side in cell):
        raise Error("cell_m", f"is {cell_m}", "width and height of a cell on the ground, m")
    return cell


def generalize(
    altitude_m: np.ndarray, cell_m: float | tuple[float, float], *, preset: str = "", weights: Sequence[float] = (),
    ridges: Sequence[float] = (), valleys: Sequence[float] = (), background_weights: Sequence[float] = (),
    background_ridges: Sequence[float] = (), background_valleys: Sequence[float] = (), base: float = 1.0,
    viewer: tuple[float, float] | None = None, distances: tuple[float, float] | None = None, mask: np.ndarray | None = None,
    mask_slope: tuple[float, float] | None = None, automatic_mask: bool = False, change_lakes: bool = False,
    curvature: str = "bounded", full_curvature: float = 0.0, blur_cells: float = 1.0, exponent: float = 1.0, destripe: bool = False,
    line_integral: bool = False, widen_valleys_m: float = 0.0, threads: int = 0, progress: Progress = "auto"
) -> np.ndarray:
    """Simplifies landforms and keeps ridges sharp, as `belvedere generalize` (docs/generalization.md).

    altitude_m: (height, width), m, the first row in the north; NaN is a void and stays one. Not copied if
    it is float32 in C order. cell_m: side of a cell on the ground, m, or width and height. preset: of
    generalize_presets(). weights: of the bands, the largest landforms first, 0…5: 1 keeps, 0 removes, more
    exaggerates. ridges, valleys: added along break lines, -5…5. background_…: the same far from the
    viewer. viewer: east and north of the lower left corner, m. distances: between which the background
    begins, m. mask: (height, width), 0 unchanged … 1 generalized. mask_slope: degrees, unchanged up to the
    first, generalized from the second. full_curvature: .001…10. blur_cells: 0…10. exponent: 0…4.
    Returns float32 (height, width), m.
    """
    options = dict(locals())
    from belvedere._arrays import altitudes, pair, same_size

    cells = altitudes(altitude_m)
    drawn = None if mask is None else altitudes(mask, "mask")
    if drawn is not None:
        same_size(drawn, "mask", cells, "altitude_m")
    if preset and preset not in generalize_presets():
        raise Error("preset", f'"{preset}" is not a preset', ", ".join(generalize_presets()))
    if curvature not in ("bounded", "plan"):
        raise Error("curvature", f'"{curvature}"', "bounded, plan")

    for name, given in (("viewer", viewer), ("distances", distances), ("mask_slope", mask_slope)):
        options[name] = [] if given is None else list(pair(given, name))
    return _belvedere.generalize(cells, _cell(cell_m), options, drawn, run(progress, threads))


def deform(
    altitude_m: np.ndarray, cell_m: float | tuple[float, float], viewer: tuple[float, float] = (0.0, 0.0), *, raster: bool = False,
    threads: int = 0, progress: Progress = "auto", **keys: Any
) -> np.ndarray:
    """Raises and bends the ground as for a picture (docs/deformation.md).

    altitude_m: (height, width), m, the first row in the north; voids (NaN) are filled. Not copied if it is
    float32 in C order. cell_m: side of a cell, m, or width and height. viewer: east and north of the lower
    left corner, m. keys: those of a scene's [deform], exaggeration=1.5, bend={"radius_m": 90000,
    "crest_m": 50000}, handles=[{…}]. Returns where the centres of the cells lie, east, north and up of
    the lower left corner at altitude 0, m: float32 (height, width, 3). With raster: heights on the cells of
    altitude_m, m, NaN where there is no ground: float32 (height, width).
    """
    from belvedere._arrays import altitudes, pair
    from belvedere._scene import _toml

    settings = [f"deform.{key}={_toml(value, key)}" for key, value in keys.items()]
    place = pair(viewer, "viewer")
    return _belvedere.deform(altitudes(altitude_m), _cell(cell_m), place, settings, raster, run(progress, threads))
