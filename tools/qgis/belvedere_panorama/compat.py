"""The only place that knows differences between QGIS 3.22, 3.40 and 4: enumerations have moved from
the classes to `Qgis`, and types of fields from QVariant to QMetaType."""
from functools import reduce

from qgis import core
from qgis.PyQt.QtCore import QMetaType, QVariant


def _first(*names: str):
    """The first of these names, such as "QgsWkbTypes.Type.Point", that this version has."""
    for name in names:
        try:
            return reduce(getattr, name.split("."), core)
        except AttributeError:
            pass
    raise ImportError(f"this version of QGIS has none of {', '.join(names)}")


def _source(name: str):
    return _first(f"Qgis.ProcessingSourceType.{name}", f"QgsProcessing.SourceType.Type{name}")


ANY_VECTOR = _source("VectorAnyGeometry")
POLYGONS = _source("VectorPolygon")
POINTS = _source("VectorPoint")
ADVANCED = _first(
    "Qgis.ProcessingParameterFlag.Advanced", "QgsProcessingParameterDefinition.Flag.FlagAdvanced"
)
FOLDER = _first(
    "Qgis.ProcessingFileParameterBehavior.Folder", "QgsProcessingParameterFile.Behavior.Folder"
)
INTEGER = _first(
    "Qgis.ProcessingNumberParameterType.Integer", "QgsProcessingParameterNumber.Type.Integer"
)
DOUBLE = _first(
    "Qgis.ProcessingNumberParameterType.Double", "QgsProcessingParameterNumber.Type.Double"
)
WKB_ANY = _first("Qgis.WkbType.Unknown", "QgsWkbTypes.Type.Unknown")
WKB_POINT = _first("Qgis.WkbType.Point", "QgsWkbTypes.Type.Point")
WKB_POLYGON = _first("Qgis.WkbType.Polygon", "QgsWkbTypes.Type.Polygon")
POINT_GEOMETRY = _first("Qgis.GeometryType.Point", "QgsWkbTypes.GeometryType.PointGeometry")
LINE_GEOMETRY = _first("Qgis.GeometryType.Line", "QgsWkbTypes.GeometryType.LineGeometry")
CUBIC = _first("QgsRasterDataProvider.ResamplingMethod.Cubic")
RESAMPLE_FIRST = _first(
    "Qgis.RasterResamplingStage.Provider", "QgsRasterLayer.ResamplingStage.Provider"
)
FAST_INSERT = _first("QgsFeatureSink.Flag.FastInsert")
WRITTEN = _first("QgsVectorFileWriter.WriterError.NoError")
RASTER_WRITTEN = _first("Qgis.RasterFileWriterResult.Success", "QgsRasterFileWriter.NoError")


def is_point(wkb_type) -> bool:
    """Whether geometries of this type are points."""
    return core.QgsWkbTypes.geometryType(wkb_type) == POINT_GEOMETRY


_metatypes = core.Qgis.QGIS_VERSION_INT >= 33800


def field(name: str, kind: str) -> core.QgsField:
    """A field of kind "text", "integer" or "number"."""
    if _metatypes:
        types = QMetaType.Type
        known = {"text": types.QString, "integer": types.Int, "number": types.Double}
    else:
        known = {"text": QVariant.String, "integer": QVariant.Int, "number": QVariant.Double}
    return core.QgsField(name, known[kind])
