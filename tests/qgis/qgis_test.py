"""The plugin of QGIS as users run it, by qgis_process without windows, and its parts:
xvfb-run /usr/bin/python3 tests/qgis/qgis_test.py. BELVEDERE_PROGRAM names the program."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import tomllib
import unittest
import zipfile

sys.dont_write_bytecode = True  # nothing is left in the checkout
root = pathlib.Path(__file__).resolve().parents[2]
program_path = os.environ.get("BELVEDERE_PROGRAM", str(root / "build/release/belvedere"))
data = pathlib.Path(os.environ.get("BELVEDERE_DATA", root.parent / "shared/data"))
# Debian 12's wrapper passes an option that the program does not know.
qgis_process = shutil.which("qgis_process.bin") or shutil.which("qgis_process")
folder = pathlib.Path(tempfile.mkdtemp(prefix="belvedere_qgis_"))
os.environ |= {"BELVEDERE_PROGRAM": program_path, "QGIS_CUSTOM_CONFIG_PATH": str(folder / "qgis"),
               "BELVEDERE_CACHE": str(folder / "cache"), "PYTHONDONTWRITEBYTECODE": "1"}
for missing, what in ((qgis_process, "QGIS (tools/setup qgis)"), (
        shutil.which(program_path), f"the program {program_path}"), (data.is_dir(), f"{data}")):
    if not missing:
        print(f"SKIPPED, nothing of the QGIS plugin is tested: {what} is missing", file=sys.stderr)
        sys.exit(77)

import numpy as np  # noqa: E402
from osgeo import gdal, ogr  # noqa: E402
from qgis import core  # noqa: E402
from start import start  # noqa: E402

app, processing, provider = start()
from belvedere_panorama import (  # noqa: E402
    exr, features_from_layers, generalize_dem, kinds, legends, new_panorama, program, scene_file,
    view_on_map)

gdal.UseExceptions()
dem, cover, scene = (str(folder / name) for name in ("dem.tif", "cover.tif", "scene.toml"))
waters, ways = ({"type": "Feature", "properties": tags, "geometry": shape} for tags, shape in (
    ({"natural": "water", "name": "Seelein"}, {"type": "Polygon", "coordinates": [[
        [11.39, 47.40], [11.41, 47.40], [11.41, 47.41], [11.39, 47.40]]]}),
    ({"highway": "track", "name": "Weg"}, {"type": "LineString", "coordinates": [
        [11.30, 47.42], [11.42, 47.38], [11.50, 47.44]]})))


def run(name, **parameters):
    """What qgis_process says of an algorithm."""
    words = [f"{key}={value}" for key, value in parameters.items()]
    done = subprocess.run([qgis_process, "run", f"belvedere:{name}", "--", *words],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(done.stdout + done.stderr)
    return done.stdout


def ask(*arguments):
    return json.loads(subprocess.run([program_path, *arguments, "--json"], check=True,
                                     capture_output=True).stdout)


def features(path):
    """Geometries and attributes of a file."""
    file = ogr.Open(str(path))
    return [(row.GetGeometryRef().Clone(), row.items()) for row in file.GetLayer(0)]


def setUpModule():
    """The plugin as it is installed from its package; ground of the Karwendel, and land cover by
    its altitude; a scene of both."""
    package = subprocess.run([root / "tools/qgis/package", folder / "plugin.zip"], check=True,
                             capture_output=True, text=True).stdout.strip()
    with zipfile.ZipFile(package) as file:
        file.extractall(folder / "qgis/profiles/default/python/plugins")
    subprocess.run([qgis_process, "plugins", "enable", "belvedere_panorama"], check=True,
                   capture_output=True)
    gdal.Translate(dem, str(data / "innsbruck/innsbruck_utm32_30m.tif"), xRes=90, yRes=90,
                   projWin=[670000, 5270000, 692000, 5245000], resampleAlg="average")
    source = gdal.Open(dem)
    altitude = source.ReadAsArray()
    file = gdal.GetDriverByName("GTiff").CreateCopy(cover, gdal.Translate(
        "", source, format="MEM", outputType=gdal.GDT_Byte, noData=0))
    file.GetRasterBand(1).WriteArray(np.select(
        [altitude < 1000, altitude < 1800, altitude < 2200], [40, 10, 30], 60))
    file = None
    for name, feature in (("waters", waters), ("ways", ways)):
        (folder / f"{name}.geojson").write_text(json.dumps(
            {"type": "FeatureCollection", "features": [feature]}), encoding="utf-8")
    said = run("newpanorama", DEM=dem, LAND_COVER=cover, OUTPUT=scene, TITLE="Karwendel",
               LOOK="11.40,47.40 [EPSG:4326]")
    assert "legend of the land cover: esa_worldcover" in said, said


def tearDownModule():
    shutil.rmtree(folder)


class Algorithms(unittest.TestCase):
    """Each once, on a small picture."""

    def test_new_writes_the_scene(self):
        with open(scene, "rb") as file:
            keys = tomllib.load(file)
        self.assertEqual(keys["title"], "Karwendel")
        self.assertEqual(keys["land_cover"]["legend"], "esa_worldcover")

    def test_new_stands_and_looks(self):
        out = folder / "elsewhere/view.toml"
        out.parent.mkdir()
        run("newpanorama", DEM=dem, OUTPUT=out, STAND="675000,5268000 [EPSG:32632]",
            LOOK="11.40,47.36 [EPSG:4326]")
        camera = tomllib.loads(out.read_text(encoding="utf-8"))["camera"]
        np.testing.assert_allclose(camera["position"], [675000, 5268000], atol=1)
        self.assertLess(abs(camera["azimuth_deg"] - 165), 17)  # 15° are allowed, and rounding
        self.assertEqual(scene_file.data_folders(str(out)), [str(folder)])
        self.assertTrue(ask("check", str(out), "--data", str(folder))["valid"])

    def test_render_and_index(self):
        out, index = folder / "render", folder / "index.gpkg"
        said = run("renderpanorama", SCENE=scene, WIDTH=240, OUTPUT=out, INDEX=index, STEP=6)
        self.assertIn("90...100", said)  # progress passes through
        self.assertEqual(gdal.Open(str(out / "panorama.tif")).RasterXSize, 240)
        rows = features(index)
        self.assertGreater(len(rows), 300)
        for here, row in [row for row in rows if row[1]["distance_m"] < 15000][::20]:
            pixel = f"{row['column'] + 0.5},{row['row'] + 0.5}"
            place = ask("deform", scene, "--at", pixel, "--set", "output.width=240", "--set",
                        "output.height=120", "--set", "generalize.widen_valleys_m=0")["shown"][0]
            apart = np.hypot(*np.subtract(place["place"], [here.GetX(), here.GetY()]))
            self.assertLess(apart, 600)  # valleys are widened by 300 m, a pixel shows 100 m

    def test_guidance(self):
        out = folder / "guidance"
        run("guidancebuffers", SCENE=scene, WIDTH=100, OUTPUT=out, CHANNELS="Z,landcover.id",
            LOAD=True)
        self.assertEqual(ask("info", str(out / "guidance.exr"))["width"], 100)
        file = gdal.Open(str(out / "guidance.tif"))
        self.assertEqual([file.GetRasterBand(i).GetDescription() for i in (1, 2)],
                         ["Z", "landcover.id"])
        distance, classes = file.ReadAsArray()
        np.testing.assert_array_equal(np.isinf(distance), classes == 0)  # 0 is sky
        picture = ask("check", scene)["classes"]
        self.assertAlmostEqual((classes == 4).mean(), picture["forest"], delta=0.03)

    def test_generalize(self):
        out = folder / "smooth.tif"
        run("generalizedem", DEM=dem, OUTPUT=out, PRESET=1)
        before, after = (gdal.Open(str(name)).ReadAsArray() for name in (dem, out))
        self.assertGreater(np.abs(after - before).max(), 5)
        layer = core.QgsRasterLayer(str(out))
        generalize_dem.show_as_relief(layer)
        self.assertEqual(layer.renderer().type(), "hillshade")

    def test_features_and_names(self):
        out = folder / "more.toml"
        said = run("featuresfromlayers", SCENE=scene, LAYERS=folder / "ways.geojson", OUTPUT=out)
        self.assertRegex(said, "track 1: 1 (drawn|hidden)")
        layer = core.QgsVectorLayer("Polygon?crs=EPSG:4326&field=natural:string", "Lakes", "memory")
        source = core.QgsVectorLayer(str(folder / "waters.geojson"))
        layer.dataProvider().addFeatures(source.getFeatures())  # of no file
        processing.run("belvedere:featuresfromlayers",
                       {"SCENE": str(out), "LAYERS": [layer], "OUTPUT": str(out)})
        run("namesfromlayer", SCENE=out, LAYER=folder / "waters.geojson", NAME="name", ALL="lake",
            OUTPUT=out)
        keys = tomllib.loads(out.read_text(encoding="utf-8"))
        self.assertEqual([block["source"] for block in keys["features"]],
                         ["ways.geojson", "more_Lakes.gpkg"])
        self.assertEqual(keys["features"][0]["where"], "(\"highway\" IN ('track'))")
        self.assertTrue(keys["labels"]["in_picture"])
        (_, name), = features(folder / keys["labels"]["shapes"][0]["file"])
        self.assertEqual((name["name"], name["kind"]), ("Seelein", "lake"))

    def test_view_on_map(self):
        out = {name: folder / f"{name}.gpkg" for name in ("CONE", "VISIBLE")}
        run("viewonmap", SCENE=scene, WIDTH=600, SETTINGS="generalize.widen_valleys_m=0", **out)
        cone, seen = ([shape for shape, _ in features(name)] for name in out.values())
        eye = ask("check", scene)["eye"]
        self.assertEqual(cone[0].GetGeometryRef(0).GetPoint_2D(0), tuple(eye[:2]))
        # What the program says of places on a grid. Slivers thinner than a pixel are missing.
        places = [(x, y) for x in range(671000, 691000, 1000) for y in range(5246000, 5269000, 1000)]
        words = [word for place in places for word in ("--locate", "{},{}".format(*place))]
        told = ask("deform", scene, *words, "--set", "generalize.widen_valleys_m=0")["located"]
        inside = np.array([any(part.Contains(ogr.CreateGeometryFromWkt("POINT ({} {})".format(*at)))
                               for part in seen) for at in places])
        visible = np.array([answer["visible"] for answer in told])
        self.assertGreater(visible.sum(), 50)
        self.assertGreater(inside[visible].mean(), 0.75)
        self.assertLess(inside[~visible].mean(), 0.01)


class WrongInput(unittest.TestCase):
    """Each is told, with what to do."""

    def fails(self, name, words, **parameters):
        log = core.QgsProcessingFeedback(False)
        with self.assertRaises(core.QgsProcessingException) as raised:
            processing.run(f"belvedere:{name}", parameters, feedback=log)
        self.assertRegex(f"{raised.exception}\n{log.textLog()}", words)

    def test_no_program(self):
        os.environ["BELVEDERE_PROGRAM"] = "/no/program"
        self.addCleanup(os.environ.update, BELVEDERE_PROGRAM=program_path)
        can, why = provider.algorithm("newpanorama").canExecute()
        self.assertFalse(can)
        self.assertIn("apt-get install", why)
        with self.assertRaisesRegex(AssertionError, "The program belvedere was not found"):
            run("newpanorama", DEM=dem, OUTPUT=folder / "never.toml")

    def test_no_coordinate_system(self):
        bare = str(folder / "bare.asc")
        gdal.Translate(bare, dem, format="AAIGrid")
        pathlib.Path(bare).with_suffix(".prj").unlink(missing_ok=True)
        pathlib.Path(bare + ".aux.xml").unlink(missing_ok=True)
        layer = core.QgsRasterLayer(bare)
        layer.setCrs(core.QgsCoordinateReferenceSystem())
        self.fails("newpanorama", "has no coordinate system", DEM=layer,
                   OUTPUT=str(folder / "never.toml"))

    def test_other(self):
        self.fails("renderpanorama", "there is no such scene", SCENE="no.toml", OUTPUT=str(folder))
        self.fails("guidancebuffers", "unknown key", SCENE=scene, SETTINGS="camera.hight_m=1",
                   OUTPUT=str(folder / "never"))
        self.fails("newpanorama", "No built-in legend", DEM=dem, LAND_COVER=dem,
                   OUTPUT=str(folder / "never.toml"))

    def test_cancelled(self):
        deaf = folder / "deaf"
        deaf.write_text(f"#!/bin/sh\ntrap '' TERM\necho $$ > {folder}/pid\n"
                        "while :; do sleep 0.1; done\n", encoding="utf-8")
        deaf.chmod(0o755)
        for path, words in ((program_path, ["render", scene]), (str(deaf), [])):
            os.environ["BELVEDERE_PROGRAM"] = path
            self.addCleanup(os.environ.update, BELVEDERE_PROGRAM=program_path)
            feedback = core.QgsProcessingFeedback()
            threading.Timer(0.5, feedback.cancel).start()
            begin = time.monotonic()
            with self.assertRaisesRegex(core.QgsProcessingException, "ended by request"):
                program.run([*words, "--out", str(folder / "cancelled")], feedback)
            self.assertLess(time.monotonic() - begin, 1.5)  # a second after the request
        with self.assertRaises(ProcessLookupError):
            os.kill(int((folder / "pid").read_text(encoding="utf-8")), 0)


class Parts(unittest.TestCase):
    """What the plugin knows of the program's files."""

    def test_tables_are_those_of_the_program(self):
        for name, codes in legends.CODES.items():
            keys = tomllib.loads((root / f"data/legends/{name}.toml").read_text(encoding="utf-8"))
            known = {int(code) for code in keys["codes"]}
            known |= {row["also"] for row in keys["codes"].values() if "also" in row}
            self.assertEqual((codes, legends.NO_DATA[name]), (known, set(keys["nodata"])), name)
        styles = {path.stem for path in (root / "data/styles").glob("*.toml")}
        self.assertEqual(set(new_panorama.STYLES[1:]), styles)
        style = tomllib.loads((root / "data/features/classic.toml").read_text(encoding="utf-8"))
        self.assertEqual({kind: row["also"] for kind, row in style["kinds"].items()},
                         {**kinds.LINES, **kinds.AREAS})

    def test_legends(self):
        for values, name, legend in (
                ({10, 30, 60, 80, 0}, "cover", "esa_worldcover"), ({11, 41, 42, 71}, "", "nlcd"),
                ({2, 12, 23, 44}, "", "corine"), ({112, 211, 523}, "", "corine"),
                ({12, 23, 41}, "U2018_CLC2018", "corine"), ({12, 23, 41}, "", "nlcd"),
                ({98, 102, 165}, "", "fbfm40"), ({0}, "", None), ({7, 300}, "nlcd", None)):
            self.assertEqual(legends.infer(values, name), legend, f"{values} {name}")

    def test_kinds(self):
        self.assertEqual(kinds.of_column("landuse", ["forest", "residential", "quarry"], "area"), [
            kinds.Kinds("", "landuse", "\"landuse\" IN ('forest')"),
            kinds.Kinds("town", "", "\"landuse\" IN ('residential')")])
        texts = ['"railway"=>"rail","piste:difficulty"=>"easy"', '"surface"=>"grass"']
        self.assertEqual([part.kind for part in kinds.of_tags(texts, "line")],
                         ["run_easy", "railway"])
        self.assertEqual(kinds.of_name("Rivers of Tyrol", "line"), "river")
        self.assertEqual(kinds.of_name("Seen 2020", "area"), "lake")
        self.assertIsNone(kinds.of_name("Measurements", "line"))
        layer = core.QgsVectorLayer("LineString?field=type:string", "x", "memory")
        with self.assertRaisesRegex(core.QgsProcessingException, "Nothing tells"):
            features_from_layers.infer(layer, "")
        self.assertEqual(features_from_layers.infer(layer, "road")[0].kind, "road")

    def test_size_of_a_scene(self):
        path = folder / "size.toml"
        for text, size in (("version = 1\n", (2400, 1100)), (
                "[output]  # of the sheet\nwidth = 600\n# height = 1\n[margin]\nheight = 7\n",
                (600, 1100)), ("[exemplar]\nwidth = 5\n[output]\nheight = 90\n", (2400, 90))):
            path.write_text(text, encoding="utf-8")
            self.assertEqual(scene_file.size(str(path)), size)

    def test_visible_cells(self):
        # A step of 20 between rows whose pixels cover 1 m is an edge: nothing between is seen.
        north = np.array([[24.0, 24], [23, 23], [3, 3], [2, 2]])
        east = np.array([[0.0, 5]] * 4)
        seen, left, top = view_on_map.cells_of(east, north, np.full((4, 2), 2.0), 1.0)
        self.assertEqual((seen.shape, left, top), ((23, 6), 0.0, 24.0))
        np.testing.assert_array_equal(np.flatnonzero(seen.all(1)), [0, 1, 21, 22])

    def test_other_files_are_no_guidance(self):
        with self.assertRaisesRegex(ValueError, "no OpenEXR file"):
            exr.read(dem, ["Z"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
