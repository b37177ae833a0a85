"""Features from layers: line and polygon layers as [[features]] of a scene."""
import os
from typing import List

from qgis import core

from . import compat, kinds, program, scene_file
from .algorithm import Algorithm, Error, parameter, scene, scene_out, words
from .layers import vector_file

MOST_VALUES, MOST_FEATURES = 300, 20000  # of a column and of a layer that are looked at
NO_TUNNEL = "(\"tunnel\" IS NULL OR \"tunnel\" = 'no')"
COUNTS = ("drawn", "hidden", "too_far", "outside_picture", "outside_terrain")


def shape_of(layer: core.QgsVectorLayer) -> str:
    """"line", "area" or "point"."""
    known = {compat.LINE_GEOMETRY: "line", compat.POINT_GEOMETRY: "point"}
    return known.get(layer.geometryType(), "area")


def infer(layer: core.QgsVectorLayer, fallback: str) -> List[kinds.Kinds]:
    """What the layer holds: by OpenStreetMap columns, other tags, a column of kinds, its name; else
    the fallback."""
    shape, out = shape_of(layer), []
    have = {field.name(): i for i, field in enumerate(layer.fields())}

    def of_column(name: str) -> List[kinds.Kinds]:
        values = layer.uniqueValues(have[name], MOST_VALUES) if name in have else ()
        return kinds.of_column(name, map(str, values), shape)

    for name in kinds.TAGS:
        out += of_column(name)
    if "other_tags" in have:
        some = layer.getFeatures(core.QgsFeatureRequest().setLimit(MOST_FEATURES))
        out += kinds.of_tags((str(feature["other_tags"]) for feature in some), shape)
    for name in kinds.COLUMNS:
        out = out or of_column(name)
    if not out:
        kind = kinds.of_name(layer.name(), shape) or fallback
        if not kind:
            raise Error(f'Nothing tells what the layer "{layer.name()}" holds. Name the kind '
                        "(river, road, lake …), or rename the layer so.")
        out = [kinds.Kinds(kind, "", "")]
    return out


class FeaturesFromLayers(Algorithm):
    """A scene with blocks for layers, checked by the program."""

    NAME, TITLE = "featuresfromlayers", "Features from layers"
    HELP = (
        "Adds roads, railways, lifts, runs, rivers, lakes, areas and houses of layers to a scene. "
        "What a layer holds is inferred from its OpenStreetMap columns (highway, waterway, natural "
        "…), from other_tags, from a column such as kind, type or fclass, or from its name.")

    def declare(self):
        return [
            *scene(),
            parameter("MultipleLayers", "LAYERS", "Layers", compat.VECTORS),
            words("KIND", "Kind of layers that do not tell it (river, road, lake …)"),
            scene_out("Scene with them")]

    def prepare(self, feedback):
        self.blocks, self.folders = "", self.data_folders()
        for layer in self.parameterAsLayerList(self.values, "LAYERS", self.context):
            self._take(layer)
        feedback.pushInfo(self.blocks)

    def _take(self, layer: core.QgsVectorLayer) -> None:
        file, columns = vector_file(layer, self.out_file()), layer.fields().names()
        self.folders.append(os.path.dirname(file.path))
        tunnel = NO_TUNNEL if shape_of(layer) == "line" and "tunnel" in columns else ""
        towns = shape_of(layer) == "point" and "population" in columns
        for part in infer(layer, self.text("KIND")):
            asked = [sql for sql in (layer.subsetString(), part.where, tunnel) if sql]
            self.blocks += scene_file.block(
                "[[features]]", source=os.path.basename(file.path), layer=file.inside,
                crs=file.crs, where=" AND ".join(f"({sql})" for sql in asked), kind=part.kind,
                kind_of=part.column, population_of="population" if towns else "")

    def work(self, feedback):
        out = self.out_file()
        scene_file.extend(self.scene_path(), out, self.blocks, self.folders)
        asked = [word for name in scene_file.data_folders(out) for word in ("--data", name)]
        for source in program.ask(["features", "check", out, *asked], feedback)["sources"]:
            feedback.pushInfo(f"{source['file']}: {source['read']} features read")
            for kind in source["kinds"]:
                counts = [f"{kind[name]} {name.replace('_', ' ')}" for name in COUNTS if kind[name]]
                what = ", ".join(counts) or "part of the ground"
                feedback.pushInfo(f"  {kind['kind']} {kind['features']}: {what}")
        return {"OUTPUT": out}
