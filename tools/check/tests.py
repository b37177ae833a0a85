"""Tests mirror the tree: every .cpp has tests/<folder>/<unit>_test.cpp, or a row below that names the test of it, with the reason."""
import re
import subprocess

import tree

# Unit, or its beginning with a * at the end: its test, below tests/, and the reason. A unit with its own test needs no row.
tested_by = {
    "renderer/image/image_file": ("renderer/image/image_io", "limits and notes of all formats, tested on each: ReadPicture"),
    "renderer/stages/ground_stages": ("renderer/stages/stages", "TheArchitecturePageDrawsThem"),
    "renderer/stages/picture_stages": ("renderer/stages/stages", "TheArchitecturePageDrawsThem"),
    "renderer/pipeline/picture_legend":
        ("renderer/pipeline/named_picture", "TheMarginLiesAroundThePicture: classes seen, in their colours"),
    "renderer/scene/edit/edited_text*":
        ("renderer/scene/edit/scene_edit", "the text after each kind of change: ReplacesValues, AddsKeys, AddsElements, Removes"),
    "tools/studio/answers":
        ("tools/studio/studio_pictures", "each answer where it is asked for: TellsWhatIsUnderThePointer, HasAMap, JudgesTheView …"),
    "tools/cli/studio/serve_page":
        ("tools/cli/studio/command_studio", "ServesTheSceneUntilItIsInterrupted; of the other page: command_exemplar_pick_test"),
    "terrain/climate/climate_at": ("terrain/climate/climate", "a climate's value at a place, as the map was made"),
    "terrain/cover/class_rules_inputs": ("terrain/cover/class_rules", "the ground that rules ask for is tested by the rules that ask"),
    "terrain/cover/rule_expression_run":
        ("terrain/cover/rule_expression", "runs what rule_expression.cpp reads: values are tested as written"),
    "terrain/generalize/generalize_band": ("terrain/generalize/generalize_analytic", "gain and equations of one band, in closed form"),
    "terrain/generalize/stripe_fit": ("terrain/generalize/destripe", "what is fitted is what is taken off"),
    "terrain/io/gdal/contours": ("terrain/io/contours", "GDAL's side of contours.h; tests stand where its header does"),
    "terrain/io/gdal/crs": ("terrain/io/raster_io", "GDAL's side of crs.h: PointsAreLongitudeFirst, …UtmZone, …NotTakenForMetres"),
    "terrain/io/gdal/gdal_files": ("terrain/io/raster_faults", "which formats may be opened: VrtOnlyWhereItIsNamedSo…"),
    "terrain/io/gdal/http_access": ("terrain/io/http_access", "GDAL's side of http_access.h"),
    "terrain/io/gdal/feature_layers": ("terrain/io/features", "GDAL's side of features.h"),
    "terrain/io/gdal/vector_layers": ("terrain/io/points", "what GDAL's sides of points.h and features.h share"),
    "terrain/io/gdal/raster_*": ("terrain/io/raster_io", "GDAL's side of raster_io.h: round trips, damaged files, nodata, limits"),
    "terrain/io/warp": ("terrain/io/raster_io", "Reprojection…, TilesJoin…, FinerSourcesAreAveraged; values between cells: resample_test"),
    "terrain/layers/surface_layers": ("terrain/layers/layer_coverage", "TablesAndHatsEqualTheirDefinition; checks: layers_file_test"),
    "terrain/layers/fit/textured_layers": ("terrain/layers/fit/fit_texture", "the textures found, as layers paint them"),
    "terrain/synthetic/synthetic_*":
        ("terrain/synthetic/synthetic", "steps to one terrain, whose ridges, valleys and lakes are measured whole"),
    "texture/quality/picture_measures": ("texture/quality/quality", "each measure is tested where the report takes it"),
    "texture/quality/quality_parts": ("texture/quality/quality", "what the measures have in common"),
    "tools/report/style_*": ("tools/cli/command_style_fit", "WritesAStyleAndItsPage"),
    "texture/strokes/ice/ice_ground": ("texture/strokes/ice/ice_plan", "IceGround"),
    "texture/strokes/ice/ice_moraines": ("texture/strokes/ice/ice_plan", "Moraines"),
    "texture/strokes/stroke_parts":
        ("texture/strokes/stroke_painter", "what kinds of strokes have in common: StrokesCurveSlightly…, StrokesGrowWithTheSheet, air"),
    "texture/strokes/stroke_seeds":
        ("texture/strokes/stroke_painter", "what a stroke begins with: LightSideFollowsTheSun, RockIsPaintedDownItsPlanes"),
    "texture/strokes/stroke_trees": ("texture/strokes/stroke_wood", "SpruceIsPointedLeafyCrownIsRound and its neighbours"),
    "texture/strokes/stroke_forest": ("texture/strokes/stroke_wood", "trees of a forest in belts and groups, its edges: Wood"),
    "texture/synthesis/synth_*":
        ("texture/synthesis/synth_kernel", "states and steps of one search, held against a plain one of the same meaning"),
    "renderer/exemplar/example_sheet_plan":
        ("renderer/exemplar/example_sheet", "plans are tested beside the sheets they make: ExampleSheetPlan"),
    "renderer/exemplar/exemplar_files": ("renderer/exemplar/example_sheet", "files of a sheet beside the sheet they hold: ExemplarFiles"),
    "renderer/exemplar/scan_colours": ("renderer/exemplar/scan", "palettes with the colours of the paintings read there"),
    "renderer/features/line_samples":
        ("renderer/features/drawn_features", "samples and widths, where lines are drawn: AStraightRoad…, AWallHides…"),
    "renderer/image/deflate": ("renderer/image/image_io", "packs tiles of TIFF and OpenEXR, whose own libraries read them back there"),
    "renderer/image/icc/lcms":
        ("renderer/image/icc/press_colour", "owners and faults of lcms2, by the profiles read there and in icc_test"),
    "renderer/image/layers/layer_png": ("renderer/image/layers/layer_file", "pictures in an archive, read by OpenImageIO"),
    "renderer/image/layers/psd_file": ("renderer/image/layers/layer_file", "a row of its table: PhotoshopHoldsItsLayers, LargePictures…"),
    "renderer/image/oiio_file": ("renderer/image/image_io", "OpenImageIO's side of image_io.h: Png, ReadPicture"),
    "renderer/image/png_*":
        ("renderer/image/image_io", "PNG where OpenImageIO is not enough: TruncatedFilesAreFound, PaletteGivesIndices…"),
    "renderer/image/tiff_file": ("renderer/image/image_io", "libtiff's side of image_io.h: Tiff"),
    "renderer/scene/scene_rules": ("renderer/scene/scene_file", "KeysThatExcludeEachOther, KeysThatBelongTogether"),
    "renderer/scene/scene_schema": ("renderer/scene/scene_file", "ReferenceAndSchemaAreTheCommittedOnes, EveryKeyIsDocumented"),
    "renderer/scene/scene_table_*": ("renderer/scene/scene_table", "rows of one table, which the tests go through"),
    "renderer/scene/scene_text": ("renderer/scene/scene_file", "WrittenScenesReadBack"),
    "renderer/trace/guidance_rays": ("renderer/trace/guidance", "places and directions of a pixel's rays"),
    "tools/cli/layers/fit_sources": ("tools/cli/layers/command_layers_fit", "pictures and maps that a fit reads, and those it refuses"),
    "tools/cli/layers/ground_climate_options":
        ("tools/cli/layers/command_layers_apply", "the same options of apply and fit: ClimateIsComputed… and its neighbours"),
    "tools/fuzz/fuzz": ("tools/fuzz/targets", "libFuzzer's driver of the same table; tools/check_all fuzz runs it"),
    "tools/report/layers_fit_page": ("tools/cli/layers/command_layers_fit", "ReportHoldsItsPage"),
    "tools/cli/texture/command_texture_correct": ("tools/cli/texture/command_texture_learn", "CorrectedPicturesHaveTheColoursOfTheOther"),
    "tools/cli/texture/command_texture_fill": ("tools/cli/texture/command_texture_learn", "…MadeWithoutEnd, RemovesWhatIsMarked…, PlantsACrop…"),
    "tools/cli/texture/command_texture_seam":
        ("tools/cli/texture/command_texture_learn", "JoinsPicturesAndNothingElse, beside the others that need models"),
    "tools/cli/texture/command_texture_make":
        ("tools/cli/texture/command_texture_learn", "IsLearntAndMadeWithoutEnd: one test, because it makes what was learnt"),
}

# Folder: why it has no tests.
untested = {
    "tools/bench/": "prints times, which cannot be tested; the measured code has its own tests",
    "tools/python/": "tested in Python, through the package: tools/python/tests",
    "tools/lab/": "accuracy trials, which print tables; the measured code has its own tests",
}


def row_of(unit):
    """The row that names the unit, else the one with its longest beginning."""
    fits = [row for row in tested_by if row == unit or (row.endswith("*") and unit.startswith(row[:-1]))]
    return max(fits, key=lambda row: (row == unit, len(row)), default=None)


def named(unit):
    return f"tests/{unit}_test.cpp"


def test_of(unit):
    """The test of a unit: that of its row if it has none of its own."""
    row = row_of(unit)
    return named(unit) if tree.exists(named(unit)) or row is None else named(tested_by[row][0])


def suites(test):
    return set(re.findall(r"^(?:TEST|TEST_F|TEST_P)\((\w+),", tree.text(test), re.M))


def filter_of(chosen):
    """These suites as a filter of GoogleTest, with their instances of parameters."""
    return ":".join(f"{suite}.*:*/{suite}.*" for suite in sorted(chosen))


def changed_tests():
    """Tests of the units that changed since the last commit, or in it if nothing did. A header counts as the unit it belongs to."""

    def git(*words):
        names = subprocess.run(["git", *words], cwd=tree.root, capture_output=True, text=True, check=True).stdout.split("\n")
        return [name for name in names if name.endswith((".cpp", ".h")) and name.startswith(tree.tops)]

    changed = git("diff", "--name-only", "HEAD") + git("ls-files", "--others", "--exclude-standard")
    changed = changed or git("diff", "--name-only", "HEAD~1", "HEAD")
    tests = {name if name.startswith("tests/") else test_of(tree.unit_of(name)) for name in changed}
    return sorted(test for test in tests if test.endswith("_test.cpp") and tree.exists(test))


def check_tests():
    faults, used = [], set()
    units = [tree.unit_of(name) for name in tree.sources(".cpp", tree.layers)]
    for unit in units:
        if unit.startswith(tuple(untested)) or tree.exists(named(unit)):
            continue
        used.add(row_of(unit))
        if row_of(unit) is None:
            faults.append(f"{unit}.cpp: there is neither {named(unit)} nor a row in tools/check/tests.py")
    for row, (test, reason) in tested_by.items():
        if row not in used:
            faults.append(f"{row}: unused row of tools/check/tests.py")
        if not tree.exists(named(test)):
            faults.append(f"{row}: tools/check/tests.py names {named(test)}, which does not exist")
            continue
        # Tests named in reasons must exist.
        for name in re.findall(r"[A-Z][a-z]+[A-Z][A-Za-z]+", reason):
            if name not in tree.text(named(test)) and name not in ("OpenImageIO", "OpenEXR"):
                faults.append(f"{row}: {named(test)} has no test named {name}")
    faults += [f"{folder}: a row for a missing folder" for folder in untested if not tree.exists(folder)]
    return faults, f"{len(units)} units, {len(used)} rows of tests elsewhere, {len(faults)} errors"
