"""What the tests share: small scenes that need no data, and the program of the command line."""

import os
import subprocess

import numpy as np
import pytest

import belvedere

# A quick demo: little terrain, and strokes only.
tiny = {
    "terrain.synthetic.width": 60,
    "terrain.synthetic.height": 56,
    "terrain.synthetic.cell_m": 400,
    "synthesis.enabled": False,
    "output.width": 128,
    "output.height": 64,
    "output.formats": ["png"],
}


def pytest_configure(config):
    config.addinivalue_line("markers", "long: takes a minute")


@pytest.fixture
def demo():
    return belvedere.Scene.demo(set=tiny)


@pytest.fixture(scope="session")
def program():
    """Runs the program; returns its standard error where it must fail."""
    path = os.environ.get("BELVEDERE_PROGRAM", "belvedere")

    def call(*words, fails=False):
        done = subprocess.run([path, *map(str, words)], capture_output=True, text=True)
        assert (done.returncode != 0) == fails, done.stderr
        return done.stderr

    return call


def hill(side=90):
    """A hill with furrows on a plain of 500 m, cells of 100 m."""
    y, x = np.mgrid[0:side, 0:side]
    middle = (side - 1) / 2
    round_hill = np.maximum(0.0, 900 - 30 * np.hypot(x - middle, y - middle))
    return (500 + round_hill + 8 * np.sin(0.9 * x)).astype(np.float32)


def ranges(side=240):
    """Two ranges with valleys between them, for cells of 250 m."""
    y, x = np.mgrid[0:side, 0:side]
    return 600 + 1500 * np.sin(x / 17) ** 2 * np.cos(y / 23) ** 2 + 500 * np.sin((x + 2 * y) / 31) ** 2


def write_asc(path, cells, cell_m=100.0, east=600000, north=5200000):
    head = f"ncols {cells.shape[1]}\nnrows {cells.shape[0]}\nxllcorner {east}\nyllcorner {north}\ncellsize {cell_m}\n"
    np.savetxt(path, cells, fmt="%.9g", header=head.rstrip("\n"), comments="")


@pytest.fixture
def hill_scene(tmp_path):
    """The hill from the south, in UTM zone 32; its centre is at 604500, 5204500."""
    write_asc(tmp_path / "hill.asc", hill())
    text = """version = 1
[[terrain.sources]]
file = "hill.asc"
crs = "EPSG:32632"
[camera]
position = [604500, 5192000]
height_m = 3500
azimuth_deg = 0
pitch_deg = -12
[deform]
exaggeration = 1.4
[output]
width = 160
height = 90
"""
    return belvedere.Scene.parse(text, folder=tmp_path)
