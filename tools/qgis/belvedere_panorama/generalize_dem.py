"""Generalize DEM: `belvedere generalize`, its result shown as shaded relief."""
from qgis import core

from . import compat, program
from .algorithm import Algorithm, Error, number, parameter, words
from .layers import raster_file

PRESETS = ["smooth_slopes", "bold_ridges", "panorama", "figure2", "figure4", "figure5",
           "the weights below"]
WEIGHTS = {"WEIGHTS": "--global", "RIDGES": "--ridges", "VALLEYS": "--valleys"}


def show_as_relief(layer: core.QgsRasterLayer) -> None:
    """Shaded relief, lit from the north-west as on maps. Altitudes are interpolated before they are
    shaded, so that no cells show."""
    provider = layer.dataProvider()
    provider.enableProviderResampling(True)
    provider.setZoomedInResamplingMethod(compat.CUBIC)
    provider.setZoomedOutResamplingMethod(compat.CUBIC)
    layer.setResamplingStage(compat.RESAMPLE_FIRST)
    layer.setRenderer(core.QgsHillshadeRenderer(provider, 1, 315.0, 45.0))


class GeneralizeDem(Algorithm):
    """A DEM whose landforms are weighted by their size."""

    NAME, TITLE = "generalizedem", "Generalize DEM"
    HELP = (
        "Simplifies an elevation layer and keeps its ridges sharp; the result is shown as shaded "
        "relief. A weight for each size of landforms keeps it (1), removes it (0) or exaggerates "
        "it. <i>panorama</i> and <i>figure4</i> change from near to far and need a viewer.")
    ADVANCED = set(WEIGHTS)

    def declare(self):
        return [
            parameter("RasterLayer", "DEM", "Elevation"),
            parameter("Enum", "PRESET", "Preset", PRESETS, False, 0),
            parameter("Point", "VIEWER", "Viewer", optional=True),
            number("WIDEN", "Widen large valleys, m", 0, 0, 5000, compat.DOUBLE),
            parameter("Boolean", "MASK", "No moats at the foot of slopes", False),
            words("WEIGHTS", "Weights, from the largest landforms on: 1,1,0.7,0.3,0"),
            words("RIDGES", "Added along ridges"),
            words("VALLEYS", "Added along valley lines"),
            parameter("RasterDestination", "OUTPUT", "Generalized DEM")]

    def prepare(self, feedback):
        dem = self.raster("DEM")
        self.crs, self.file = dem.crs(), raster_file(dem)
        if self.file.crs:
            raise Error(f'The file of "{dem.name()}" does not state the coordinate system of the '
                        "layer. Write it with GDAL's Assign projection.")

    def work(self, feedback):
        out = self.parameterAsOutputLayer(self.values, "OUTPUT", self.context)
        asked = ["generalize", self.file.path, out, *self.file.options()]
        preset = self.whole("PRESET")
        asked += ["--preset", PRESETS[preset]] if preset < len(PRESETS) - 1 else []
        for name, option in WEIGHTS.items():
            asked += [option, self.text(name).replace(" ", "")] if self.text(name) else []
        if self.given("VIEWER"):
            viewer = self.position("VIEWER", self.crs)
            asked += ["--viewer", f"{viewer.x():.7f},{viewer.y():.7f}"]
        asked += ["--widen-valleys", f"{self.real('WIDEN'):g}"] if self.real("WIDEN") > 0 else []
        asked += ["--automatic-mask"] if self.yes("MASK") else []
        program.ask(asked, feedback)
        self.styled(out, show_as_relief)
        return {"OUTPUT": out}
