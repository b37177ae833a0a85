"""Screenshots of the dialogs, and a map with the view of a scene, for docs/images:
xvfb-run -s "-screen 0 1400x1000x24" /usr/bin/python3 tests/qgis/shots.py DEM SCENE FOLDER
SCENE is one of New panorama. BELVEDERE_PROGRAM names the program."""
import sys

sys.dont_write_bytecode = True  # nothing is left in the checkout
from qgis import core, gui  # noqa: E402
from qgis.PyQt.QtCore import QSize  # noqa: E402
from start import start  # noqa: E402


class Interface:
    """As much of the application's windows as dialogs ask for."""

    def __init__(self):
        self.canvas = gui.QgsMapCanvas()

    def mapCanvas(self):
        return self.canvas

    def __getattr__(self, _name):
        return lambda *_: None


app, processing, provider = start(Interface)
from belvedere_panorama import generalize_dem, view_on_map  # noqa: E402

dem, scene, folder = sys.argv[1:]
ground = core.QgsRasterLayer(dem, "elevation")
core.QgsProject.instance().addMapLayer(ground)
look = "11.40,47.38 [EPSG:4326]"
for name, values in (("new", {"DEM": ground, "LOOK": look, "OUTPUT": scene}),
                     ("render", {"SCENE": scene, "WIDTH": 1200})):
    dialog = processing.createAlgorithmDialog(f"belvedere:{name}panorama", values)
    dialog.resize(820, 640)
    dialog.show()
    for _ in range(20):
        app.processEvents()
    dialog.grab().save(f"{folder}/qgis_{name}.png")
    dialog.hide()

found = processing.run("belvedere:viewonmap", {
    "SCENE": scene, "WIDTH": 1200, "CONE": "memory:", "VISIBLE": "memory:"})
for name, style in view_on_map.STYLES.items():
    style(found[name])
generalize_dem.show_as_relief(ground)
settings = core.QgsMapSettings()
settings.setLayers([found["CONE"], found["VISIBLE"], ground])
settings.setDestinationCrs(ground.crs())
settings.setExtent(found["CONE"].extent().buffered(2000))
settings.setOutputSize(QSize(760, 640))
job = core.QgsMapRendererSequentialJob(settings)
job.start()
job.waitForFinished()
job.renderedImage().save(f"{folder}/qgis_view.jpg", "JPG", 80)
