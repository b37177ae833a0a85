"""Guidance buffers: what each pixel shows, by `belvedere guidance`, without a picture."""
import os

from osgeo import gdal
from qgis.core import (
    QgsProcessingException,
    QgsProcessingOutputFile,
    QgsProcessingParameterBoolean,
    QgsProcessingParameterFolderDestination,
    QgsProcessingParameterString,
)

from . import exr, program
from .algorithm import Algorithm
from .render_panorama import load_picture


def write_tiff(path: str, source: str, channels) -> None:
    """The channels as bands of 32 bits with their names, for QGIS, whose GDAL may read no
    OpenEXR."""
    values = exr.read(source, channels)
    rows, columns = values[channels[0]].shape
    options = ["COMPRESS=DEFLATE", "PREDICTOR=3"]
    file = gdal.GetDriverByName("GTiff").Create(
        path, columns, rows, len(channels), gdal.GDT_Float32, options
    )
    if file is None:
        raise QgsProcessingException(f"{path} cannot be written.")
    for number, name in enumerate(channels, 1):
        band = file.GetRasterBand(number)
        band.SetDescription(name)
        band.WriteArray(values[name].astype("float32"))
    file.FlushCache()


class GuidanceBuffers(Algorithm):
    """guidance.exr, and its channels as bands of a TIFF."""

    NAME = "guidancebuffers"
    TITLE = "Guidance buffers"
    HELP = (
        "Writes guidance.exr: distance, altitude, class, slope, light and some thirty other values "
        "of what each pixel of a panorama shows, without painting it. docs/guidance.md describes "
        "each channel.\n"
        "The chosen channels can also be loaded, as bands of guidance.tif."
    )

    def initAlgorithm(self, _configuration=None) -> None:
        self.add_scene()
        self.add_changes(0)
        self.addParameter(
            QgsProcessingParameterString(
                "CHANNELS", "Channels, such as Z,altitude.V (empty: all)", "", False, True
            )
        )
        self.addParameter(
            QgsProcessingParameterBoolean("LOAD", "Load the named channels as guidance.tif", False)
        )
        self.addParameter(QgsProcessingParameterFolderDestination("OUTPUT", "Folder"))
        self.addOutput(QgsProcessingOutputFile("GUIDANCE", "Guidance buffers"))
        self.addOutput(QgsProcessingOutputFile("TIFF", "Channels as bands"))

    def processAlgorithm(self, parameters, context, feedback):
        folder = self.parameterAsString(parameters, "OUTPUT", context)
        chosen = self.parameterAsString(parameters, "CHANNELS", context)
        channels = [name.strip() for name in chosen.split(",") if name.strip()]
        load = self.parameterAsBool(parameters, "LOAD", context)
        if load and not channels:
            raise QgsProcessingException("Name the channels that are to be loaded: Z,altitude.V")
        words = ["guidance", *self.scene_words(parameters, context), "--out", folder]
        answer = program.ask(
            words + (["--channels", ",".join(channels)] if channels else []), feedback
        )
        results = {"OUTPUT": folder, "GUIDANCE": answer["files"][0]["path"]}
        if load:
            results["TIFF"] = os.path.join(folder, "guidance.tif")
            write_tiff(results["TIFF"], results["GUIDANCE"], channels)
            load_picture(results["TIFF"], answer["scene"] + " guidance", context)
        return results
