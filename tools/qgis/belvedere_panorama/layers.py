"""Layers as files that the program reads: a layer's own file if it has one, else a copy."""
import os
import re
from typing import List, NamedTuple, Optional

from qgis import core

VECTOR_FILES = (".gpkg", ".geojson", ".geojsonl", ".shp", ".fgb", ".gpx", ".osm", ".pbf")


class LayerFile(NamedTuple):
    """The file of a layer, the layer's name in it, and the layer's coordinate system if the file
    states another or none."""

    path: str
    inside: str = ""
    crs: str = ""

    def options(self, prefix: str = "--") -> List[str]:
        """As words of a command line."""
        words = [prefix + "variable", self.inside] if self.inside else []
        return words + ([prefix + "crs", self.crs] if self.crs else [])


def name_beside(layer: str, scene: str, ending: str) -> str:
    """A file beside the scene for a layer of this name; there the scene finds it by its name."""
    name = re.sub(r"\W+", "_", layer).strip("_") or "layer"
    return f"{os.path.splitext(os.path.abspath(scene))[0]}_{name}{ending}"


def _own_file(layer: core.QgsMapLayer, provider: str) -> Optional[LayerFile]:
    if not layer.crs().isValid():
        raise core.QgsProcessingException(
            f'The layer "{layer.name()}" has no coordinate system. Set it in the layer\'s '
            "properties, under Source.")
    parts = core.QgsProviderRegistry.instance().decodeUri(provider, layer.source())
    if layer.providerType() != provider or not os.path.isfile(parts.get("path") or ""):
        return None
    same = layer.dataProvider().crs() == layer.crs()
    crs = "" if same else layer.crs().authid() or layer.crs().toWkt()
    return LayerFile(os.path.abspath(parts["path"]), parts.get("layerName") or "", crs)


def raster_file(layer: core.QgsRasterLayer) -> LayerFile:
    """The file of a raster layer, which must be one."""
    own = _own_file(layer, "gdal")
    if own is None:
        raise core.QgsProcessingException(
            f'The layer "{layer.name()}" is no file. Export it as one, and use that.')
    return own


def vector_file(layer: core.QgsVectorLayer, scene: str) -> LayerFile:
    """The file of a vector layer; one that the program does not read is copied beside the
    scene."""
    own = _own_file(layer, "ogr")
    if own and own.path.lower().endswith(VECTOR_FILES):
        return own
    path, writer = name_beside(layer.name(), scene, ".gpkg"), core.QgsVectorFileWriter
    status = writer.writeAsVectorFormatV3(
        layer, path, core.QgsCoordinateTransformContext(), writer.SaveVectorOptions())
    if status[0] != writer.WriterError.NoError:
        raise core.QgsProcessingException(f"{path}: {status[1]}")
    return LayerFile(path)
