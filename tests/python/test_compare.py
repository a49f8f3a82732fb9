"""The comparison: errors whose order or value is known, and the files that show them."""

import csv
import json
import pathlib
import re
import shlex
import subprocess
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest

import interrupting
import pyopacity as po
from pyopacity.comparison import Plan, Result, compare, sample_receivers
from pyopacity.comparison.surfaces import trace_on_surfaces

Run = Callable[..., subprocess.CompletedProcess[str]]

DEMO = "demo:hair?segments=300"
SMALL: dict[str, Any] = {
    "receivers": 200,
    "samples": 16,
    "image_size": (48, 36),
    "image_samples": 2,
    "repeats": 1,
}
NO_OPENGL = "/nonexistent/libEGL.so.1"
FLAGS = ("--receivers", "300", "--samples", "16", "--image-size", "48x36", "--image-samples", "2")


@pytest.fixture
def run(python: Run) -> Run:
    def pyopacity(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
        return python("-m", "pyopacity", "compare", *arguments, **environment)

    return pyopacity


def results_of(scene: po.Scene, **plan: Any) -> list[Result]:
    camera = po.Camera.fit(scene.shapes[:2])
    return list(compare(scene, camera, Plan(**{**SMALL, **plan})))


# ---- what is measured ----


def test_variants_follow_the_registry() -> None:
    variants = Plan(layers=(4, 8, 4)).variants()
    for name, info in po.techniques().items():
        layered = "layers" in {p.name for p in info.parameters}
        found = [v.parameters for v in variants if v.technique == name]
        assert found == ([{"layers": 4}, {"layers": 8}] if layered else [{}])


def test_parameters_go_to_those_that_have_them() -> None:
    plan = Plan(parameters={"bias": 0.5, "layers": 2})
    assert {v.parameters["bias"] for v in plan.variants()} == {0.5}
    assert {v.parameters.get("layers") for v in plan.variants()} == {2, None}
    with pytest.raises(po.ParameterError, match='did you mean "bias"'):
        Plan(parameters={"bia": 0.5}).variants()
    with pytest.raises(po.ParameterError, match="layers"):
        Plan(layers=(4000,)).variants()


def test_receivers_are_a_seeded_choice_of_those_that_receive(scene: po.Scene) -> None:
    strands, ball, ground = scene.shapes
    ground.receives = False
    strands.transform = np.diag([2.0, 2.0, 2.0, 1.0])
    chosen = sample_receivers(scene, 60, seed=3)
    assert [shape for shape, _ in chosen.chosen] == [strands, ball]
    assert len(chosen.points) == len(chosen.bias) == len(chosen.normals) == 60
    on_strands = len(chosen.chosen[0][1])
    assert np.array_equal(chosen.points[:on_strands], 2.0 * strands.points[chosen.chosen[0][1]])
    assert np.allclose(chosen.bias[:on_strands], 2.0 * 0.05)  # their width, in the world
    assert not chosen.normals[:on_strands].any() and chosen.normals[on_strands:].any(axis=1).all()

    again, other = sample_receivers(scene, 60, seed=3), sample_receivers(scene, 60, seed=4)
    assert np.array_equal(again.points, chosen.points)
    assert not np.array_equal(other.points, chosen.points)
    everything = sample_receivers(scene, 10**6, seed=0)
    assert len(everything.points) == len(strands.points) + len(ball.points)
    strands.receives = ball.receives = False
    with pytest.raises(po.ParameterError, match="receives"):
        sample_receivers(scene, 60, seed=0)


@pytest.mark.parametrize("slope", [0.0, 1.0, 3.0])
def test_a_leaning_surface_does_not_darken_its_own_footprint(
    sheet: Callable[..., po.Mesh], slope: float
) -> None:
    leaning = sheet(half_size=5.0)
    leaning.transform = np.array(
        [[1.0, 0, 0, 0], [0, 1.0, 0, 0], [slope, 0, 1.0, 0], [0, 0, 0, 1.0]]
    )
    scene = po.Scene(leaning, po.DirectionalLight((0.0, 0.0, -1.0)))
    points, normals = np.zeros((3, 3)), np.tile((-slope, 0.0, 1.0), (3, 1))
    bias, told = np.full(3, 1e-3), []
    T = trace_on_surfaces(scene, points, normals, bias, 0.5, 64, told.append)
    assert np.array_equal(T, np.ones(3)) and told[-1] == 1.0
    # Half of a square of side 0.5 lies under the cover, which ends at x = 0.
    cover = sheet(20.0, 2.0, opacity=0.5)
    cover.transform = np.array([[1.0, 0, 0, 2.0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    scene.add(cover)
    T = trace_on_surfaces(scene, points, normals, bias, 0.5, 64, told.append)
    assert np.allclose(T, 0.75, atol=0.02)


@pytest.mark.gl
def test_errors_stand_in_the_order_that_is_known(scene: po.Scene) -> None:
    rows = {
        (result.variant.label.partition(",")[0], result.map_size): result
        for result in results_of(scene, map_sizes=(128, 256))
    }
    assert {name for name, _ in rows} == set(po.techniques())
    for map_size in (128, 256):
        exact, unshadowed = rows["exact", map_size], rows["unshadowed", map_size]
        assert exact.depth == po.metrics.errors([0.0], [0.0])  # of the same map: it is that map
        assert exact.total.rmse < 0.1 and abs(exact.total.bias) < 0.03
        assert unshadowed.depth.rmse > 0.3 and unshadowed.depth.bias > 0.0
        for name in po.techniques():
            one = rows[name, map_size]
            for kind in ("depth", "total", "image"):
                assert getattr(one, kind).rmse <= getattr(unshadowed, kind).rmse
            assert one.flip is not None and one.flip <= unshadowed.flip
            assert one.cost.seconds >= one.cost.map_seconds >= 0.0 and one.cost.seconds > 0.0
            assert one.receivers == 200
    sides = [rows["exact", map_size].footprint for map_size in (128, 256)]
    assert sides[0] == pytest.approx(2.0 * sides[1], rel=0.03)  # a border of one texel


@pytest.mark.gl
def test_the_difference_of_depth_and_total_is_what_they_are_measured_against(
    scene: po.Scene,
) -> None:
    (unshadowed,) = results_of(scene, techniques=("unshadowed",), footprint=0.0)
    chosen = sample_receivers(scene, 200, 0)
    T = po.trace_transmittance(scene, chosen.points, bias=chosen.bias)
    assert unshadowed.total == po.metrics.errors(np.ones(200), T)
    assert unshadowed.footprint == 0.0
    with po.Renderer(scene, technique="exact", size=(8, 8)) as renderer:
        lists = chosen.transmittance(renderer)
    assert unshadowed.depth == po.metrics.errors(np.ones(200), lists)


@pytest.mark.gl
def test_costs_are_those_of_the_maps(scene: po.Scene) -> None:
    names = ("unshadowed", "opacity_shadow_maps", "deep_opacity_maps", "density_clustering")
    plan: dict[str, Any] = {
        "techniques": names,
        "layers": (4, 16),
        "parameters": {"deposit": "blend"},
    }
    found = {
        (one.variant.technique, one.variant.parameters.get("layers")): one.cost
        for one in results_of(scene, map_sizes=(32,), **plan)
    }
    # 4 bytes each: a depth of opaque casters, which every shadow needs, and the layers. A scatter
    # would keep its sums beside these.
    free = found["unshadowed", None]
    slices = [found["opacity_shadow_maps", n] for n in (4, 16)]
    assert [one.bytes_per_texel - free.bytes_per_texel for one in slices] == [4 + 16, 4 + 64]
    assert found["deep_opacity_maps", 16].passes > slices[1].passes == slices[0].passes > 0
    assert found["density_clustering", None].bytes_per_texel > slices[0].bytes_per_texel


def test_a_bias_holds_for_all_sides(scene: po.Scene) -> None:
    """So wide that nothing casts: whatever is compared with what, T is 1."""
    for result in results_of(scene, parameters={"bias": 100.0}):
        assert result.depth.maximum == result.total.maximum == 0.0
        assert result.image.maximum < 1e-6


@pytest.mark.gl
def test_a_scene_needs_a_light(scene: po.Scene) -> None:
    scene.remove(scene.lights)
    with pytest.raises(po.ParameterError, match="0 lights"):
        results_of(scene)


# ---- the command ----


def words_of(page: str) -> str:
    return re.sub(r"<[^>]+>", " ", page)


@pytest.fixture(scope="module")
def folder(needs_gl: None, python: Run, tmp_path_factory: Any) -> pathlib.Path:
    """Of a comparison on two maps and with two numbers of layers."""
    output: pathlib.Path = tmp_path_factory.mktemp("compare") / "results"
    flags = ("--map-size", "64,128", "--layers", "2,8", "--seed", "5", *FLAGS)
    result = python("-m", "pyopacity", "compare", DEMO, "-o", str(output), *flags)
    assert (result.returncode, result.stderr) == (0, ""), result.stderr
    assert str(output / "index.html") in result.stdout
    return output


def rows_of(folder: pathlib.Path) -> list[dict[str, Any]]:
    rows: list[dict[str, Any]] = json.loads((folder / "results.json").read_text("utf-8"))
    return rows


def test_rows_say_what_was_measured(folder: pathlib.Path) -> None:
    rows = rows_of(folder)
    assert len(rows) == 2 * len(Plan(layers=(2, 8)).variants())
    assert {row["map_size"] for row in rows} == {64, 128}
    for row in rows:
        assert (row["scene"], row["seed"], row["receivers"]) == (DEMO, 5, 300)
        assert row["renderer"] and row["version"] == po.__version__
        assert row["footprint"] > 0.0 and "--seed=5" in row["command"]
        for kind in ("depth", "total", "image"):
            rmse, mae = row[f"{kind}_rmse"], row[f"{kind}_mae"]
            assert abs(row[f"{kind}_bias"]) <= mae <= rmse <= row[f"{kind}_maximum"]
    depth = {row["technique"]: row["depth_rmse"] for row in rows}
    assert depth["exact"] == 0.0 and depth["unshadowed"] == max(depth.values())


def test_the_table_holds_the_same_rows(folder: pathlib.Path) -> None:
    with (folder / "results.csv").open(newline="", encoding="utf-8") as file:
        table = list(csv.DictReader(file))
    rows = rows_of(folder)
    assert len(table) == len(rows) and list(table[0]) == list(rows[0])
    for line, row in zip(table, rows, strict=True):
        assert line["technique"] == row["technique"]
        assert float(line["total_rmse"]) == row["total_rmse"]
        values = [f"{name}={value}" for name, value in row["parameters"].items()]
        assert line["parameters"].split() == values


def test_the_page_shows_every_technique_and_its_pictures(folder: pathlib.Path) -> None:
    page = (folder / "index.html").read_text("utf-8")
    shown = words_of(page)
    for row in rows_of(folder):
        assert row["technique"] in shown and f"{row['total_rmse']:.4f}" in shown
        for name in ("picture", "traced", "error_map"):
            assert f'src="{row[name]}"' in page
            assert (folder / row[name]).read_bytes().startswith(b"\x89PNG")
    assert page.count("<svg") == 3 and "http" not in page  # nothing comes from elsewhere
    assert "nan" not in shown.lower().replace("transmittance", "")
    assert not list(folder.rglob("*.part"))


@pytest.mark.gl
def test_media_are_shown_and_have_no_image_error(run: Run, tmp_path: pathlib.Path) -> None:
    demo = ("demo:smoke?voxels=500", "-o", str(tmp_path), "--map-size", "32", *FLAGS)
    result = run(*demo, "--technique", "exact", "--technique", "unshadowed")
    assert result.returncode == 0, result.stderr
    for row in rows_of(tmp_path):
        assert row["image_rmse"] is row["flip"] is row["traced"] is row["error_map"] is None
        assert (tmp_path / row["picture"]).read_bytes().startswith(b"\x89PNG")
    page = (tmp_path / "index.html").read_text("utf-8")
    assert page.count("<img") == 2 and "along a view" in page and "image error" not in page


@pytest.mark.gl
def test_the_command_in_a_row_measures_it_again(
    run: Run, folder: pathlib.Path, tmp_path: pathlib.Path
) -> None:
    one = next(row for row in rows_of(folder) if row["technique"] == "bounding_opacity_maps")
    words = shlex.split(one["command"])
    assert words[:2] == ["pyopacity", "compare"]
    result = run(*words[2:], "-o", str(tmp_path), "--technique", one["technique"], "--json")
    again = json.loads(result.stdout)[0]
    for name in ("depth_rmse", "total_rmse", "image_rmse", "flip", "footprint", "parameters"):
        assert again[name] == one[name], name


@pytest.mark.gl
def test_file_names_in_the_page_are_harmless(run: Run, tmp_path: pathlib.Path) -> None:
    mesh = tmp_path / "<b>&.obj"
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    result = run(str(mesh), "-o", str(tmp_path / "out"), "--technique", "exact", *FLAGS)
    assert (result.returncode, result.stderr) == (0, "")
    page = (tmp_path / "out/index.html").read_text("utf-8")
    assert "<b>&.obj" not in page and "&lt;b&gt;&amp;.obj" in page


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ((DEMO,), "--output"),
        (("-o", "out"), "FILE"),
        ((DEMO, "-o", "no/such/folder/out"), "folder"),
        ((DEMO, "-o", "a file"), "is a file"),
        ((DEMO, "-o", "out", "--technique", "exakt"), '"exact"'),
        ((DEMO, "-o", "out", "--param", "layesr=8"), '"layers"'),
        ((DEMO, "-o", "out", "--layers", "0"), "--layers"),
        ((DEMO, "-o", "out", "--layers", "4000"), "1..64"),
        ((DEMO, "-o", "out", "--map-size", "512,"), "--map-size"),
        ((DEMO, "-o", "out", "--map-size", "99999"), "1..16384"),
        ((DEMO, "-o", "out", "--map-size", "512,atuo"), "--map-size"),
        ((DEMO, "-o", "out", "--device", "tpu"), "--device"),
        ((DEMO, "-o", "out", "--receivers", "0"), "--receivers"),
        ((DEMO, "-o", "out", "--receivers", "many"), "--receivers"),
        ((DEMO, "-o", "out", "--samples", "0"), "--samples"),
        ((DEMO, "-o", "out", "--seed", "-1"), "--seed"),
        ((DEMO, "-o", "out", "--footprint", "-1"), "--footprint"),
        ((DEMO, "-o", "out", "--footprint", "nan"), "--footprint"),
        ((DEMO, "-o", "out", "--image-size", "0x5"), "1..16384"),
        ((DEMO, "-o", "out", "--image-samples", "9"), "--image-samples"),
        ((DEMO, "-o", "out", "--antialiasing", "2"), "--antialiasing"),
        ((DEMO, "-o", "out", "--ambient", "-1"), "ambient"),
        ((DEMO, "-o", "out", "--camera", "0,0,1"), "up"),
        (("nothing.hair", "-o", "out"), "nothing.hair"),
    ],
)
def test_bad_usage_is_one_line_and_leaves_nothing(
    run: Run,
    tmp_path: pathlib.Path,
    monkeypatch: pytest.MonkeyPatch,
    arguments: Sequence[str],
    named: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a file").touch()
    result = run(*arguments)
    assert (result.returncode, result.stdout) == (2, "")
    assert len(result.stderr.splitlines()) == 1 and "; fix: " in result.stderr
    assert named in result.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["a file"]


def test_no_context_is_exit_code_3_and_leaves_nothing(run: Run, tmp_path: pathlib.Path) -> None:
    arguments = (DEMO, "-o", str(tmp_path / "out"), "--device", "gpu", *FLAGS)
    result = run(*arguments, OPACITY_LIBEGL=NO_OPENGL)
    assert result.returncode == 3 and len(result.stderr.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.gl
def test_ctrl_c_keeps_whole_rows_and_no_half_file(python: Run, tmp_path: pathlib.Path) -> None:
    output = tmp_path / "out"
    sizes = ",".join(str(size) for size in range(64, 256, 4))
    arguments = (DEMO, "-o", str(output), "--map-size", sizes, *FLAGS)
    result = python("-c", interrupting.AT_FIRST_PAGE, str(output), "compare", *arguments)
    assert (result.returncode, result.stderr) == (130, "")
    assert not list(output.rglob("*.part"))
    rows = rows_of(output)
    assert 0 < len(rows) < 100
    assert all((output / row["picture"]).exists() for row in rows)
    assert (output / "index.html").read_text("utf-8").endswith("</html>\n")
