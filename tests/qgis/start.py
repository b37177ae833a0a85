"""Starts QGIS in this process, with the plugin's provider, for the tests and the screenshots."""
import os
import pathlib
import sys

root = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(root / "tools/qgis"), "/usr/share/qgis/python/plugins"]
if "DISPLAY" not in os.environ:
    os.environ["QT_QPA_PLATFORM"] = "offscreen"

import qgis.utils  # noqa: E402
from qgis.core import QgsApplication  # noqa: E402


def start(interface=lambda: None):
    """The application, the module Processing and the provider. `interface` makes what plugins take
    for the application's windows."""
    app = QgsApplication([], "DISPLAY" in os.environ)
    app.initQgis()
    qgis.utils.iface = interface()
    import processing
    from belvedere_panorama.provider import Provider
    from processing.core.Processing import Processing
    Processing.initialize()
    provider = Provider()
    app.processingRegistry().addProvider(provider)
    return app, processing, provider
