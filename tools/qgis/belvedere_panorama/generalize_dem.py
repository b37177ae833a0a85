"""Generalize DEM: `belvedere generalize`, its result shown as shaded relief."""
from qgis.core import (
    QgsHillshadeRenderer,
    QgsProcessingException,
    QgsProcessingParameterBoolean,
    QgsProcessingParameterEnum,
    QgsProcessingParameterNumber,
    QgsProcessingParameterPoint,
    QgsProcessingParameterRasterDestination,
    QgsProcessingParameterRasterLayer,
    QgsProcessingParameterString,
    QgsProcessingUtils,
    QgsRasterLayer,
)

from . import compat, program
from .algorithm import Algorithm, Styler
from .layers import raster_file

PRESETS = ["smooth_slopes", "bold_ridges", "panorama", "figure2", "figure4", "figure5",
           "the weights below"]


def show_as_relief(layer: QgsRasterLayer) -> None:
    """Shaded relief, lit from the north-west as on maps. Altitudes are interpolated before they are
    shaded, so that no cells show."""
    provider = layer.dataProvider()
    provider.enableProviderResampling(True)
    provider.setZoomedInResamplingMethod(compat.CUBIC)
    provider.setZoomedOutResamplingMethod(compat.CUBIC)
    layer.setResamplingStage(compat.RESAMPLE_FIRST)
    layer.setRenderer(QgsHillshadeRenderer(provider, 1, 315.0, 45.0))


class GeneralizeDem(Algorithm):
    """A DEM whose landforms are weighted by their size."""

    NAME = "generalizedem"
    TITLE = "Generalize DEM"
    HELP = (
        "Simplifies an elevation layer and keeps its ridges sharp. The DEM is split into bands of "
        "landform size; a weight for each band keeps it (1), removes it (0) or exaggerates it.\n"
        "<i>smooth_slopes</i> smooths slopes, <i>bold_ridges</i> raises main ranges, "
        "<i>panorama</i> changes from near to far and needs a viewer. The result is shown as "
        "shaded relief. docs/generalization.md explains the weights."
    )

    def initAlgorithm(self, _configuration=None) -> None:
        self.addParameter(QgsProcessingParameterRasterLayer("DEM", "Elevation"))
        self.addParameter(QgsProcessingParameterEnum("PRESET", "Preset", PRESETS, False, 0))
        self.addParameter(QgsProcessingParameterPoint("VIEWER", "Viewer", optional=True))
        self.addParameter(
            QgsProcessingParameterNumber(
                "WIDEN", "Widen the floors of large valleys, m", compat.DOUBLE, 0, False, 0, 5000
            )
        )
        self.addParameter(
            QgsProcessingParameterBoolean("MASK", "No moats at the foot of slopes", False)
        )
        for name, text in (
            ("WEIGHTS", "Weights, from the largest landforms on: 1,1,0.7,0.3,0"),
            ("RIDGES", "Added along ridges"),
            ("VALLEYS", "Added along valley lines"),
        ):
            self.add_advanced(QgsProcessingParameterString(name, text, optional=True))
        self.addParameter(QgsProcessingParameterRasterDestination("OUTPUT", "Generalized DEM"))

    def prepareAlgorithm(self, parameters, context, _feedback) -> bool:
        dem = self.parameterAsRasterLayer(parameters, "DEM", context)
        if dem is None:
            raise QgsProcessingException(self.invalidRasterError(parameters, "DEM"))
        self.file = raster_file(dem, QgsProcessingUtils.generateTempFilename("dem.toml"))
        if self.file.crs:
            raise QgsProcessingException(
                f'The file of "{dem.name()}" does not state the coordinate system of the layer. '
                "Assign it with GDAL's Assign projection."
            )
        self.crs = dem.crs()
        return True

    def processAlgorithm(self, parameters, context, feedback):
        out = self.parameterAsOutputLayer(parameters, "OUTPUT", context)
        words = ["generalize", self.file.path, out]
        words += ["--variable", self.file.inside] if self.file.inside else []
        preset = self.parameterAsEnum(parameters, "PRESET", context)
        words += ["--preset", PRESETS[preset]] if preset < len(PRESETS) - 1 else []
        for name, option in (("WEIGHTS", "--global"), ("RIDGES", "--ridges"),
                             ("VALLEYS", "--valleys")):
            value = self.parameterAsString(parameters, name, context)
            words += [option, value.replace(" ", "")] if value else []
        if parameters.get("VIEWER") not in (None, ""):
            viewer = self.parameterAsPoint(parameters, "VIEWER", context, self.crs)
            words += ["--viewer", f"{viewer.x():.7f},{viewer.y():.7f}"]
        widen = self.parameterAsDouble(parameters, "WIDEN", context)
        words += ["--widen-valleys", f"{widen:g}"] if widen > 0 else []
        words += ["--automatic-mask"] if self.parameterAsBool(parameters, "MASK", context) else []
        answer = program.ask(words, feedback)
        feedback.pushInfo(
            f"altitudes change by {answer['rms_change_m']:.1f} m (root mean square), at most "
            f"{answer['largest_change_m']:.1f} m"
        )
        Styler.of(context, out, show_as_relief)
        return {"OUTPUT": out}
