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


def _moved(new: str, old: str, *names: str, prefix: str = ""):
    return [_first(f"Qgis.{new}.{name}", f"{old}.{prefix}{name}") for name in names]


VECTORS, POLYGONS, POINTS = _moved(
    "ProcessingSourceType", "QgsProcessing.SourceType", "VectorAnyGeometry", "VectorPolygon",
    "VectorPoint", prefix="Type")
INTEGER, DOUBLE = _moved(
    "ProcessingNumberParameterType", "QgsProcessingParameterNumber.Type", "Integer", "Double")
WKB_POINT, WKB_POLYGON = _moved("WkbType", "QgsWkbTypes.Type", "Point", "Polygon")
POINT_GEOMETRY = _first("Qgis.GeometryType.Point", "QgsWkbTypes.GeometryType.PointGeometry")
LINE_GEOMETRY = _first("Qgis.GeometryType.Line", "QgsWkbTypes.GeometryType.LineGeometry")
ADVANCED, = _moved("ProcessingParameterFlag", "QgsProcessingParameterDefinition.Flag", "Advanced",
                   prefix="Flag")
FOLDER, = _moved("ProcessingFileParameterBehavior", "QgsProcessingParameterFile.Behavior", "Folder")
CUBIC = _first("Qgis.RasterResamplingMethod.Cubic", "QgsRasterDataProvider.ResamplingMethod.Cubic")
RESAMPLE_FIRST = core.Qgis.RasterResamplingStage.Provider


def field(name: str, kind: str) -> core.QgsField:
    """A field of the kind "String", "Int" or "Double"."""
    if core.Qgis.QGIS_VERSION_INT < 33800:
        return core.QgsField(name, getattr(QVariant, kind))
    return core.QgsField(name, getattr(QMetaType.Type, kind.replace("String", "QString")))
