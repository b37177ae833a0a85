"""Names from a layer: its names as [[labels.points]] or [[labels.shapes]] of a scene."""
import os
import tempfile
from pathlib import Path

from osgeo import gdal

from . import compat, layers, program, scene_file
from .algorithm import Algorithm, Error, parameter, scene, scene_out, words

COUNTS = ("no_room", "hidden", "outside_picture", "behind_eye", "outside_terrain")


class NamesFromLayer(Algorithm):
    """A scene with the names of a layer, placed by the program."""

    NAME, TITLE = "namesfromlayer", "Names from a layer"
    HELP = (
        "Adds names to a scene, of which <i>Render panorama</i> then writes a second picture with "
        "the names. Names of points stand at their marks, those of lines and areas follow them.\n"
        "Kinds are words of the style: summit, town, village, hut, pass, lake, river, glacier, "
        "valley, range … Ranks are 1 (most important) to 9.")

    def declare(self):
        return [
            *scene(),
            parameter("VectorLayer", "LAYER", "Layer", [compat.VECTORS]),
            parameter("Field", "NAME", "Field with the names", "name", "LAYER"),
            parameter("Field", "RANK", "Field with the ranks", None, "LAYER", optional=True),
            parameter("Field", "KIND", "Field with the kinds", None, "LAYER", optional=True),
            words("ALL", "Kind of all, without such a field"),
            scene_out("Scene with them")]

    def prepare(self, feedback):
        layer = self.parameterAsVectorLayer(self.values, "LAYER", self.context)
        file = layers.vector_file(layer, self.out_file())
        self.file = layers.name_beside(layer.name(), self.out_file(), "_names.gpkg")
        self.points = layer.geometryType() == compat.POINT_GEOMETRY
        if self._write(file, layer.subsetString()) == 0:
            raise Error(f'No feature of "{layer.name()}" has a name.')

    def _write(self, file: layers.LayerFile, where: str) -> int:
        """A file with the columns that the program reads; the number of names. Each part of a
        geometry has the name."""
        column = {key: '"' + self.text(key).replace('"', '""') + '"'
                  for key in ("NAME", "RANK", "KIND") if self.given(key)}
        kind = "'" + self.text("ALL").replace("'", "''") + "'" if self.given("ALL") else ""
        chosen = [f"{column['NAME']} AS name"]
        chosen += [f"{column['RANK']} AS rank"] if "RANK" in column else []
        chosen += [f"{column.get('KIND') or kind} AS kind"] if "KIND" in column or kind else []
        source = gdal.OpenEx(file.path, gdal.OF_VECTOR)
        inside = file.inside or source.GetLayer(0).GetName()
        where = f" AND ({where})" if where else ""
        names = gdal.VectorTranslate(
            self.file, source, options=["-explodecollections"], format="GPKG", layerName="names",
            geometryType="GEOMETRY", srcSRS=file.crs or None, dstSRS=file.crs or None,
            SQLStatement=f'SELECT {", ".join(chosen)} FROM "{inside}" '
                         f"WHERE {column['NAME']} IS NOT NULL{where}")
        if names is None:
            raise Error(f"{self.file} cannot be written: {gdal.GetLastErrorMsg()}")
        return names.GetLayer(0).GetFeatureCount()

    def work(self, feedback):
        path, out = self.scene_path(), self.out_file()
        table = "[[labels.points]]" if self.points else "[[labels.shapes]]"
        text = scene_file.block(table, file=os.path.basename(self.file))
        if "[labels]" not in Path(path).read_text(encoding="utf-8"):
            text = scene_file.block("[labels]", in_picture=True) + text
        scene_file.extend(path, out, text, self.data_folders())
        asked = [word for name in scene_file.data_folders(out) for word in ("--data", name)]
        with tempfile.TemporaryDirectory() as folder:
            answer = program.ask(["labels", out, *asked, "--out", folder], feedback)
        others = [f"{answer[name]} {name.replace('_', ' ')}" for name in COUNTS if answer.get(name)]
        placed = f"{answer['placed']} of {answer['points']} names placed"
        feedback.pushInfo(", ".join([placed, *others]))
        return {"OUTPUT": out}
