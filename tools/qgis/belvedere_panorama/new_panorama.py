"""New panorama: a scene of an elevation layer, composed by `belvedere new`."""
import math
import os

from qgis import core

from . import legends, program, scene_file
from .algorithm import Algorithm, Error, number, parameter, scene_out, words
from .layers import raster_file

LEGENDS = ["inferred from its values and name", *legends.CODES, "a file"]
STYLES = ["the program's own", "segantini", "gogh", "monet", "turner", "rubens", "bruegel"]


class NewPanorama(Algorithm):
    """Proposals of views, or the view from one point to another."""

    NAME, TITLE = "newpanorama", "New panorama"
    HELP = (
        "Composes a panorama of an elevation layer and writes it as a scene, of which <i>Render "
        "panorama</i> makes a picture.\n"
        "Without points the program proposes up to five views; choose one by its number. With a "
        "point to stand the viewer is above it, with a point to look at it is in the picture.")
    ADVANCED = {"LAND_COVER_BAND", "LEGEND_FILE", "PLAIN"}

    def declare(self):
        return [
            parameter("RasterLayer", "DEM", "Elevation"),
            parameter("RasterLayer", "LAND_COVER", "Land cover", optional=True),
            parameter("Enum", "LEGEND", "Legend of the land cover", LEGENDS, False, 0),
            parameter("Point", "STAND", "Point to stand", optional=True),
            parameter("Point", "LOOK", "Point to look at", optional=True),
            number("PROPOSAL", "Number of the proposal", 1, 1, 12),
            parameter("Enum", "STYLE", "Style", STYLES, False, 0),
            words("FORMAT", "Shape of the sheet (2:1, A2, 2400x1200, cylinder)", "2:1"),
            words("TITLE", "Title"),
            number("LAND_COVER_BAND", "Band of the land cover", 1, 1, 65535),
            parameter("File", "LEGEND_FILE", "File of the legend", optional=True),
            parameter("Boolean", "PLAIN", "Do not widen valleys or raise summits", False),
            scene_out("Scene"),
            parameter("FolderDestination", "PICTURES", "Pictures of the proposals", None, True,
                      False)]

    def prepare(self, feedback):
        file = raster_file(self.raster("DEM"))
        self.words, self.folders = [file.path, *file.options()], [os.path.dirname(file.path)]
        if not self.given("LAND_COVER"):
            return
        layer, band = self.raster("LAND_COVER"), self.whole("LAND_COVER_BAND")
        file, legend = raster_file(layer), self._legend(layer, band)
        feedback.pushInfo(f"legend of the land cover: {legend}")
        self.folders += [os.path.dirname(file.path)]
        self.words += ["--land-cover", file.path, "--legend", legend]
        self.words += ["--land-cover-band", str(band)] if band > 1 else []
        self.words += file.options("--land-cover-")

    def _legend(self, layer: core.QgsRasterLayer, band: int) -> str:
        chosen = self.whole("LEGEND")
        if 0 < chosen < len(LEGENDS) - 1:
            return LEGENDS[chosen]
        if chosen:
            path = os.path.abspath(self.text("LEGEND_FILE"))
            if not os.path.isfile(path):
                raise Error('Legend: "a file" is chosen, but no file is named.')
            self.folders.append(os.path.dirname(path))
            return path
        values = legends.values_of(layer, band)
        legend = legends.infer(values, f"{layer.name()} {os.path.basename(layer.source())}")
        if legend is None:
            some = ", ".join(map(str, sorted(values)[:12]))
            raise Error(f'No built-in legend has the values of "{layer.name()}": {some} … Choose '
                        "the legend, or write a file of it: docs/legends.md.")
        return legend

    def _view(self):
        """Where the viewer stands and what must be in the picture."""
        degrees = core.QgsCoordinateReferenceSystem("EPSG:4326")
        at = {name: self.position(name, degrees) for name in ("STAND", "LOOK") if self.given(name)}
        out = []
        for name, option in (("STAND", "--from"), ("LOOK", "--include")):
            out += [option, f"{at[name].x():.7f},{at[name].y():.7f}"] if name in at else []
        if len(at) == 2:
            earth = core.QgsDistanceArea()
            earth.setSourceCrs(degrees, self.context.transformContext())
            earth.setEllipsoid("WGS84")
            bearing = math.degrees(earth.bearing(at["STAND"], at["LOOK"]))
            out += ["--towards", f"{bearing % 360.0:.2f}"]
        return out

    def work(self, feedback):
        results = {"OUTPUT": self.out_file()}
        asked = ["new", *self.words, "--out", results["OUTPUT"], "--force", *self._view()]
        asked += ["--choose", self.text("PROPOSAL"), "--format", self.text("FORMAT") or "2:1"]
        asked += ["--style", STYLES[self.whole("STYLE")]] if self.whole("STYLE") else []
        asked += ["--title", self.text("TITLE")] if self.text("TITLE") else []
        asked += ["--plain"] if self.yes("PLAIN") else []
        if self.given("PICTURES"):
            results["PICTURES"] = self.text("PICTURES")
            asked += ["--pictures", results["PICTURES"]]
        answer = program.ask(asked, feedback)
        for i, proposal in enumerate(answer["proposals"], 1):
            feedback.pushInfo(f"{'*' if i == answer['chosen'] else ' '} {i}. {proposal['what']}")
        scene_file.extend(results["OUTPUT"], results["OUTPUT"], "", self.folders)
        return results
