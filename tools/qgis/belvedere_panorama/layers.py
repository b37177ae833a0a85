"""Layers as files that the program reads: a layer's own file if it has one, else a copy."""
import os
import re
from typing import NamedTuple, Optional

from qgis.core import (
    QgsCoordinateTransformContext,
    QgsMapLayer,
    QgsProcessingException,
    QgsProviderRegistry,
    QgsRasterFileWriter,
    QgsRasterLayer,
    QgsRasterPipe,
    QgsVectorFileWriter,
    QgsVectorLayer,
)

from . import compat

VECTOR_FILES = (".gpkg", ".geojson", ".geojsonl", ".shp", ".fgb", ".gpx", ".osm", ".pbf")


class LayerFile(NamedTuple):
    """The file of a layer, the layer's name in it, and its coordinate system where the layer has
    another than the file states."""

    path: str
    inside: str
    crs: str


def require_crs(layer: QgsMapLayer) -> None:
    """Without it the position of the ground is not known."""
    if not layer.crs().isValid():
        raise QgsProcessingException(
            f'The layer "{layer.name()}" has no coordinate system. Set it in the layer\'s '
            "properties, under Source."
        )


def _stated_crs(layer: QgsMapLayer) -> str:
    """The layer's coordinate system, if its file does not state the same."""
    if layer.dataProvider().crs() == layer.crs():
        return ""
    return layer.crs().authid() or layer.crs().toWkt()


def _own_file(layer: QgsMapLayer, provider: str) -> Optional[LayerFile]:
    if layer.providerType() != provider:
        return None
    parts = QgsProviderRegistry.instance().decodeUri(provider, layer.source())
    path = parts.get("path") or ""
    if not os.path.isfile(path):
        return None
    return LayerFile(os.path.abspath(path), parts.get("layerName") or "", _stated_crs(layer))


def name_beside(layer: str, scene: str, ending: str) -> str:
    """A file beside the scene for a layer of this name; there the scene finds it by its name."""
    name = re.sub(r"\W+", "_", layer).strip("_") or "layer"
    return f"{os.path.splitext(os.path.abspath(scene))[0]}_{name}{ending}"


def raster_file(layer: QgsRasterLayer, scene: str) -> LayerFile:
    """The file of a raster layer. One of a server or a database is copied beside the scene."""
    require_crs(layer)
    own = _own_file(layer, "gdal")
    if own:
        return own
    path = name_beside(layer.name(), scene, ".tif")
    provider = layer.dataProvider()
    pipe = QgsRasterPipe()
    if not pipe.set(provider.clone()):
        raise QgsProcessingException(f'The layer "{layer.name()}" cannot be read.')
    result = QgsRasterFileWriter(path).writeRaster(
        pipe, layer.width(), layer.height(), layer.extent(), layer.crs()
    )
    if result != compat.RASTER_WRITTEN:
        raise QgsProcessingException(f'The layer "{layer.name()}" cannot be copied to {path}.')
    return LayerFile(path, "", "")


def vector_file(layer: QgsVectorLayer, scene: str) -> LayerFile:
    """The file of a vector layer. Others than files that the program reads are copied beside the
    scene."""
    require_crs(layer)
    own = _own_file(layer, "ogr")
    if own and own.path.lower().endswith(VECTOR_FILES):
        return own
    path = name_beside(layer.name(), scene, ".gpkg")
    options = QgsVectorFileWriter.SaveVectorOptions()
    options.driverName = "GPKG"
    written = QgsVectorFileWriter.writeAsVectorFormatV3(
        layer, path, QgsCoordinateTransformContext(), options
    )
    if written[0] != compat.WRITTEN:
        raise QgsProcessingException(f"{path}: {written[1]}")
    return LayerFile(path, "", "")
