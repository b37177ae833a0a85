"""What all algorithms have in common: names, the check that there is a program, values of
parameters, and what a scene becomes on the command line."""
import os
from typing import Any, Callable, Dict, List

from qgis import core
from qgis.PyQt.QtGui import QIcon

from . import compat, program, scene_file

ICON = os.path.join(os.path.dirname(__file__), "icon.svg")
Error = core.QgsProcessingException


def parameter(kind: str, *arguments, **named):
    """A definition of a parameter: parameter("Boolean", "DRAFT", "Draft", False)."""
    return getattr(core, "QgsProcessingParameter" + kind)(*arguments, **named)


def number(name: str, text: str, default: float, low: float, high: float, kind=compat.INTEGER):
    return parameter("Number", name, text, kind, default, False, low, high)


def words(name: str, text: str, default: str = "", lines: bool = False):
    return parameter("String", name, text, default, lines, True)


def scene(*width: int):
    """The scene and further folders of its files; with a width, what is changed for this run."""
    folder, keys = "Further folder with files of the scene", "Other keys, KEY=VALUE on a line each"
    changes = [number("WIDTH", "Width in pixels (0: the scene's)", *width, 0, 65535),
               words("SETTINGS", keys, "", True)] if width else []
    return [parameter("File", "SCENE", "Scene", extension="toml"),
            parameter("File", "DATA", folder, compat.FOLDER, optional=True), *changes]


def scene_out(text: str):
    return parameter("FileDestination", "OUTPUT", text, "Scene (*.toml)")


class Styler(core.QgsProcessingLayerPostProcessorInterface):
    """Gives a loaded layer its look: a function of the layer."""

    kept: List["Styler"] = []  # QGIS does not own them

    def __init__(self, style: Callable):
        super().__init__()
        self.style = style
        Styler.kept.append(self)

    def postProcessLayer(self, layer, _context, _feedback) -> None:
        self.style(layer)


class Algorithm(core.QgsProcessingAlgorithm):
    """An algorithm that runs the program. `prepare` reads layers, in the thread in which they live;
    `work` runs the program in a thread of its own and returns the results."""

    NAME = TITLE = HELP = ""
    ADVANCED = {"DATA", "SETTINGS"}  # parameters that the dialog folds away

    def declare(self) -> List[core.QgsProcessingParameterDefinition]:
        raise NotImplementedError

    def prepare(self, feedback) -> None:
        pass

    def work(self, feedback) -> Dict[str, Any]:
        raise NotImplementedError

    # ---- what QGIS calls

    def name(self) -> str:
        return self.NAME

    def displayName(self) -> str:
        return self.TITLE

    def shortHelpString(self) -> str:
        return self.HELP

    def icon(self) -> QIcon:
        return QIcon(ICON)

    def createInstance(self) -> "Algorithm":
        return type(self)()

    def canExecute(self):
        return (True, "") if program.find() else (False, program.INSTALL)

    def initAlgorithm(self, _configuration=None) -> None:
        for declared in self.declare():
            if declared.name() in self.ADVANCED:
                declared.setFlags(declared.flags() | compat.ADVANCED)
            self.addParameter(declared)

    def prepareAlgorithm(self, parameters, context, feedback) -> bool:
        self.values, self.context = parameters, context
        self.prepare(feedback)
        return True

    def processAlgorithm(self, parameters, context, feedback):
        self.values, self.context = parameters, context
        return self.work(feedback)

    # ---- values of parameters

    def given(self, name: str) -> bool:
        return self.values.get(name) not in (None, "")

    def text(self, name: str) -> str:
        return self.parameterAsString(self.values, name, self.context).strip()

    def whole(self, name: str) -> int:  # also the number of a choice, and 1 for yes
        return self.parameterAsInt(self.values, name, self.context)

    def yes(self, name: str) -> bool:
        return self.parameterAsBool(self.values, name, self.context)

    def real(self, name: str) -> float:
        return self.parameterAsDouble(self.values, name, self.context)

    def out_file(self) -> str:
        return self.parameterAsFileOutput(self.values, "OUTPUT", self.context)

    def position(self, name: str, crs: core.QgsCoordinateReferenceSystem) -> core.QgsPointXY:
        return self.parameterAsPoint(self.values, name, self.context, crs)

    def raster(self, name: str) -> core.QgsRasterLayer:
        layer = self.parameterAsRasterLayer(self.values, name, self.context)
        if layer is None:
            raise Error(self.invalidRasterError(self.values, name))
        return layer

    def sink(self, name: str, kinds: Dict[str, str], wkb, crs):
        """A function that adds a feature of a geometry and values, and the id of its layer."""
        fields = core.QgsFields()
        for field, kind in kinds.items():
            fields.append(compat.field(field, kind))
        sink, layer = self.parameterAsSink(self.values, name, self.context, fields, wkb, crs)

        def add(geometry: core.QgsGeometry, *values) -> None:
            feature = core.QgsFeature(fields)
            feature.setGeometry(geometry)
            feature.setAttributes(list(values))
            sink.addFeature(feature, core.QgsFeatureSink.Flag.FastInsert)

        return add, layer

    def styled(self, layer: str, style: Callable) -> None:
        """Styles a result if it will be loaded."""
        if self.context.willLoadLayerOnCompletion(layer):
            details = self.context.layerToLoadOnCompletionDetails(layer)
            details.setPostProcessor(Styler(style))

    # ---- the scene

    def scene_path(self) -> str:
        path = self.text("SCENE")
        if not os.path.isfile(path):
            raise Error(f"{path or 'SCENE'}: there is no such scene. New panorama writes one.")
        return path

    def data_folders(self) -> List[str]:
        known = scene_file.data_folders(self.scene_path())
        return [*known, self.text("DATA")] if self.given("DATA") else known

    def scene_words(self) -> List[str]:
        """The words of a command line that stand for the scene, its folders and changes."""
        path, settings = self.scene_path(), self.text("SETTINGS").splitlines()
        if self.whole("WIDTH"):
            own = scene_file.size(path)
            height = max(16, round(self.whole("WIDTH") * own[1] / own[0]))
            settings += [f"output.width={self.whole('WIDTH')}", f"output.height={height}"]
        pairs = [("--data", folder) for folder in self.data_folders()]
        pairs += [("--set", setting) for setting in settings]
        return [path, *(word for pair in pairs for word in pair)]
