"""Documentation: docstrings against the declarations of C++, the page, the notebooks."""

import inspect
import json
import pathlib
import re
import sys

import pytest
from conftest import ranges, tiny

import belvedere

root = pathlib.Path(__file__).resolve().parents[3]


def declared(struct, field):
    """Default and comment of a member in C++: int levels = 6;  // 1…8, …"""
    header, _, name = struct.partition(":")
    text = (root / header).read_text(encoding="utf-8").partition(f"struct {name} {{")[2]
    found = re.search(rf"^\s*[\w:<>,* ]+\b{field}\s*=\s*([^;]+);((?:\s*//[^\n]*)*)", text, re.M)
    before = re.search(rf"((?:^\s*//[^\n]*\n)+)\s*[\w:<>,* ]+\b{field}\s*=", text, re.M)
    comment = found.group(2) + (before.group(1) if before else "")
    return found.group(1).strip().rstrip("Ff"), re.sub(r"\s*//\s*", " ", comment)


SYNTHESIS = "texture/synthesis/exemplar.h:SynthesisParameters"
GENERALIZE = "terrain/generalize/generalize.h:GeneralizeParameters"
LEARN = "texture/statistical/learn_texture.h:LearnParameters"


@pytest.mark.parametrize(
    "function, parameter, struct, range_of",
    [
        (belvedere.synthesize, "seed", SYNTHESIS, ""),
        (belvedere.synthesize, "levels", SYNTHESIS, "1…8"),
        (belvedere.synthesize, "reuse", SYNTHESIS, "0…10"),
        (belvedere.synthesize, "copy_cap", SYNTHESIS, "16…100000"),
        (belvedere.synthesize, "neighbourhood", SYNTHESIS, "3, 5, 7, 9 or 11"),
        (belvedere.synthesize, "surroundings", SYNTHESIS, "0…100"),
        (belvedere.generalize, "base", GENERALIZE, ""),
        (belvedere.generalize, "full_curvature", GENERALIZE, ".001…10"),
        (belvedere.generalize, "blur_cells", GENERALIZE, "0…10"),
        (belvedere.generalize, "exponent", GENERALIZE, "0…4"),
        (belvedere.textures.learn, "types", LEARN, "16…200"),
        (belvedere.textures.learn, "levels", LEARN, "0…4"),
    ],
)
def test_parameters_have_the_defaults_and_ranges_of_their_declarations(function, parameter, struct, range_of):
    default, comment = declared(struct, parameter)
    assert inspect.signature(function).parameters[parameter].default == float(default)
    told = re.sub(r"\s+", " ", function.__doc__)
    assert range_of in re.sub(r"\s+", " ", comment), comment
    assert not range_of or re.search(rf"{parameter}: [^.]*(?:\.\d[^.]*)*{re.escape(range_of)}", told), told


def test_channels_have_the_units_of_their_declarations():
    text = (root / "base/guidance_buffers.cpp").read_text(encoding="utf-8")
    rows = re.findall(r"\{\.member = &B::(\w+),(.*?)\},[^\n]*\n(?=    \{\.member|\};)", text, re.S)
    assert len(rows) == len(belvedere.channels())
    for (member, row), channel in zip(rows, belvedere.channels().values()):
        names = re.search(r"\.names = \{([^}]*)\}", row).group(1)
        unit = re.search(r'\.unit = "([^"]*)"', row)
        assert tuple(re.findall(r'"([^"]+)"', names)) == channel.file_names
        assert (unit.group(1) if unit else "") == channel.unit
        suffix = {"m": "_m", "°": "_deg"}.get(channel.unit)
        assert suffix is None or member.endswith(suffix), member
    page = (root / "docs/guidance.md").read_text(encoding="utf-8")
    for channel in belvedere.channels().values():
        assert f"| `{' '.join(channel.file_names)}` | {channel.unit} |" in page


def public():
    for name in belvedere.__all__:
        thing = getattr(belvedere, name)
        if inspect.isclass(thing):
            yield from ((f"{name}.{key}", value) for key, value in vars(thing).items() if key[0] != "_")
        if inspect.ismodule(thing):
            yield from ((f"{name}.{key}", value) for key, value in vars(thing).items() if inspect.isfunction(value))
        if inspect.isfunction(thing):
            yield name, thing


def test_functions_are_typed_and_arrays_have_a_shape():
    seen = 0
    for name, thing in public():
        function = getattr(thing, "__func__", thing)
        if not inspect.isfunction(function) or function.__module__.startswith("belvedere._") is False and "." not in name:
            continue
        signature = inspect.signature(function)
        typed = [p.annotation for key, p in signature.parameters.items() if key not in ("self", "cls")]
        assert inspect.Parameter.empty not in (*typed, signature.return_annotation), name
        if re.search(r"np\.ndarray|Arrays", " ".join(map(str, (*typed, signature.return_annotation)))):
            assert name.split(".")[-1] in ("items",) or "(height, width" in function.__doc__, name
            seen += 1
    assert seen >= 6


def test_the_version_is_one():
    program = re.search(r"project\(belvedere VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text()).group(1)
    project = re.search(r'^version = "([\d.]+)"', (root / "pyproject.toml").read_text(), re.M).group(1)
    assert belvedere.__version__ == program == project


def test_importing_is_light():
    names = ("numpy", "tqdm", "xarray", "matplotlib")
    code = f"import sys, belvedere; print([name for name in {names} if name in sys.modules])"
    import subprocess

    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def run_code(code, folder, monkeypatch):
    monkeypatch.chdir(folder)
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    space = {"__name__": "__main__", "tiny": tiny}
    code = re.sub(r"Scene\.demo\([^)]*\)", "Scene.demo(set=tiny)", code)
    exec(compile(code, "document", "exec"), space)
    figures = len(pyplot.get_fignums())
    pyplot.close("all")
    return figures


@pytest.mark.parametrize("notebook, pictures", [("guidance", 2), ("seasons", 2)])
def test_notebooks_run(notebook, pictures, tmp_path, monkeypatch):
    path = root / f"docs/notebooks/{notebook}.ipynb"
    assert path.stat().st_size < 100_000
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    code = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
    small, count = re.subn(r"^width = \d+", "width = 128", code, flags=re.M)
    assert count == 1
    assert run_code(small, tmp_path, monkeypatch) >= pictures


@pytest.mark.long
def test_examples_of_the_page_run(tmp_path, monkeypatch):
    rasterio = pytest.importorskip("rasterio")
    pytest.importorskip("xarray")
    form = {"driver": "GTiff", "width": 240, "height": 240, "count": 1, "dtype": "float32", "crs": "EPSG:32632"}
    place = rasterio.transform.from_origin(600000, 5260000, 250, 250)
    with rasterio.open(tmp_path / "my_dem.tif", "w", transform=place, **form) as file:
        file.write(ranges().astype("float32"), 1)
    page = (root / "docs/python.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", page, re.M | re.S)
    assert len(blocks) >= 8
    small = "\n".join(blocks).replace("width=1000", "width=128").replace("500.5, 300.5", "64.5, 40.5")
    run_code(small, tmp_path, monkeypatch)
