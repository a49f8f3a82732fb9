"""The command: exit codes, one line for an error, output for people and for programs."""

import json
import pathlib
import subprocess
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pyopacity as po
from pyopacity import _native
from pyopacity.cli import light_options

Run = Callable[..., subprocess.CompletedProcess[str]]

DEMO = "demo:hair?segments=300"
SMALL = ("--size", "48x32", "--map-size", "32", "--antialiasing", "1")
CUBE = """
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
"""


@pytest.fixture
def run(python: Run) -> Run:
    def pyopacity(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
        return python("-m", "pyopacity", *arguments, **environment)

    return pyopacity


def render(run: Run, output: pathlib.Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    result = run("render", DEMO, "-o", str(output), *SMALL, *arguments)
    assert (result.returncode, result.stderr) == (0, "")
    return result


# ---- without OpenGL ----


def test_version_and_help(run: Run) -> None:
    assert run("--version").stdout.split() == ["pyopacity", po.__version__]
    for command in ((), ("render",), ("techniques",), ("info",), ("doctor",)):
        result = run(*command, "--help")
        assert (result.returncode, result.stderr) == (0, "")
        assert result.stdout.startswith("usage: pyopacity")
    told = " ".join(run("info", "--help").stdout.split())
    assert all(name in told for name in _native.demo_names())


def test_cmake_dir_is_one_line(run: Run) -> None:
    printed = run("--cmake-dir", COLUMNS="20").stdout  # narrower than any path
    assert printed.count("\n") == 1 and pathlib.Path(printed.rstrip("\n")).is_dir()


def test_techniques_lists_every_parameter(run: Run) -> None:
    people, programs = run("techniques").stdout, json.loads(run("techniques", "--json").stdout)
    assert list(programs) == list(po.techniques())
    for name, info in po.techniques().items():
        assert name in people and info.summary in people and info.paper in people
        for parameter in info.parameters:
            told = programs[name]["parameters"][parameter.name]
            assert told["range"] == parameter.range and told["default"] == parameter.default
            assert parameter.name in people


def test_info_tells_counts_bounds_and_ranges(run: Run, tmp_path: pathlib.Path) -> None:
    path = tmp_path / "cube.obj"
    path.write_text(CUBE)
    (hair, cube) = json.loads(run("info", DEMO, str(path), "--json").stdout)
    assert hair["shapes"][0]["kind"] == "strands" and hair["shapes"][0]["segments"] >= 300
    assert 0.0 <= hair["shapes"][0]["opacity"][0] <= hair["shapes"][0]["opacity"][1] <= 1.0
    assert cube["bounds"] == [[0, 0, 0], [1, 1, 1]]
    assert cube["shapes"][0]["triangles"] == 2
    people = run("info", str(path)).stdout
    assert "2 triangles" in people and "0 0 0 .. 1 1 1" in people


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ((), "COMMAND"),
        (("rendr",), "rendr"),
        (("render", "-o", "a.png"), "FILE"),
        (("render", DEMO), "--output"),
        (("render", DEMO, "-o", "a.bmp"), ".png or .npy"),
        (("render", DEMO, "-o", "no/such/folder/a.png"), "folder"),
        (("render", DEMO, "-o", "a.png", "--frobnicate"), "--frobnicate"),
        (("render", "nothing.hair", "-o", "a.png"), "nothing.hair"),
        (("render", "demo:hare", "-o", "a.png"), "demo"),
        (("render", DEMO, "-o", "a.png", "--technique", "exakt"), '"exact"'),
        (("render", DEMO, "-o", "a.png", "--param", "layesr=8"), '"layers"'),
        (("render", DEMO, "-o", "a.png", "--param", "layers=4000"), "1..64"),
        (("render", DEMO, "-o", "a.png", "--param", "layers"), "name=value"),
        (("render", DEMO, "-o", "a.png", "--size", "10"), "WIDTHxHEIGHT"),
        (("render", DEMO, "-o", "a.png", "--size", "0x10"), "1..16384"),
        (("render", DEMO, "-o", "a.png", "--size", "1000000x1000000"), "1..16384"),
        (("render", DEMO, "-o", "a.png", "--map-size", "0"), "1..16384"),
        (("render", DEMO, "-o", "a.png", "--light", "0,0,0"), "direction"),
        (("render", DEMO, "-o", "a.png", "--light", "-1,0"), "--light"),
        (("render", DEMO, "-o", "a.png", "--light", "lamp:1,0,0"), "point:X,Y,Z"),
        (("render", DEMO, "-o", "a.png", "--light", "point:1,0"), "point:0,-5,9"),
        (("render", DEMO, "-o", "a.png", "--light", "point:1,0,0:2"), "point:0,-5,9"),
        (("render", DEMO, "-o", "a.png", "--light", "spot:1,0,0"), "TX,TY,TZ"),
        (("render", DEMO, "-o", "a.png", "--light", "spot:1,0,0:1,0,0"), "target"),
        (("render", DEMO, "-o", "a.png", "--light", "spot:1,0,0:0,0,0:171"), "1..170"),
        (("render", DEMO, "-o", "a.png", "--light", "area:1,0,0:0,0,0:nan"), "edge"),
        (("render", DEMO, "-o", "a.png", "--light", "area:1,0,0:0,0,0:-1"), "SIDE"),
        (("render", DEMO, "-o", "a.png", "--light", "area:1,0,0:0,0,0:1:9"), "1..8"),
        (("compare", DEMO, "-o", "errors", "--light", "1,0,0", "--light", "spot"), "--light"),
        (("render", DEMO, "-o", "a.png", "--camera", "0,0,1"), "up"),
        (("render", DEMO, "-o", "a.png", "--camera", "0,1,0:0,1,0"), "eye"),
        (("render", DEMO, "-o", "a.png", "--up", "w"), "--up"),
        (("render", DEMO, "-o", "a.png", "--background", "1,1"), "--background"),
        (("render", DEMO, "-o", "a.png", "--opacity", "2"), "opacity"),
        (("render", DEMO, "-o", "a.png", "--width", "wide"), "--width"),
        (("render", DEMO, "-o", "a.png", "--report", "no/such/folder/r.json"), "folder"),
        (("info", "."), "."),
    ],
)
def test_bad_usage_is_one_line_with_the_fix(
    run: Run, arguments: tuple[str, ...], named: str
) -> None:
    result = run(*arguments)
    assert result.returncode == 2 and result.stdout == ""
    assert len(result.stderr.splitlines()) == 1, result.stderr
    assert result.stderr.startswith("pyopacity: ") and "; fix: " in result.stderr
    assert named in result.stderr


def test_width_without_strands_is_refused(run: Run, tmp_path: pathlib.Path) -> None:
    path = tmp_path / "cube.obj"
    path.write_text(CUBE)
    result = run("render", str(path), "-o", str(tmp_path / "a.png"), "--width", "1")
    assert result.returncode == 2 and "no strands" in result.stderr


def test_a_reader_that_leaves_early_is_no_error() -> None:
    command = f"{sys.executable} -m pyopacity techniques | head -n 1"
    result = subprocess.run(
        ["bash", "-o", "pipefail", "-c", command], capture_output=True, text=True, timeout=60
    )
    assert (result.returncode, result.stderr) == (0, "")


def test_no_context_is_exit_code_3(run: Run, tmp_path: pathlib.Path) -> None:
    nowhere = {"OPACITY_EGL_DEVICE": "97"}
    doctor = run("doctor", **nowhere)
    assert doctor.returncode == 3
    assert po.__version__ in doctor.stdout and "none" in doctor.stdout
    assert ", ".join(po.trace_backends()) in doctor.stdout
    rendered = run("render", DEMO, "-o", str(tmp_path / "a.png"), **nowhere)
    assert rendered.returncode == 3 and list(tmp_path.iterdir()) == []
    for result in (doctor, rendered):
        assert len(result.stderr.splitlines()) == 1 and "; fix: " in result.stderr


# ---- with OpenGL ----


@pytest.mark.gl
def test_doctor_tells_what_draws(run: Run) -> None:
    result = run("doctor", "--json")
    opengl = json.loads(result.stdout)["opengl"]
    assert result.returncode == 0 and opengl["renderer"] and opengl["version"].startswith("4.")
    assert opengl["renderer"] in run("doctor").stdout


@pytest.mark.gl
def test_render_saves_what_the_library_renders(run: Run, tmp_path: pathlib.Path) -> None:
    output = tmp_path / "hair.npy"
    arguments = ("--technique", "exact", "--light", "-.5,.3,-.8", "--camera", "9,-90,30:0,0,20:40")
    result = render(run, output, *arguments, "--param", "bias=0.2", "--background=0,0,1")
    assert str(output) in result.stdout and "48x32" in result.stdout

    scene = po.Scene(po.load(DEMO), po.DirectionalLight((-0.5, 0.3, -0.8)))
    camera = po.Camera.look_at((9, -90, 30), (0, 0, 20), fov_deg=40)
    technique = po.technique("exact", bias=0.2)
    settings: dict[str, Any] = {"size": (48, 32), "map_size": 32, "antialiasing": 1}
    with po.Renderer(
        scene, camera, technique=technique, background=(0, 0, 1), **settings
    ) as renderer:
        assert np.array_equal(np.load(output), renderer.render())


def test_every_kind_of_light() -> None:
    assert light_options.read(".5,0,-2").direction == po.DirectionalLight((0.5, 0, -2)).direction
    point, spot, area = map(
        light_options.read, ("point:1,2,-3", "spot:1,2,3:1,0,3:40", "area:0,0,5:0,3,1:.5:3")
    )
    assert isinstance(point, po.PointLight) and point.position == (1, 2, -3)
    assert isinstance(spot, po.SpotLight) and isinstance(area, po.AreaLight)
    assert (spot.position, spot.direction, spot.angle_deg) == ((1, 2, 3), (0, -1, 0), 40)
    assert (area.position, area.samples) == ((0, 0, 5), 3)
    u, v, way = np.array([area.edge_u, area.edge_v, (0.0, 0.6, -0.8)])
    np.testing.assert_allclose(
        [u @ u, v @ v, u @ v, u @ way, v @ way], [0.25, 0.25, 0, 0, 0], atol=1e-6
    )


@pytest.mark.gl
def test_lights_add_up(run: Run, tmp_path: pathlib.Path) -> None:
    lights = ["--light", "-1,0,-1", "--light", "point:20,-40,60"]
    pictures = []
    for i, given in enumerate((lights[:2], lights[2:], lights)):
        render(run, tmp_path / f"{i}.npy", *given, "--ambient", "0", "--compositing", "opaque")
        pictures.append(np.load(tmp_path / f"{i}.npy")[..., :3])
    assert np.abs(pictures[2] - pictures[0] - pictures[1]).max() < 1e-5
    assert pictures[0].max() > 0.01 and pictures[1].max() > 0.01


@pytest.mark.gl
def test_the_report_as_a_table_and_as_json(run: Run, tmp_path: pathlib.Path) -> None:
    report = tmp_path / "report.json"
    result = render(run, tmp_path / "a.png", "--print-report", "--report", str(report))
    assert "lighting" in result.stdout and " ran " in result.stdout
    passes = json.loads(report.read_text())["passes"]
    assert {"name", "status", "why", "ms", "calls", "note"} == set(passes[0])
    assert "lighting" in render(run, tmp_path / "a.png", "--report", "-").stdout

    document = json.loads(render(run, tmp_path / "a.png", "--json").stdout)
    assert document["size"] == [48, 32] and document["technique"] == "bounding_opacity_maps"
    assert [row["name"] for row in document["passes"]] == [row["name"] for row in passes]


@pytest.mark.gl
def test_opacity_and_width_change_the_picture(run: Run, tmp_path: pathlib.Path) -> None:
    pictures = []
    for index, more in enumerate([(), ("--opacity", "1"), ("--width", "1.5")]):
        render(run, tmp_path / f"{index}.npy", *more)
        pictures.append(np.load(tmp_path / f"{index}.npy"))
    assert not np.array_equal(pictures[0], pictures[1])
    assert not np.array_equal(pictures[0], pictures[2])


@pytest.mark.gl
def test_a_world_whose_y_is_up_looks_the_same(run: Run, tmp_path: pathlib.Path) -> None:
    upright = np.array([float(x) for line in CUBE.split("\n") for x in line.split()[1:]][:12])
    turned = upright.reshape(4, 3) @ np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    faces = "".join(f"{line}\n" for line in CUBE.splitlines() if line.startswith("f"))
    (tmp_path / "z.obj").write_text(CUBE)
    (tmp_path / "y.obj").write_text("".join("v {} {} {}\n".format(*v) for v in turned) + faces)
    pictures = []
    for axis in "zy":
        output = tmp_path / f"{axis}.npy"
        file = str(tmp_path / f"{axis}.obj")
        result = run("render", file, "-o", str(output), *SMALL, "--up", axis)
        assert result.returncode == 0, result.stderr
        pictures.append(np.load(output))
    assert np.abs(pictures[0] - pictures[1]).mean() < 1e-3


# With this much address space for all of it; a driver for a GPU would take more to start.
LIMITED = """
import resource, sys
from pyopacity.cli import main
resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))
sys.exit(main(sys.argv[1:]))
"""


@pytest.mark.gl
def test_no_memory_is_exit_code_4_and_one_line(python: Run, tmp_path: pathlib.Path) -> None:
    if not _native.Context.headless().is_software:
        pytest.skip("only a software renderer takes its textures from this process's memory")
    big = ("--size", "16x16", "--map-size", "8192", "--param", "layers=16")  # maps of 4 GiB
    result = python("-c", LIMITED, "render", DEMO, "-o", str(tmp_path / "a.png"), *big)
    assert (result.returncode, result.stdout) == (4, ""), result.stderr
    assert len(result.stderr.splitlines()) == 1 and "; fix: " in result.stderr
    assert list(tmp_path.iterdir()) == []


# Sends Ctrl-C as soon as the main thread is inside Renderer.render.
INTERRUPT = """
import os, signal, sys, threading, time
from pyopacity.cli import main

def interrupt():
    while True:
        frame = sys._current_frames()[threading.main_thread().ident]
        while frame is not None:
            if frame.f_code.co_qualname == "Renderer.render":
                os.kill(os.getpid(), signal.SIGINT)
                return
            frame = frame.f_back
        time.sleep(0.001)

threading.Thread(target=interrupt, daemon=True).start()
sys.exit(main(sys.argv[1:]))
"""


@pytest.mark.gl
def test_ctrl_c_ends_with_130(python: Run, tmp_path: pathlib.Path) -> None:
    result = python("-c", INTERRUPT, "render", DEMO, "-o", str(tmp_path / "a.png"))
    assert (result.returncode, result.stdout, result.stderr) == (130, "", "")
    assert list(tmp_path.iterdir()) == []
