"""Render panorama: the picture of a scene by `belvedere render`, and where its pixels lie."""
import os

import numpy as np
from qgis.core import (
    QgsFeature,
    QgsFields,
    QgsGeometry,
    QgsPointXY,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingOutputFile,
    QgsProcessingParameterBoolean,
    QgsProcessingParameterFeatureSink,
    QgsProcessingParameterFolderDestination,
    QgsProcessingParameterNumber,
    QgsRasterLayer,
)

from . import compat, guidance, program
from .algorithm import Algorithm

PICTURES = ("panorama.tif", "panorama.png")  # that QGIS shows
INDEX_CHANNELS = ["altitude.V", "landcover.id"]


def load_picture(path: str, name: str, context: QgsProcessingContext) -> None:
    """Loads a picture, which has no place on the map, after the run."""
    layer = QgsRasterLayer(path, name)
    if not layer.isValid():
        raise QgsProcessingException(f"{path}: QGIS cannot show this picture.")
    context.temporaryLayerStore().addMapLayer(layer)
    details = QgsProcessingContext.LayerDetails(name, context.project(), name)
    context.addLayerToLoadOnCompletion(layer.id(), details)


class RenderPanorama(Algorithm):
    """The picture, and on request a point on the ground for every n-th pixel."""

    NAME = "renderpanorama"
    TITLE = "Render panorama"
    HELP = (
        "Renders a scene. The folder gets panorama.tif, .png and .exr (or the formats of the "
        "scene) and guidance.exr, which states what each pixel shows.\n"
        "<i>Index of pixels</i> is a layer of points: the ground that every n-th pixel shows, with "
        "column and row in the picture (from its upper left pixel, which is 0, 0), distance, "
        "altitude and class. On the map it leads from a place to its pixel and back.\n"
        "A draft has a third of the pixels per side and takes seconds. If the run is cancelled, "
        "the program is ended."
    )

    def initAlgorithm(self, _configuration=None) -> None:
        self.add_scene()
        self.add_changes(0)
        self.addParameter(QgsProcessingParameterBoolean("DRAFT", "Draft", False))
        self.addParameter(QgsProcessingParameterBoolean("LOAD", "Load the picture", True))
        self.addParameter(
            QgsProcessingParameterNumber(
                "STEP", "Index of pixels: every n-th", compat.INTEGER, 8, False, 1, 1000
            )
        )
        self.addParameter(QgsProcessingParameterFolderDestination("OUTPUT", "Folder"))
        index = QgsProcessingParameterFeatureSink(
            "INDEX", "Index of pixels", compat.POINTS, None, True, False
        )
        self.addParameter(index)
        self.addOutput(QgsProcessingOutputFile("PANORAMA", "Picture"))
        self.addOutput(QgsProcessingOutputFile("GUIDANCE", "Guidance buffers"))

    def processAlgorithm(self, parameters, context, feedback):
        folder = self.parameterAsString(parameters, "OUTPUT", context)
        words = ["render", *self.scene_words(parameters, context), "--out", folder]
        draft = self.parameterAsBool(parameters, "DRAFT", context)
        answer = program.ask(words + (["--draft"] if draft else []), feedback)
        files = {os.path.basename(file["path"]): file["path"] for file in answer["files"]}
        results = {"OUTPUT": folder, "GUIDANCE": files.get("guidance.exr")}
        shown = [files[name] for name in PICTURES if name in files]
        if shown:
            results["PANORAMA"] = shown[0]
            if self.parameterAsBool(parameters, "LOAD", context):
                load_picture(shown[0], answer["scene"], context)
        if parameters.get("INDEX"):
            results["INDEX"] = self._write_index(files["guidance.exr"], parameters, context,
                                                 feedback)
        return results

    def _write_index(self, path: str, parameters, context, feedback) -> str:
        ground = guidance.read(path, INDEX_CHANNELS, feedback)
        fields = QgsFields()
        for name, kind in (("column", "integer"), ("row", "integer"), ("distance_m", "number"),
                           ("altitude_m", "number"), ("class", "text")):
            fields.append(compat.field(name, kind))
        sink, layer = self.parameterAsSink(
            parameters, "INDEX", context, fields, compat.WKB_POINT, ground.crs
        )
        step = self.parameterAsInt(parameters, "STEP", context)
        # The middle of each square of pixels, so that all sides are treated alike.
        rows, columns = np.nonzero(np.isfinite(ground.distance[step // 2 :: step,
                                                               step // 2 :: step]))
        for row, column in zip(rows * step + step // 2, columns * step + step // 2):
            if feedback.isCanceled():
                break
            feature = QgsFeature(fields)
            feature.setGeometry(QgsGeometry.fromPointXY(
                QgsPointXY(ground.east[row, column], ground.north[row, column])
            ))
            feature.setAttributes([
                int(column), int(row), round(float(ground.distance[row, column]), 1),
                round(float(ground.others["altitude.V"][row, column]), 1),
                ground.classes[int(ground.others["landcover.id"][row, column])],
            ])
            sink.addFeature(feature, compat.FAST_INSERT)
        feedback.pushInfo(f"index of pixels: {len(rows)} points")
        return layer
