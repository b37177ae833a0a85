"""Belvedere in QGIS: a Processing provider whose algorithms run the program `belvedere`."""
from qgis.core import QgsApplication

from .provider import Provider


class Plugin:
    """Registers the provider. There is no other interface, so that none is needed."""

    def initProcessing(self) -> None:  # what qgis_process calls, which has no windows
        self.provider = Provider()
        QgsApplication.processingRegistry().addProvider(self.provider)

    initGui = initProcessing  # what the application calls

    def unload(self) -> None:
        QgsApplication.processingRegistry().removeProvider(self.provider)


def classFactory(_iface) -> Plugin:
    """The entry point that QGIS looks for."""
    return Plugin()
