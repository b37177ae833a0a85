"""Render panorama: the picture of a scene by `belvedere render`, and where its pixels lie."""
import os

import numpy as np
from qgis import core

from . import compat, guidance_buffers, program
from .algorithm import Algorithm, number, parameter, scene

# That QGIS shows; PNG first, since it stretches the contrast of 16 bits.
PICTURES = ("panorama_names.png", "panorama_names.tif", "panorama.png", "panorama.tif")
INDEX_CHANNELS = ["Z", "altitude.V", "landcover.id"]


class RenderPanorama(Algorithm):
    """The picture, and on request a point on the ground for every n-th pixel."""

    NAME, TITLE = "renderpanorama", "Render panorama"
    HELP = (
        "Renders a scene and loads the picture, the one with names if there is one. A draft has a "
        "third of the pixels per side and takes seconds.\n"
        "<i>Index of pixels</i> is a layer of points: the ground that every n-th pixel shows, with "
        "column and row in the picture, from 0, 0 at the upper left, distance, altitude and class.")

    def declare(self):
        for name, text in (("PANORAMA", "Picture"), ("GUIDANCE", "Guidance buffers")):
            self.addOutput(core.QgsProcessingOutputFile(name, text))
        return [
            *scene(0),
            parameter("Boolean", "DRAFT", "Draft", False),
            parameter("Boolean", "LOAD", "Load the picture", True),
            number("STEP", "Index of pixels: every n-th", 8, 1, 1000),
            parameter("FolderDestination", "OUTPUT", "Folder"),
            parameter("FeatureSink", "INDEX", "Index of pixels", compat.POINTS, None, True, False)]

    def work(self, feedback):
        folder = self.text("OUTPUT")
        asked = ["render", *self.scene_words(), "--out", folder]
        answer = program.ask(asked + (["--draft"] if self.yes("DRAFT") else []), feedback)
        files = {os.path.basename(file["path"]): file["path"] for file in answer["files"]}
        results = {"OUTPUT": folder, "GUIDANCE": files["guidance.exr"]}
        shown = [files[name] for name in PICTURES if name in files]
        if shown:
            results["PANORAMA"] = shown[0]
            if self.yes("LOAD"):
                guidance_buffers.load_picture(shown[0], answer["scene"], self.context)
        if self.given("INDEX"):
            results["INDEX"] = self._write_index(files["guidance.exr"], feedback)
        return results

    def _write_index(self, path: str, feedback) -> str:
        ground, step = guidance_buffers.read(path, INDEX_CHANNELS, feedback), self.whole("STEP")
        fields = {"column": "Int", "row": "Int", "distance_m": "Double", "altitude_m": "Double",
                  "class": "String"}
        add, layer = self.sink("INDEX", fields, compat.WKB_POINT, ground.crs)
        first = step // 2  # the middle of each square of pixels
        rows, columns = np.nonzero(np.isfinite(ground.east[first::step, first::step]))
        for y, x in zip(rows * step + first, columns * step + first):
            distance, altitude, cover = (ground.others[name][y, x] for name in INDEX_CHANNELS)
            place = core.QgsPointXY(ground.east[y, x], ground.north[y, x])
            add(core.QgsGeometry.fromPointXY(place), int(x), int(y), round(float(distance), 1),
                round(float(altitude), 1), ground.classes[int(cover)])
        feedback.pushInfo(f"index of pixels: {len(rows)} points")
        return layer
