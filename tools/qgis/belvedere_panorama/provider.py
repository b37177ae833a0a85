"""The provider: its algorithms, its name and icon, and the setting that names the program."""
from processing.core.ProcessingConfig import ProcessingConfig, Setting
from qgis.core import QgsProcessingProvider
from qgis.PyQt.QtGui import QIcon

from . import program
from .algorithm import ICON
from .features_from_layers import FeaturesFromLayers
from .generalize_dem import GeneralizeDem
from .guidance_buffers import GuidanceBuffers
from .names_from_layer import NamesFromLayer
from .new_panorama import NewPanorama
from .render_panorama import RenderPanorama
from .view_on_map import ViewOnMap

ALGORITHMS = (NewPanorama, RenderPanorama, GuidanceBuffers, GeneralizeDem, FeaturesFromLayers,
              NamesFromLayer, ViewOnMap)


class Provider(QgsProcessingProvider):
    """All algorithms, as `belvedere:NAME`."""

    def id(self) -> str:
        return "belvedere"

    def name(self) -> str:
        return "Belvedere"

    def icon(self) -> QIcon:
        return QIcon(ICON)

    def load(self) -> bool:
        text = "Program (empty: belvedere on the PATH)"
        ProcessingConfig.settingIcons[self.name()] = self.icon()
        ProcessingConfig.addSetting(
            Setting(self.name(), program.SETTING, text, "", valuetype=Setting.FILE))
        ProcessingConfig.readSettings()
        self.refreshAlgorithms()
        return True

    def unload(self) -> None:
        ProcessingConfig.removeSetting(program.SETTING)

    def loadAlgorithms(self) -> None:
        for algorithm in ALGORITHMS:
            self.addAlgorithm(algorithm())
