"""New panorama: a scene of an elevation layer, composed by `belvedere new`."""
import math
import os

from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsDistanceArea,
    QgsProcessingException,
    QgsProcessingParameterBand,
    QgsProcessingParameterBoolean,
    QgsProcessingParameterEnum,
    QgsProcessingParameterFile,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterFolderDestination,
    QgsProcessingParameterNumber,
    QgsProcessingParameterPoint,
    QgsProcessingParameterRasterLayer,
    QgsProcessingParameterString,
)

from . import compat, legends, program, scene_file
from .algorithm import Algorithm
from .layers import LayerFile, raster_file

LEGENDS = ["inferred from its values and name", *legends.CODES, "a file"]
STYLES = ["the program's own", "segantini", "gogh", "monet", "turner", "rubens", "bruegel"]
DEGREES = "EPSG:4326"


class NewPanorama(Algorithm):
    """Proposals of views, or the view from one point to another."""

    NAME = "newpanorama"
    TITLE = "New panorama"
    HELP = (
        "Composes a panorama of an elevation layer and writes it as a scene, a text file that "
        "<i>Render panorama</i> makes a picture of.\n"
        "Without points the program proposes up to five views; choose one by its number, after a "
        "look at the pictures of the proposals. With a point to stand the viewer is above it, with "
        "a point to look at it is in the picture, with both the view goes from one to the other."
    )

    def initAlgorithm(self, _configuration=None) -> None:
        self.addParameter(QgsProcessingParameterRasterLayer("DEM", "Elevation"))
        self.addParameter(
            QgsProcessingParameterRasterLayer("LAND_COVER", "Land cover", optional=True)
        )
        self.addParameter(
            QgsProcessingParameterEnum("LEGEND", "Legend of the land cover", LEGENDS, False, 0)
        )
        self.addParameter(QgsProcessingParameterPoint("STAND", "Point to stand", optional=True))
        self.addParameter(QgsProcessingParameterPoint("LOOK", "Point to look at", optional=True))
        self.addParameter(
            QgsProcessingParameterNumber(
                "PROPOSAL", "Number of the proposal", compat.INTEGER, 1, False, 1, 12
            )
        )
        self.addParameter(QgsProcessingParameterEnum("STYLE", "Style", STYLES, False, 0))
        self.addParameter(
            QgsProcessingParameterString(
                "FORMAT", "Shape of the sheet (2:1, A2, 2400x1200, cylinder)", "2:1"
            )
        )
        self.addParameter(QgsProcessingParameterString("TITLE", "Title", optional=True))
        self.add_advanced(
            QgsProcessingParameterBand(
                "LAND_COVER_BAND", "Band of the land cover", 1, "LAND_COVER", True
            )
        )
        self.add_advanced(
            QgsProcessingParameterFile("LEGEND_FILE", "File of the legend", optional=True)
        )
        self.add_advanced(
            QgsProcessingParameterBoolean("PLAIN", "Do not widen valleys or raise summits", False)
        )
        self.addParameter(
            QgsProcessingParameterFileDestination("OUTPUT", "Scene", "Scene (*.toml)")
        )
        self.addParameter(
            QgsProcessingParameterFolderDestination(
                "PICTURES", "Pictures of the proposals", None, True, False
            )
        )

    def prepareAlgorithm(self, parameters, context, feedback) -> bool:
        self.scene = self.parameterAsFileOutput(parameters, "OUTPUT", context)
        dem = self.parameterAsRasterLayer(parameters, "DEM", context)
        if dem is None:
            raise QgsProcessingException(self.invalidRasterError(parameters, "DEM"))
        file = raster_file(dem, self.scene)
        self.folders = [os.path.dirname(file.path)]
        self.words = [file.path, *self._raster_options(file, "")]
        cover = self.parameterAsRasterLayer(parameters, "LAND_COVER", context)
        if cover is not None:
            self._take_land_cover(cover, parameters, context, feedback)
        return True

    @staticmethod
    def _raster_options(file: LayerFile, prefix: str):
        words = [f"--{prefix}variable", file.inside] if file.inside else []
        return words + ([f"--{prefix}crs", file.crs] if file.crs else [])

    def _take_land_cover(self, layer, parameters, context, feedback) -> None:
        file = raster_file(layer, self.scene)
        band = self.parameterAsInt(parameters, "LAND_COVER_BAND", context) or 1
        choice = self.parameterAsEnum(parameters, "LEGEND", context)
        if choice == 0:
            values = legends.values_of(layer, band)
            legend = legends.infer(values, legends.name_of(layer))
            if legend is None:
                some = ", ".join(str(value) for value in sorted(values)[:12])
                raise QgsProcessingException(
                    f'No built-in legend has the values of "{layer.name()}" ({some} …). Choose the '
                    "legend, or write a file of it: docs/legends.md."
                )
            feedback.pushInfo(f"legend of the land cover: {legend}")
        elif choice == len(LEGENDS) - 1:
            legend = self.parameterAsFile(parameters, "LEGEND_FILE", context)
            if not os.path.isfile(legend):
                raise QgsProcessingException("Legend: \"a file\" is chosen, but no file is named.")
            self.folders.append(os.path.dirname(os.path.abspath(legend)))
        else:
            legend = LEGENDS[choice]
        self.folders.append(os.path.dirname(file.path))
        self.words += ["--land-cover", file.path, "--legend", legend]
        self.words += ["--land-cover-band", str(band)] if band > 1 else []
        self.words += self._raster_options(file, "land-cover-")

    def _view_words(self, parameters, context):
        """Where the viewer stands and what must be in the picture."""
        degrees = QgsCoordinateReferenceSystem(DEGREES)
        points = {}
        for name in ("STAND", "LOOK"):
            if parameters.get(name) not in (None, ""):
                points[name] = self.parameterAsPoint(parameters, name, context, degrees)
        text = {name: f"{p.x():.7f},{p.y():.7f}" for name, p in points.items()}
        words = ["--from", text["STAND"]] if "STAND" in text else []
        words += ["--include", text["LOOK"]] if "LOOK" in text else []
        if len(points) == 2:
            earth = QgsDistanceArea()
            earth.setSourceCrs(degrees, context.transformContext())
            earth.setEllipsoid("WGS84")
            bearing = math.degrees(earth.bearing(points["STAND"], points["LOOK"]))
            words += ["--towards", f"{bearing % 360.0:.2f}"]
        return words

    def processAlgorithm(self, parameters, context, feedback):
        words = ["new", *self.words, "--out", self.scene, "--force"]
        words += self._view_words(parameters, context)
        words += ["--choose", str(self.parameterAsInt(parameters, "PROPOSAL", context))]
        words += ["--format", self.parameterAsString(parameters, "FORMAT", context)]
        style = self.parameterAsEnum(parameters, "STYLE", context)
        words += ["--style", STYLES[style]] if style else []
        title = self.parameterAsString(parameters, "TITLE", context)
        words += ["--title", title] if title else []
        words += ["--plain"] if self.parameterAsBool(parameters, "PLAIN", context) else []
        results = {"OUTPUT": self.scene}
        if parameters.get("PICTURES"):
            results["PICTURES"] = self.parameterAsString(parameters, "PICTURES", context)
            words += ["--pictures", results["PICTURES"]]
        answer = program.ask(words, feedback)
        for number, proposal in enumerate(answer["proposals"], 1):
            chosen = "*" if number == answer["chosen"] else " "
            feedback.pushInfo(f"{chosen} {number}. {proposal['what']}")
        text = scene_file.read(self.scene)
        scene_file.write(self.scene, scene_file.with_folders(text, self.scene, self.folders))
        return results
