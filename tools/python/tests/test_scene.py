"""Scenes: values, messages, pictures equal to the files of the command line."""

import json
import os
import signal
import threading
import time

import numpy as np
import pytest
from conftest import hill, ranges, tiny, write_asc
from PIL import Image

import belvedere


# Takes about a second.
larger = {**tiny, "terrain.synthetic.width": 200, "terrain.synthetic.height": 180}


def settings(values):
    return [word for key, value in values.items() for word in ("--set", f"{key}={str(value).lower()}")]


def test_values_are_those_of_the_scene(demo):
    demo["sun.azimuth_deg"] = 300
    assert demo["sun.azimuth_deg"] == 300
    assert "\nazimuth_deg = 300\n" in demo.text
    assert demo.copy().to_dict() == demo.to_dict()
    demo.update({"output.formats": ("png", "tif"), "generalize.foreground": np.float32([1, 0.5, 1, 1, 1, 1]), "title": 'A "hill"'})
    assert demo["output.formats"] == ["png", "tif"]
    assert demo["generalize.foreground"] == [1, 0.5, 1, 1, 1, 1]
    assert demo["title"] == 'A "hill"'
    demo["style"] = "gogh"
    assert demo["style.file"] == "gogh"
    del demo["style"]
    assert "style.file" not in demo and demo.get("style.file", 3) == 3
    assert dict(demo)["output.width"] == 128


def test_a_comment_and_the_file_survive(tmp_path):
    scene = belvedere.Scene.parse("version = 1  # mine\n[terrain.synthetic]\nseed = 3\n", name="own.toml")
    scene["terrain.synthetic.seed"] = 4
    scene.save(tmp_path / "saved.toml")
    assert (tmp_path / "saved.toml").read_text() == "version = 1  # mine\n[terrain.synthetic]\nseed = 4\n"
    again = belvedere.Scene.load(tmp_path / "saved.toml", set={"seed": 5})
    assert again["terrain.synthetic.seed"] == 4 and again["seed"] == 5 and again.name == "saved"


@pytest.mark.parametrize(
    "key, value",
    [("sun.altitude_deg", 95), ("sun.azimut_deg", 30), ("output.width", "wide"), ("output.formats", ["gif"])],
)
def test_messages_are_those_of_the_command_line(demo, program, tmp_path, key, value):
    before = demo.text
    with pytest.raises(belvedere.Error) as caught:
        demo[key] = value
    told = program("render", "--out", tmp_path, "--set", f"{key}={json.dumps(value)}", fails=True)
    assert told.strip() == f"belvedere: {caught.value}"
    assert caught.value.status == 2 and caught.value.remedy and caught.value.position
    assert demo.text == before


def test_errors_have_position_finding_and_remedy(demo, tmp_path):
    with pytest.raises(belvedere.Error, match="did you mean") as unknown:
        demo["sun.azimut_deg"]
    assert unknown.value.position == "sun.azimut_deg"
    (tmp_path / "bad.toml").write_text("version = 1\nsun = 3\n")
    with pytest.raises(belvedere.Error) as wrong:
        belvedere.Scene.load(tmp_path / "bad.toml")
    assert wrong.value.position == f"{tmp_path}/bad.toml:2:7"
    with pytest.raises(belvedere.Error) as missing:
        belvedere.Scene.load(tmp_path / "none.toml")
    assert missing.value.status == 3
    with pytest.raises(belvedere.Error, match="64 … 16384"):
        demo.draw(20)


def test_pictures_equal_the_files_of_the_program(demo, program, tmp_path):
    program("render", "--out", tmp_path / "a", *settings(tiny), "--set", 'output.formats=["png"]')
    picture = demo.draw(128)
    assert picture.shape == (64, 128, 3) and picture.dtype == np.uint8
    np.testing.assert_array_equal(picture, np.asarray(Image.open(tmp_path / "a/panorama.png")))
    files = demo.render(tmp_path / "b", channels="Z,landcover.id")
    assert [os.path.basename(file) for file in files] == ["panorama.png", "guidance.exr"]
    for _ in range(2):  # into the same folder again
        demo.render(tmp_path / "b", channels="none")
    np.testing.assert_array_equal(picture, np.asarray(Image.open(tmp_path / "b/panorama.png")))
    larger = demo.draw(200)
    assert larger.shape == (100, 200, 3)
    np.testing.assert_array_equal(demo.draw(128), picture)


def test_pictures_follow_changes_and_threads(demo):
    before = demo.draw(96)
    np.testing.assert_array_equal(demo.draw(96, threads=1), before)
    demo["sun.azimuth_deg"] = 100
    after = demo.draw(96)
    assert (after != before).any()
    np.testing.assert_array_equal(demo.copy().draw(96), after)


def test_threads_of_python_draw_at_once(demo):
    scenes = [demo.copy() for _ in range(3)]
    for azimuth, scene in zip((100, 200, 300), scenes):
        scene["sun.azimuth_deg"] = azimuth
    alone = [scene.copy().draw(80) for scene in scenes]
    drawn = [None] * 6
    others = [
        threading.Thread(target=lambda i=i: drawn.__setitem__(i, scenes[i % 3].draw(80))) for i in range(len(drawn))
    ]
    for other in others:
        other.start()
    for other in others:
        other.join()
    for i, picture in enumerate(drawn):
        np.testing.assert_array_equal(picture, alone[i % 3])


def test_the_lock_of_python_is_free_meanwhile(demo):
    ticks, ended = [], threading.Event()

    def tick():
        while not ended.wait(0.005):
            ticks.append(time.monotonic())

    ticker = threading.Thread(target=tick)
    ticker.start()
    begun = time.monotonic()
    belvedere.Scene.demo(set=larger).draw(200, cache=False)
    took = time.monotonic() - begun
    ended.set()
    ticker.join()
    assert len(ticks) > 20 * took  # of 200 a second


def test_progress_is_told_and_may_stop_the_work():
    scene = belvedere.Scene.demo(set=larger)
    told = []
    scene.copy().draw(200, cache=False, progress=lambda stage, share: told.append((stage, share)))
    assert told and all(stage and (share is None or 0 <= share <= 1) for stage, share in told)

    def refuse(stage, share):
        raise ValueError("enough")

    with pytest.raises(ValueError, match="enough"):
        scene.copy().draw(1000, cache=False, progress=refuse)


def test_ctrl_c_stops_within_a_second():
    scene = belvedere.Scene.demo(set=tiny)
    pressed = []

    def press():
        pressed.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(1.0, press)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        scene.draw(6000, cache=False)
    assert time.monotonic() - pressed[0] < 1.0
    assert scene.draw(64).shape == (32, 64, 3)


def test_new_finds_a_view_and_writes_nothing(tmp_path):
    write_asc(tmp_path / "ranges.asc", ranges(), cell_m=250)
    scene = belvedere.new(tmp_path / "ranges.asc", towards="south", crs="EPSG:32632", format="3:1")
    assert os.listdir(tmp_path) == ["ranges.asc"]
    assert abs(scene["camera.azimuth_deg"] - 180) < 60
    assert scene["output.width"] == 3 * scene["output.height"]
    assert scene.draw(96).shape == (32, 96, 3)
    with pytest.raises(belvedere.Error, match="--towards"):
        belvedere.new(tmp_path / "ranges.asc", towards="up", crs="EPSG:32632")


@pytest.mark.long
def test_memory_of_many_pictures_is_flat():
    def resident_mib():
        with open("/proc/self/statm") as statm:
            return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20

    scene = belvedere.Scene.demo(set=tiny)
    used = []
    for i in range(200):
        scene["sun.azimuth_deg"] = 1.5 * i
        scene.draw(128)
        scene.copy().guidance(width=64)
        belvedere.generalize(hill(300), 100.0, preset="smooth_slopes")
        used.append(resident_mib())
    assert max(used[150:]) - max(used[50:100]) < 8, used[::10]
