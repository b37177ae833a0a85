"""What all algorithms have in common: names, the check that there is a program, the parameters of a
scene and what becomes of them on the command line."""
import os
from typing import Any, Dict, List

from qgis.core import (
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingLayerPostProcessorInterface,
    QgsProcessingParameterFile,
    QgsProcessingParameterNumber,
    QgsProcessingParameterString,
)
from qgis.PyQt.QtGui import QIcon

from . import compat, program, scene_file


class Styler(QgsProcessingLayerPostProcessorInterface):
    """Gives a loaded layer its look: a function of the layer."""

    kept: List["Styler"] = []  # QGIS does not own them

    def __init__(self, style):
        super().__init__()
        self.style = style
        Styler.kept.append(self)

    def postProcessLayer(self, layer, _context, _feedback) -> None:
        self.style(layer)
        layer.triggerRepaint()

    @staticmethod
    def of(context: QgsProcessingContext, layer_id: str, style) -> None:
        """Styles a result if it will be loaded."""
        if context.willLoadLayerOnCompletion(layer_id):
            context.layerToLoadOnCompletionDetails(layer_id).setPostProcessor(Styler(style))


class Algorithm(QgsProcessingAlgorithm):
    """An algorithm that runs the program. Layers are read in prepareAlgorithm, which runs where
    they live; the program runs in processAlgorithm, in a thread of its own."""

    NAME = ""
    TITLE = ""
    HELP = ""

    def name(self) -> str:
        return self.NAME

    def displayName(self) -> str:
        return self.TITLE

    def shortHelpString(self) -> str:
        return self.HELP

    def icon(self) -> QIcon:
        return QIcon(os.path.join(os.path.dirname(__file__), "icon.svg"))

    def createInstance(self) -> "Algorithm":
        return type(self)()

    def canExecute(self):
        return (True, "") if program.find() else (False, program.INSTALL)

    # ---- parameters

    def add_advanced(self, parameter) -> None:
        parameter.setFlags(parameter.flags() | compat.ADVANCED)
        self.addParameter(parameter)

    def add_scene(self) -> None:
        """The scene, and folders where its files are besides those that it names."""
        self.addParameter(QgsProcessingParameterFile("SCENE", "Scene", extension="toml"))
        self.add_advanced(
            QgsProcessingParameterFile(
                "DATA", "Further folder with files of the scene", compat.FOLDER, optional=True
            )
        )

    def add_changes(self, width: int) -> None:
        """Width of the picture and other keys of the scene, changed for this run."""
        self.addParameter(
            QgsProcessingParameterNumber(
                "WIDTH", "Width in pixels (0: the scene's)", compat.INTEGER, width, False, 0, 65535
            )
        )
        self.add_advanced(
            QgsProcessingParameterString(
                "SETTINGS", "Other keys of the scene, KEY=VALUE on a line each", "", True, True
            )
        )

    # ---- what they mean to the program

    def scene_path(self, parameters: Dict[str, Any], context: QgsProcessingContext) -> str:
        path = self.parameterAsFile(parameters, "SCENE", context)
        if not os.path.isfile(path):
            raise QgsProcessingException(
                f"{path or 'SCENE'}: there is no such scene. New panorama writes one."
            )
        return path

    def data_folders(self, parameters: Dict[str, Any], context: QgsProcessingContext) -> List[str]:
        given = self.parameterAsFile(parameters, "DATA", context)
        known = scene_file.data_folders(self.scene_path(parameters, context))
        return [*known, given] if given else known

    def scene_words(self, parameters: Dict[str, Any], context: QgsProcessingContext) -> List[str]:
        """The words of a command line that stand for the scene: its path, folders and changes."""
        scene = self.scene_path(parameters, context)
        words = [scene]
        for folder in self.data_folders(parameters, context):
            words += ["--data", folder]
        settings = []
        width = self.parameterAsInt(parameters, "WIDTH", context)
        if self.parameterDefinition("WIDTH") and width:
            own = scene_file.size(scene)
            settings += [f"output.width={width}"]
            settings += [f"output.height={max(16, round(width * own[1] / own[0]))}"]
        if self.parameterDefinition("SETTINGS"):
            lines = self.parameterAsString(parameters, "SETTINGS", context).splitlines()
            settings += [line.strip() for line in lines if line.strip()]
        for setting in settings:
            words += ["--set", setting]
        return words
