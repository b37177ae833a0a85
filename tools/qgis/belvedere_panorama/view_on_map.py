"""View on map: the cone of view and the visible ground of a scene, as layers in plan."""
import math
import os
import tempfile

import numpy as np
from osgeo import gdal, ogr
from qgis.core import (
    QgsFeature,
    QgsFields,
    QgsFillSymbol,
    QgsGeometry,
    QgsPointXY,
    QgsProcessingException,
    QgsProcessingParameterFeatureSink,
    QgsProcessingParameterNumber,
)

from . import compat, guidance, program
from .algorithm import Algorithm, Styler

MOST_CELLS = 800  # of the longer side of the map, if no cell is given
MOST_STEPS = 64  # into which a pixel's side is divided
# A step between neighbouring pixels of more than this many of their footprints is an edge behind
# which ground is hidden.
EDGE = 3.0


def filled(colour: str, edge: str):
    """A style: areas of a colour, given as "r,g,b,a"."""
    def style(layer) -> None:
        symbol = QgsFillSymbol.createSimple(
            {"color": colour, "outline_color": edge, "outline_width": "0.4"}
        )
        layer.renderer().setSymbol(symbol)
    return style


def cells_of(east: np.ndarray, north: np.ndarray, footprint: np.ndarray, cell_m: float):
    """The map's cells that pixels show, and the position of its upper left corner: between the
    centres of four pixels the ground is a bilinear surface, unless an edge lies between them."""
    left, top = np.nanmin(east), np.nanmax(north)
    columns = int((np.nanmax(east) - left) / cell_m) + 1
    rows = int((top - np.nanmin(north)) / cell_m) + 1
    seen = np.zeros((rows, columns), np.uint8)
    corners = [(slice(None, -1), slice(None, -1)), (slice(None, -1), slice(1, None)),
               (slice(1, None), slice(1, None)), (slice(1, None), slice(None, -1))]
    x, y = (np.stack([values[c].ravel() for c in corners]) for values in (east, north))
    size = np.max(np.stack([footprint[c].ravel() for c in corners]), 0)
    sides = np.hypot(x - np.roll(x, -1, 0), y - np.roll(y, -1, 0)).max(0)  # NaN at the sky
    steps = np.ceil(sides / cell_m)
    steps[~(sides <= EDGE * size + cell_m)] = 0
    for n in [2**k for k in range(int(math.log2(MOST_STEPS)) + 1)]:
        group = (steps > n / 2) & (steps <= n) if n < MOST_STEPS else steps > n / 2
        gx, gy = x[:, group], y[:, group]
        for v in np.linspace(0.0, 1.0, n + 1):
            for u in np.linspace(0.0, 1.0, n + 1):
                weights = ((1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v)
                px = sum(w * values for w, values in zip(weights, gx))
                py = sum(w * values for w, values in zip(weights, gy))
                seen[((top - py) / cell_m).astype(int), ((px - left) / cell_m).astype(int)] = 1
    return seen, left, top


def polygons_of(seen: np.ndarray, left: float, top: float, cell_m: float):
    """Outlines of the cells that are seen; gaps and patches below four cells are closed."""
    rows, columns = seen.shape
    raster = gdal.GetDriverByName("MEM").Create("", columns, rows, 1, gdal.GDT_Byte)
    raster.SetGeoTransform((left, cell_m, 0.0, top, 0.0, -cell_m))
    band = raster.GetRasterBand(1)
    band.WriteArray(seen)
    gdal.SieveFilter(band, None, band, 4, 4)
    source = ogr.GetDriverByName("Memory").CreateDataSource("")
    layer = source.CreateLayer("seen", None, ogr.wkbPolygon)
    gdal.Polygonize(band, band, layer, -1, [])
    for feature in layer:
        geometry = QgsGeometry()
        geometry.fromWkb(bytes(feature.GetGeometryRef().ExportToWkb()))
        yield geometry


def cone_of(view: guidance.Guidance) -> QgsGeometry:
    """The area between the outermost directions in which ground is seen, as far as the farthest;
    for parallel rays the outline of that ground."""
    camera, ground = view.camera, np.isfinite(view.east)
    dx, dy = view.east[ground] - camera.east, view.north[ground] - camera.north
    if camera.projection == "oblique":
        points = zip(view.east[ground][::7], view.north[ground][::7])
        return QgsGeometry.fromMultiPointXY([QgsPointXY(*p) for p in points]).convexHull()
    far = np.hypot(dx, dy).max()
    turned = (np.degrees(np.arctan2(dx, dy)) - camera.azimuth + 180.0) % 360.0 - 180.0
    # At the foot of the picture a camera that looks down sees ground to all sides.
    ahead = turned[np.hypot(dx, dy) > 0.1 * far]
    whole = camera.field >= 359.0
    first, last = (-180.0, 180.0) if whole else (ahead.min(), ahead.max())
    ring = [] if whole else [QgsPointXY(camera.east, camera.north)]
    for direction in np.linspace(first, last, max(2, int(last - first) + 1)):
        angle = math.radians(camera.azimuth + direction)
        ring.append(QgsPointXY(camera.east + far * math.sin(angle),
                               camera.north + far * math.cos(angle)))
    return QgsGeometry.fromPolygonXY([[*ring, ring[0]]])


class ViewOnMap(Algorithm):
    """Two layers of polygons in the scene's coordinates."""

    NAME = "viewonmap"
    TITLE = "View on map"
    HELP = (
        "Shows in plan what a panorama shows: the cone of view, from the viewer's position to the "
        "farthest ground, and the ground that is visible in the picture. Ground behind mountains, "
        "behind the horizon of the bent terrain and outside the picture is left out.\n"
        "Positions are those on the map, before ground is bent, raised or moved. A wider picture "
        "gives finer outlines. Cells are the resolution of the outlines."
    )

    def initAlgorithm(self, _configuration=None) -> None:
        self.add_scene()
        self.add_changes(800)
        self.add_advanced(
            QgsProcessingParameterNumber(
                "CELL", "Cells, m (0: an 800th of the map)", compat.DOUBLE, 0, False, 0, 10000
            )
        )
        for name, text in (("CONE", "Cone of view"), ("VISIBLE", "Visible ground")):
            self.addParameter(QgsProcessingParameterFeatureSink(name, text, compat.POLYGONS))

    def processAlgorithm(self, parameters, context, feedback):
        with tempfile.TemporaryDirectory() as folder:
            words = ["guidance", *self.scene_words(parameters, context), "--out", folder]
            program.ask([*words, "--channels", "Z,P.X,P.Y,footprint.V"], feedback)
            path = os.path.join(folder, "guidance.exr")
            view = guidance.read(path, ["footprint.V"], feedback)
        if not np.isfinite(view.east).any():
            raise QgsProcessingException("The picture shows no ground.")
        results = {
            "CONE": self._write_cone(view, parameters, context),
            "VISIBLE": self._write_visible(view, parameters, context, feedback),
        }
        Styler.of(context, results["CONE"], filled("255,214,90,40", "200,140,0,255"))
        Styler.of(context, results["VISIBLE"], filled("240,120,30,110", "240,120,30,0"))
        return results

    def _sink(self, name: str, parameters, context, view, columns):
        fields = QgsFields()
        for column, kind in columns:
            fields.append(compat.field(column, kind))
        sink, layer = self.parameterAsSink(
            parameters, name, context, fields, compat.WKB_POLYGON, view.crs
        )

        def write(geometry: QgsGeometry, values) -> None:
            feature = QgsFeature(fields)
            feature.setGeometry(geometry)
            feature.setAttributes(values)
            sink.addFeature(feature, compat.FAST_INSERT)

        return write, layer

    def _write_cone(self, view, parameters, context) -> str:
        columns = [("projection", "text"), ("eye_m", "number"), ("azimuth_deg", "number"),
                   ("field_deg", "number"), ("far_m", "number")]
        write, layer = self._sink("CONE", parameters, context, view, columns)
        camera = view.camera
        far = float(np.nanmax(np.hypot(view.east - camera.east, view.north - camera.north)))
        write(cone_of(view), [camera.projection, camera.altitude, camera.azimuth, camera.field,
                              round(far, 1)])
        return layer

    def _write_visible(self, view, parameters, context, feedback) -> str:
        cell = self.parameterAsDouble(parameters, "CELL", context)
        if cell <= 0:
            sides = (np.nanmax(v) - np.nanmin(v) for v in (view.east, view.north))
            cell = max(sides) / MOST_CELLS
        cells = cells_of(view.east, view.north, view.others["footprint.V"], cell)
        write, layer = self._sink("VISIBLE", parameters, context, view, [("area_km2", "number")])
        total = 0.0
        for geometry in polygons_of(*cells, cell):
            total += geometry.area() / 1e6
            write(geometry, [round(geometry.area() / 1e6, 4)])
        feedback.pushInfo(f"visible ground: {total:.1f} km²")
        return layer
