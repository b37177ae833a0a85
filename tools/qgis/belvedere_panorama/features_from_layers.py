"""Features from layers: line and polygon layers as [[features]] of a scene."""
import os
from typing import List

from qgis.core import (
    NULL,
    QgsFeatureRequest,
    QgsProcessingException,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterMultipleLayers,
    QgsProcessingParameterString,
    QgsVectorLayer,
)

from . import compat, kinds, program, scene_file
from .algorithm import Algorithm
from .layers import vector_file

MOST_VALUES = 300  # of a column that are looked at
TUNNEL = "(\"tunnel\" IS NULL OR \"tunnel\" = 'no')"


def shape_of(layer: QgsVectorLayer) -> str:
    """"line", "area" or "point"."""
    kind = layer.geometryType()
    if kind == compat.LINE_GEOMETRY:
        return "line"
    return "point" if kind == compat.POINT_GEOMETRY else "area"


def infer(layer: QgsVectorLayer, fallback: str) -> List[kinds.Kinds]:
    """What the layer holds: by OpenStreetMap columns, other tags, a column of kinds, its name; else
    the fallback."""
    shape, fields = shape_of(layer), layer.fields()

    def values(name: str) -> List[str]:
        found = layer.uniqueValues(fields.lookupField(name), MOST_VALUES)
        return [str(value) for value in found if value != NULL and value != ""]

    out = []
    for name in kinds.TAGS:
        if fields.lookupField(name) >= 0:
            out += kinds.of_column(name, values(name), shape)
    if fields.lookupField("other_tags") >= 0:
        request = QgsFeatureRequest().setLimit(20000)
        texts = (str(feature["other_tags"]) for feature in layer.getFeatures(request))
        out += kinds.of_tags(kinds.tags_of(texts), shape)
    for name in kinds.COLUMNS if not out else ():
        if fields.lookupField(name) >= 0:
            out = out or kinds.of_column(name, values(name), shape)
    if not out:
        kind = kinds.of_name(layer.name(), shape) or fallback
        if not kind:
            raise QgsProcessingException(
                f'Nothing tells what the layer "{layer.name()}" holds. Name the kind (river, road, '
                "lake …), or rename the layer so."
            )
        out = [kinds.Kinds(kind, "", "")]
    return out


def blocks_of(layer: QgsVectorLayer, scene: str, fallback: str):
    """The [[features]] blocks of a layer, and the folder that holds its file."""
    file = vector_file(layer, scene)
    text = ""
    for part in infer(layer, fallback):
        conditions = [sql for sql in (layer.subsetString(), part.where) if sql]
        if shape_of(layer) == "line" and layer.fields().lookupField("tunnel") >= 0:
            conditions.append(TUNNEL)
        given = [f"({sql})" for sql in conditions] if len(conditions) > 1 else conditions
        towns = shape_of(layer) == "point" and layer.fields().lookupField("population") >= 0
        text += scene_file.block("[[features]]", {
            "source": os.path.basename(file.path),
            "layer": file.inside,
            "crs": file.crs,
            "where": " AND ".join(given),
            "kind": part.kind,
            "kind_of": part.column,
            "population_of": "population" if towns else "",
        })
    return text, os.path.dirname(file.path)


class FeaturesFromLayers(Algorithm):
    """A scene with blocks for layers, checked by the program."""

    NAME = "featuresfromlayers"
    TITLE = "Features from layers"
    HELP = (
        "Adds roads, railways, lifts, runs, rivers, lakes, areas and houses to a scene, from "
        "layers of lines, polygons or points.\n"
        "What a layer holds is inferred from its OpenStreetMap columns (highway, waterway, natural "
        "…), from other_tags, from a column such as kind, type or fclass, or from its name. The "
        "log lists what was found, and what the program does with it: drawn, hidden, outside."
    )

    def initAlgorithm(self, _configuration=None) -> None:
        self.add_scene()
        self.addParameter(
            QgsProcessingParameterMultipleLayers("LAYERS", "Layers", compat.ANY_VECTOR)
        )
        self.addParameter(
            QgsProcessingParameterString(
                "KIND", "Kind of layers that do not tell it (river, road, lake …)", optional=True
            )
        )
        self.addParameter(
            QgsProcessingParameterFileDestination("OUTPUT", "Scene with them", "Scene (*.toml)")
        )

    def prepareAlgorithm(self, parameters, context, feedback) -> bool:
        self.out = self.parameterAsFileOutput(parameters, "OUTPUT", context)
        fallback = self.parameterAsString(parameters, "KIND", context)
        self.blocks, self.folders = "", self.data_folders(parameters, context)
        for layer in self.parameterAsLayerList(parameters, "LAYERS", context):
            text, folder = blocks_of(layer, self.out, fallback)
            self.blocks += text
            self.folders.append(folder)
        feedback.pushInfo(self.blocks)
        return True

    def processAlgorithm(self, parameters, context, feedback):
        scene = self.scene_path(parameters, context)
        scene_file.extended(scene, self.out, self.blocks, self.folders)
        words = ["features", "check", self.out]
        for folder in scene_file.data_folders(self.out):
            words += ["--data", folder]
        for source in program.ask(words, feedback)["sources"]:
            feedback.pushInfo(f"{source['file']}: {source['read']} features read")
            for kind in source["kinds"]:
                counts = [f"{kind[name]} {name.replace('_', ' ')}" for name in
                          ("drawn", "hidden", "too_far", "outside_picture", "outside_terrain")
                          if kind[name]]
                feedback.pushInfo(
                    f"  {kind['kind']} {kind['features']}: {', '.join(counts) or 'part of the ground'}"
                )
        return {"OUTPUT": self.out}
