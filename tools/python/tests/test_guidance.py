"""Guidance: values of the file, positions both ways."""

import math

import numpy as np
import pytest

import belvedere


def test_channels_equal_the_file_of_the_program(hill_scene, program, tmp_path):
    hill_scene.save(tmp_path / "hill.toml")
    program("guidance", tmp_path / "hill.toml", "--out", tmp_path / "out")
    stored = belvedere.Guidance.read(tmp_path / "out/guidance.exr")
    guidance = hill_scene.guidance()
    assert list(guidance) == list(stored) and len(guidance) > 25
    assert guidance.shape == stored.shape == (90, 160)
    assert guidance.origin_m == pytest.approx(stored.origin_m)
    directions = ("N", "Nd", "Ns", "fallline")  # normalized again when they are read
    for name, own in guidance.items():
        other = stored[name]
        assert own.dtype == other.dtype and own.shape == other.shape, name
        if name in directions:
            np.testing.assert_allclose(own, other, atol=1e-3, err_msg=name)
        elif own.dtype == np.float32 and name not in ("Z", "footprint", "P", "altitude", "rim"):
            np.testing.assert_array_equal(own.astype(np.float16), other.astype(np.float16), err_msg=name)
        else:
            np.testing.assert_array_equal(own, other, err_msg=name)


def test_chosen_channels_have_the_values_of_all(hill_scene):
    whole = hill_scene.guidance()
    some = hill_scene.guidance(channels=["landcover.id", "N.Y", "altitude"], threads=1)
    assert sorted(some) == ["N", "altitude", "landcover.id"]
    for name, array in some.items():
        np.testing.assert_array_equal(array, whole[name])
    assert some["altitude.V"] is some["altitude"]
    with pytest.raises(belvedere.Error, match="not a channel"):
        hill_scene.guidance(channels=["depth"])
    with pytest.raises(belvedere.Error, match="was not asked for"):
        some["Z"]


def test_channels_say_unit_meaning_and_sky(hill_scene):
    guidance = hill_scene.guidance(channels=["Z", "N", "landcover.id"], width=80)
    assert guidance["Z"].shape == (45, 80)
    depth, normal, cover = (guidance.channels[name] for name in ("Z", "N", "landcover.id"))
    assert (depth.unit, depth.nodata) == ("m", math.inf)
    assert normal.nodata == (0, 0, 1) and normal.file_names == ("N.X", "N.Y", "N.Z")
    assert cover.unit == "id" and cover.nodata == 0 and isinstance(cover.nodata, int)
    sky = np.isinf(guidance["Z"])
    assert 0 < sky.sum() < sky.size
    assert (guidance["N"][sky] == normal.nodata).all() and (guidance["landcover.id"][sky] == 0).all()


def test_positions_both_ways(hill_scene):
    guidance = hill_scene.guidance(channels=["Z", "P", "altitude"])
    y, x = np.nonzero(np.isfinite(guidance["Z"]))
    x, y = x[::37] + 0.5, y[::37] + 0.5
    lon, lat = guidance.lonlat(x, y)
    # The centre of the hill, 604500 5204500 in zone 32, lies at 10.37° E 46.99° N.
    assert abs(lon - 10.37).max() < 0.1 and abs(lat - 46.99).max() < 0.1
    back_x, back_y = guidance.pixel(lon, lat)
    np.testing.assert_allclose(back_x, x, atol=0.01)
    np.testing.assert_allclose(back_y, y, atol=0.01)
    assert guidance.visible(lon, lat).mean() > 0.95
    # In metres of the scene, against the channels of that sample of the pixel.
    east, north = guidance.lonlat(x, y, crs=None)
    at = (y.astype(int), x.astype(int))
    known = guidance["P"][at][:, :2] + guidance.origin_m[:2]
    assert np.median(np.hypot(east - known[:, 0], north - known[:, 1])) < 60
    assert np.median(abs(guidance.altitude_m(x, y) - guidance["altitude"][at])) < 15
    # Numbers for numbers; the sky, and what lies outside the terrain.
    assert all(isinstance(value, float) for value in guidance.lonlat(80.5, 60.5))
    assert math.isnan(guidance.lonlat(80.0, 1.0)[0])
    assert math.isnan(guidance.pixel(0.0, 0.0)[0]) and guidance.visible(0.0, 0.0) is False
    assert guidance.lonlat(np.zeros((2, 3)), 1.0)[1].shape == (2, 3)


def test_terrain_without_coordinates_has_metres_alone(demo):
    guidance = demo.guidance(channels=["Z"])
    with pytest.raises(belvedere.Error, match="crs=None"):
        guidance.lonlat(64.0, 60.0)
    y, x = (float(places[0]) + 0.5 for places in np.nonzero(np.isfinite(guidance["Z"])))
    east, north = guidance.lonlat(x, y, crs=None)
    assert guidance.pixel(east, north, crs=None) == pytest.approx((x, y), abs=0.01)
