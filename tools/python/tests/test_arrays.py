"""Functions of arrays: results equal the files of the command line, nothing is copied or changed."""

import numpy as np
import pytest
from conftest import hill, write_asc
from PIL import Image

import belvedere
from belvedere import _arrays

rasterio = pytest.importorskip("rasterio")


def read(path):
    with rasterio.open(path) as file:
        return file.read(1)


def paint(width, height, seed=3):
    """Strokes of two kinds of colour, left and right, and their labels."""
    random = np.random.default_rng(seed)
    picture = random.integers(0, 60, (height, width, 3), np.uint8)
    picture[:, : width // 2, 1] += 120
    picture[:, width // 2 :, 2] += 150
    labels = np.zeros((height, width), np.uint8)
    labels[:, width // 2 :] = 1
    return picture, labels


@pytest.mark.parametrize("preset", list(belvedere.generalize_presets()))
def test_generalize_equals_the_file(program, tmp_path, preset):
    cells = hill()
    write_asc(tmp_path / "dem.asc", cells)
    viewer = (4500.0, -9000.0)  # from the lower left corner, 600000 5200000
    program("generalize", tmp_path / "dem.asc", tmp_path / "out.tif", "--preset", preset, "--viewer", "604500,5191000")
    own = belvedere.generalize(cells, 100.0, preset=preset, viewer=viewer)
    np.testing.assert_array_equal(own, read(tmp_path / "out.tif"))
    assert (own != cells).any()
    np.testing.assert_array_equal(cells, hill())


def test_generalize_takes_other_arrays():
    cells = hill()
    same = belvedere.generalize(cells, (100, 100), weights=[1, 0.5, 0])
    turned = np.asfortranarray(cells.astype(np.float64))
    np.testing.assert_array_equal(belvedere.generalize(turned, 100, weights=[1, 0.5, 0], threads=1), same)
    np.testing.assert_array_equal(belvedere.generalize(cells, 100, weights=[1, 1]), cells)
    unchanged = belvedere.generalize(cells, 100, weights=[1, 0.5, 0], mask=np.zeros_like(cells))
    np.testing.assert_array_equal(unchanged, cells)
    voids = np.ma.masked_greater(cells, 1300)
    holed = belvedere.generalize(voids, 100, weights=[1, 0.5, 0])
    np.testing.assert_array_equal(np.isnan(holed), voids.mask)
    with pytest.raises(belvedere.Error) as shape:
        belvedere.generalize(cells[0], 100, preset="smooth_slopes")
    assert shape.value.position == "altitude_m" and shape.value.remedy == "an array of float32, shape (height, width)"
    with pytest.raises(belvedere.Error, match="cell_m"):
        belvedere.generalize(cells, 0, preset="smooth_slopes")
    with pytest.raises(belvedere.Error, match="preset"):
        belvedere.generalize(cells, 100, preset="rough")


def test_arrays_of_the_right_layout_are_not_copied():
    cells, picture = hill(), paint(20, 10)[0]
    assert np.shares_memory(_arrays.altitudes(cells), cells)
    assert np.shares_memory(_arrays.altitudes(cells[3:]), cells)
    assert not np.shares_memory(_arrays.altitudes(cells[:, 3:]), cells)
    assert np.shares_memory(_arrays.picture(picture, ""), picture)
    assert not belvedere.generalize(cells, 100, weights=[1, 0]).flags.owndata  # the library's memory
    cells.setflags(write=False)
    belvedere.generalize(cells, 100, weights=[1, 0], destripe=True)


def test_deform_moves_as_its_formulas_say(program, tmp_path):
    cells = hill()
    flat = belvedere.deform(cells, 100.0, (4500, -9000))
    assert flat.shape == (90, 90, 3) and flat.dtype == np.float32
    np.testing.assert_array_equal(flat[..., 2], cells)
    np.testing.assert_array_equal(flat[0, :3, 0], [50, 150, 250])
    np.testing.assert_array_equal(flat[-1, :, 1], 50)
    moved = belvedere.deform(
        cells, 100.0, (4500, -9000), exaggeration=1.5, bend={"radius_m": 50000, "crest_m": 6000}
    )
    distance = np.hypot(flat[..., 0] - 4500, flat[..., 1] + 9000)
    expected = 1.5 * cells - (distance - 6000) ** 2 / (2 * 50000)
    np.testing.assert_allclose(moved[..., 2], expected, atol=0.01)
    np.testing.assert_array_equal(moved[..., :2], flat[..., :2])
    write_asc(tmp_path / "dem.asc", cells)
    (tmp_path / "dem.prj").write_text(rasterio.crs.CRS.from_epsg(32632).to_wkt())
    program(
        *("deform", tmp_path / "dem.asc", tmp_path / "out.tif", "--viewer", "604500,5191000", "--exaggeration", 1.5),
        *("--set", "deform.bend.radius_m=50000", "--set", "deform.bend.crest_m=6000"),
    )
    raster = belvedere.deform(
        cells, 100.0, (4500, -9000), raster=True, exaggeration=1.5, bend={"radius_m": 50000, "crest_m": 6000}
    )
    np.testing.assert_allclose(raster, read(tmp_path / "out.tif"), atol=1e-3)  # other coordinates are rounded elsewhere
    with pytest.raises(belvedere.Error, match="deform.exaggeration"):
        belvedere.deform(cells, 100.0, exaggeration=11)


def test_synthesize_equals_the_file(program, tmp_path):
    picture, labels = paint(64, 48)
    target = np.repeat(labels[:, ::-1], 2, axis=0)
    source = np.linspace(0, 255, 48 * 64).reshape(48, 64).astype(np.uint8)
    wanted = np.ascontiguousarray(source.repeat(2, axis=0))
    for name, array in {"a": picture, "l": labels, "t": target, "s": source, "w": wanted}.items():
        Image.fromarray(array).save(tmp_path / f"{name}.png")
    names = {name: tmp_path / f"{name}.png" for name in "altsw"}
    program(
        *("synthesize", "--picture", names["a"], "--label", names["l"], names["t"]),
        *("--guide", "height", names["s"], names["w"], 2, "--seed", 7, "--levels", 3, "--out", tmp_path / "out.png"),
    )
    made, match = belvedere.synthesize(
        picture, labels, np.ascontiguousarray(target), guides={"height": (source, wanted, 2)}, seed=7, levels=3
    )
    np.testing.assert_array_equal(made, np.asarray(Image.open(tmp_path / "out.png")))
    assert match.shape == (96, 64, 3) and match.dtype == np.uint16 and (match[..., 0] == 0).all()
    np.testing.assert_array_equal(made, picture[match[..., 2], match[..., 1]])
    several, match = belvedere.synthesize([picture, picture], [labels, np.full_like(labels, 255)], target, levels=3)
    assert (match[..., 0] == 0).all() and several.shape == made.shape
    for arguments, message in [
        ((picture.astype(float), labels, target), "uint8"),
        ((picture, labels[1:], target), "size|labels"),
        (([picture], labels, target[:, :, None]), "target_labels"),
    ]:
        with pytest.raises(belvedere.Error, match=message):
            belvedere.synthesize(*arguments)


@pytest.mark.long
def test_textures_equal_the_files(program, tmp_path):
    crop = paint(64, 64)[0]
    Image.fromarray(crop).save(tmp_path / "crop.png")
    program("texture", "learn", tmp_path / "crop.png", "--out", tmp_path / "crop.model", "--types", 16)
    program("texture", "make", tmp_path / "crop.model", "--size", "90x70", "--seed", 4, "--out", tmp_path / "made.png")
    model = belvedere.textures.learn(crop, types=16)
    assert model.text == (tmp_path / "crop.model").read_text()
    made = belvedere.textures.make(model, 90, 70, seed=4)
    np.testing.assert_array_equal(made, np.asarray(Image.open(tmp_path / "made.png")))
    model.save(tmp_path / "again.model")
    assert belvedere.textures.load(tmp_path / "again.model").text == model.text
    with pytest.raises(belvedere.Error, match="types"):
        belvedere.textures.learn(crop, types=3)


def test_styles_equal_the_files(program, tmp_path):
    picture, halves = paint(520, 260)
    classes = np.where(halves == 0, 4, 5).astype(np.uint8)  # forest, alpine grass
    classes[:60] = 0
    Image.fromarray(picture).save(tmp_path / "own.png")
    Image.fromarray(classes).save(tmp_path / "classes.png")
    program("style", "fit", tmp_path / "own.png", "--classes", tmp_path / "classes.png", "--out", tmp_path / "own.toml")
    text = (tmp_path / "own.toml").read_text()
    assert belvedere.style.fit(picture, classes=classes, name="own").text == text
    fitted = belvedere.style.fit(tmp_path / "own.png", classes=tmp_path / "classes.png")
    assert fitted.text == text and fitted.name == "own"
    fitted.save(tmp_path / "again.toml")
    assert belvedere.style.load(tmp_path / "again.toml").text == text
    assert belvedere.style.load("segantini").name
