"""Guidance buffers: what each pixel shows, by `belvedere guidance`, without a picture; and reading
them for other algorithms."""
import os
from typing import Dict, Iterable, NamedTuple

import numpy as np
from osgeo import gdal
from qgis import core

from . import exr, program
from .algorithm import Algorithm, Error, parameter, scene, words


class Guidance(NamedTuple):
    """Channels of a picture, rows × columns, and its camera. East and north are in `crs`, NaN is
    sky; direction and field of view in degrees."""

    crs: core.QgsCoordinateReferenceSystem
    east: np.ndarray
    north: np.ndarray
    others: Dict[str, np.ndarray]
    classes: Dict[int, str]
    projection: str
    eye: np.ndarray
    azimuth: float
    field: float


def read(path: str, others: Iterable[str], feedback) -> Guidance:
    """Reads P.X, P.Y and `others` of a guidance.exr."""
    notes = program.ask(["info", path], feedback)["notes"]
    projection, _, *values = notes["belvedere:camera"].split()
    crs = core.QgsCoordinateReferenceSystem(notes["belvedere:crs"])
    if not crs.isValid():
        raise Error(f"QGIS does not know the scene's coordinate system, {notes['belvedere:crs']}.")
    channels = exr.read(path, ["Z", "P.X", "P.Y", *others])
    sky = ~np.isfinite(channels["Z"])
    places = [np.where(sky, np.nan, channels[name].astype(float) + float(origin))
              for name, origin in zip(("P.X", "P.Y"), notes["origin"].split())]
    legend = (line.split() for line in notes["legend"].splitlines())
    return Guidance(crs, *places, channels, {int(line[0]): line[1] for line in legend},
                    projection, np.array(values[:3], float), float(values[4]), float(values[8]))


def load_picture(path: str, name: str, context: core.QgsProcessingContext) -> None:
    """Loads a picture, which has no place on the map, after the run."""
    layer = core.QgsRasterLayer(path, name)
    if not layer.isValid():
        raise Error(f"{path}: QGIS cannot show this picture.")
    context.temporaryLayerStore().addMapLayer(layer)
    details = core.QgsProcessingContext.LayerDetails(name, context.project(), name)
    context.addLayerToLoadOnCompletion(layer.id(), details)


def write_tiff(path: str, source: str, channels) -> None:
    """The channels as bands of 32 bits with their names."""
    values = exr.read(source, channels)
    height, width = values[channels[0]].shape
    file = gdal.GetDriverByName("GTiff").Create(
        path, width, height, len(channels), gdal.GDT_Float32, ["COMPRESS=DEFLATE", "PREDICTOR=3"])
    for i, name in enumerate(channels, 1):
        file.GetRasterBand(i).SetDescription(name)
        file.GetRasterBand(i).WriteArray(values[name].astype("float32"))
    file.FlushCache()


class GuidanceBuffers(Algorithm):
    """guidance.exr, and its channels as bands of a TIFF."""

    NAME, TITLE = "guidancebuffers", "Guidance buffers"
    HELP = (
        "Writes guidance.exr: distance, altitude, class, slope, light and some thirty other values "
        "of what each pixel of a panorama shows. The named channels can also be loaded.")

    def declare(self):
        self.addOutput(core.QgsProcessingOutputFile("GUIDANCE", "Guidance buffers"))
        return [
            *scene(0),
            words("CHANNELS", "Channels, such as Z,altitude.V (empty: all)"),
            parameter("Boolean", "LOAD", "Load the named channels as guidance.tif", False),
            parameter("FolderDestination", "OUTPUT", "Folder")]

    def work(self, feedback):
        folder, channels = self.text("OUTPUT"), self.text("CHANNELS").replace(" ", "")
        if self.yes("LOAD") and not channels:
            raise Error("Name the channels that are to be loaded, such as Z,altitude.V.")
        asked = ["guidance", *self.scene_words(), "--out", folder]
        answer = program.ask(asked + (["--channels", channels] if channels else []), feedback)
        results = {"OUTPUT": folder, "GUIDANCE": answer["files"][0]["path"]}
        if self.yes("LOAD"):
            tiff = os.path.join(folder, "guidance.tif")
            write_tiff(tiff, results["GUIDANCE"], channels.split(","))
            load_picture(tiff, answer["scene"] + " guidance", self.context)
        return results
