"""Belvedere in QGIS: a Processing provider whose algorithms run the program `belvedere`."""
from qgis.core import QgsApplication

from .provider import Provider


class Plugin:
    """Registers the provider; there is no other interface, so that none is needed."""

    def __init__(self):
        self.provider = None

    def initProcessing(self) -> None:
        """What `qgis_process` calls, which has no windows."""
        self.provider = Provider()
        QgsApplication.processingRegistry().addProvider(self.provider)

    def initGui(self) -> None:
        """What the application calls."""
        self.initProcessing()

    def unload(self) -> None:
        """What both call at the end."""
        QgsApplication.processingRegistry().removeProvider(self.provider)


def classFactory(_iface) -> Plugin:
    """The entry point that QGIS looks for."""
    return Plugin()
