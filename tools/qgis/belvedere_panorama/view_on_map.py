"""View on map: the cone of view and the visible ground of a scene, as layers in plan."""
import math
import os
import tempfile

import numpy as np
from osgeo import gdal, ogr
from qgis import core

from . import compat, guidance_buffers, program
from .algorithm import Algorithm, Error, number, parameter, scene

MOST_CELLS = 800  # of the longer side of the map, if no cell is given
MOST_STEPS = 64  # into which a pixel's side is divided
# A step between neighbouring pixels of more than this many of their footprints is an edge behind
# which ground is hidden.
EDGE = 3.0


def filled(colour: str, edge: str):
    """A style: areas of a colour, given as "r,g,b,a"."""
    def style(layer) -> None:
        layer.renderer().setSymbol(core.QgsFillSymbol.createSimple(
            {"color": colour, "outline_color": edge, "outline_width": "0.4"}))
    return style


STYLES = {"CONE": filled("255,214,90,40", "200,140,0,255"),
          "VISIBLE": filled("240,120,30,110", "240,120,30,0")}


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
    source = (ogr.GetDriverByName("Memory") or ogr.GetDriverByName("MEM")).CreateDataSource("")
    layer = source.CreateLayer("seen", None, ogr.wkbPolygon)
    gdal.Polygonize(band, band, layer, -1, [])
    for feature in layer:
        geometry = core.QgsGeometry()
        geometry.fromWkb(bytes(feature.GetGeometryRef().ExportToWkb()))
        yield geometry


def cone_of(view: guidance_buffers.Guidance) -> core.QgsGeometry:
    """The area between the outermost directions in which ground is seen, as far as the farthest;
    for parallel rays the outline of that ground."""
    ground = np.isfinite(view.east)
    east, north = view.east[ground], view.north[ground]
    if view.projection == "oblique":
        points = [core.QgsPointXY(*p) for p in zip(east[::7], north[::7])]
        return core.QgsGeometry.fromMultiPointXY(points).convexHull()
    dx, dy = east - view.eye[0], north - view.eye[1]
    distance = np.hypot(dx, dy)
    turned = (np.degrees(np.arctan2(dx, dy)) - view.azimuth + 180.0) % 360.0 - 180.0
    # At the foot of the picture a camera that looks down sees ground to all sides.
    turned = turned[distance > 0.1 * distance.max()]
    whole = view.field >= 359.0
    first, last = (-180.0, 180.0) if whole else (turned.min(), turned.max())
    angle = np.radians(view.azimuth + np.linspace(first, last, max(2, int(last - first) + 1)))
    arc = zip(view.eye[0] + distance.max() * np.sin(angle),
              view.eye[1] + distance.max() * np.cos(angle))
    ring = [core.QgsPointXY(*p) for p in ([*arc] if whole else [view.eye[:2], *arc])]
    return core.QgsGeometry.fromPolygonXY([[*ring, ring[0]]])


class ViewOnMap(Algorithm):
    """Two layers of polygons in the scene's coordinates."""

    NAME, TITLE = "viewonmap", "View on map"
    HELP = (
        "Shows in plan what a panorama shows: the cone of view, from the viewer's position to the "
        "farthest ground, and the ground that is visible in the picture. A wider picture gives "
        "finer outlines.")
    ADVANCED = {*Algorithm.ADVANCED, "CELL"}

    def declare(self):
        return [
            *scene(1000),
            number("CELL", "Cells, m (0: an 800th of the map)", 0, 0, 10000, compat.DOUBLE),
            parameter("FeatureSink", "CONE", "Cone of view", compat.POLYGONS),
            parameter("FeatureSink", "VISIBLE", "Visible ground", compat.POLYGONS)]

    def work(self, feedback):
        with tempfile.TemporaryDirectory() as folder:
            asked = ["guidance", *self.scene_words(), "--out", folder]
            program.ask([*asked, "--channels", "Z,P.X,P.Y,footprint.V"], feedback)
            path = os.path.join(folder, "guidance.exr")
            view = guidance_buffers.read(path, ["footprint.V"], feedback)
        if not np.isfinite(view.east).any():
            raise Error("The picture shows no ground.")
        results = {"CONE": self._write_cone(view), "VISIBLE": self._write_visible(view, feedback)}
        for name, style in STYLES.items():
            self.styled(results[name], style)
        return results

    def _write_cone(self, view: guidance_buffers.Guidance) -> str:
        fields = {"projection": "String", "eye_m": "Double", "azimuth_deg": "Double",
                  "field_deg": "Double", "far_m": "Double"}
        add, layer = self.sink("CONE", fields, compat.WKB_POLYGON, view.crs)
        far = float(np.nanmax(np.hypot(view.east - view.eye[0], view.north - view.eye[1])))
        add(cone_of(view), view.projection, float(view.eye[2]), view.azimuth, view.field, far)
        return layer

    def _write_visible(self, view: guidance_buffers.Guidance, feedback) -> str:
        sides = (np.nanmax(values) - np.nanmin(values) for values in (view.east, view.north))
        cell = self.real("CELL") or max(sides) / MOST_CELLS
        cells = cells_of(view.east, view.north, view.others["footprint.V"], cell)
        add, layer = self.sink("VISIBLE", {"area_km2": "Double"}, compat.WKB_POLYGON, view.crs)
        total = 0.0
        for geometry in polygons_of(*cells, cell):
            total += geometry.area() / 1e6
            add(geometry, round(geometry.area() / 1e6, 4))
        feedback.pushInfo(f"visible ground: {total:.1f} km²")
        return layer
