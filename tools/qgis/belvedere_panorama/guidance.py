"""What guidance.exr says about the ground of each pixel, as arrays in the scene's coordinates."""
from typing import Dict, NamedTuple

import numpy as np
from qgis.core import QgsCoordinateReferenceSystem, QgsProcessingException

from . import exr, program


class Camera(NamedTuple):
    """The viewer: position, m; direction and field of view, degrees."""

    projection: str
    east: float
    north: float
    altitude: float
    azimuth: float
    field: float


class Guidance(NamedTuple):
    """Channels of a picture, rows × columns; NaN is sky. East and north in `crs`."""

    camera: Camera
    crs: QgsCoordinateReferenceSystem
    east: np.ndarray
    north: np.ndarray
    distance: np.ndarray
    others: Dict[str, np.ndarray]
    classes: Dict[int, str]


def read(path: str, others, feedback) -> Guidance:
    """Reads a file that the program wrote with the channels Z, P.X and P.Y, and `others`."""
    notes = program.ask(["info", path], feedback)["notes"]
    words = notes["belvedere:camera"].split()
    eye, values = [float(word) for word in words[2:5]], dict(zip(words[5::2], words[6::2]))
    camera = Camera(words[0], *eye, float(values["azimuth"]), float(values["field"]))
    crs = QgsCoordinateReferenceSystem(notes["belvedere:crs"])
    if not crs.isValid():
        raise QgsProcessingException(
            f"The scene is in no coordinate system that QGIS knows ({notes['belvedere:crs']})."
        )
    origin = [float(word) for word in notes["origin"].split()]
    channels = exr.read(path, ["Z", "P.X", "P.Y", *others])
    sky = ~np.isfinite(channels["Z"])
    place = {
        name: np.where(sky, np.nan, channels[name].astype(float) + origin[i])
        for i, name in enumerate(("P.X", "P.Y"))
    }
    legend = [line.split() for line in notes["legend"].splitlines()]
    return Guidance(
        camera,
        crs,
        place["P.X"],
        place["P.Y"],
        np.where(sky, np.nan, channels["Z"]),
        {name: channels[name] for name in others},
        {int(words[0]): words[1] for words in legend},
    )
