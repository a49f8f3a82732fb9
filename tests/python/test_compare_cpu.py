"""The comparison on a machine without OpenGL, and on maps whose size nobody named."""

import pathlib
from collections.abc import Callable
from typing import Any

import pytest

import pyopacity as po
from test_compare import DEMO, FLAGS, NO_OPENGL, Run, results_of, rows_of, words_of


@pytest.fixture(scope="module")
def without_opengl(python: Run, tmp_path_factory: Any) -> tuple[pathlib.Path, str]:
    """The folder of a comparison on a machine that has none, and what the command said."""
    output: pathlib.Path = tmp_path_factory.mktemp("compare") / "results"
    arguments = ("-m", "pyopacity", "compare", DEMO, "-o", str(output), "--map-size", "96,auto")
    result = python(*arguments, *FLAGS, OPACITY_LIBEGL=NO_OPENGL)
    assert (result.returncode, result.stderr) == (0, "")
    return output, result.stdout


def test_without_opengl_there_are_errors_of_T_and_no_pictures(
    without_opengl: tuple[pathlib.Path, str],
) -> None:
    folder, told = without_opengl
    assert "no pictures" in told.splitlines()[0] and "image" not in told
    assert {path.name for path in folder.iterdir()} == {"index.html", "results.csv", "results.json"}
    rows = rows_of(folder)
    assert len(rows) == 2 * len(po.techniques())
    for row in rows:
        assert row["renderer"] == "cpu" and "--device=cpu" in row["command"]
        assert row["picture"] is row["image_rmse"] is row["flip"] is None
        assert row["seconds"] >= row["map_seconds"] >= 0.0 and row["seconds"] > 0.0
    exact, unshadowed = (
        next(row for row in rows if row["technique"] == name) for name in ("exact", "unshadowed")
    )
    assert exact["depth_rmse"] == 0.0 and unshadowed["depth_rmse"] > 0.3
    assert exact["total_rmse"] < 0.15 < unshadowed["total_rmse"]  # 16 rays


def test_the_page_without_pictures_says_why(without_opengl: tuple[pathlib.Path, str]) -> None:
    page = (without_opengl[0] / "index.html").read_text("utf-8")
    assert (
        page.count("<svg") == 2 and "<img" not in page and "None" not in page.split("Pictures")[0]
    )
    shown = words_of(page)
    assert "image error" not in shown and "need OpenGL" in shown


def test_a_row_says_which_map_size_was_chosen(without_opengl: tuple[pathlib.Path, str]) -> None:
    folder, told = without_opengl
    given, chosen = (
        [row for row in rows_of(folder) if (row["map_size_reason"] is None) == is_given]
        for is_given in (True, False)
    )
    assert {row["map_size"] for row in given} == {96}
    (size,) = {row["map_size"] for row in chosen}
    assert size % 32 == 0 and size != 96  # as the rule makes them
    assert "strands" in chosen[0]["map_size_reason"] and f"map {size}:" in told
    # It holds for the map that was measured: two of its texels.
    assert chosen[0]["footprint"] * (size - 2) == pytest.approx(
        given[0]["footprint"] * (96 - 2), rel=0.01
    )


@pytest.mark.parametrize("opaque", [False, True])
def test_auto_is_a_size_also_where_there_is_nothing_to_go_by(
    sheet: Callable[..., po.Mesh], opaque: bool
) -> None:
    scene = po.Scene(sheet(opacity=1.0 if opaque else 0.5), po.DirectionalLight((0.0, 0.0, -1.0)))
    for result in results_of(scene, map_sizes=("auto",), device="cpu"):
        assert result.map_size == 512 and result.map_size_reason == "no strands to go by"
        assert result.picture is result.traced is result.image is None


@pytest.mark.gl
def test_both_devices_measure_the_same(scene: po.Scene) -> None:
    plan = {"map_sizes": (64,), "techniques": ("exact", "bounding_opacity_maps")}
    for gpu, cpu in zip(
        results_of(scene, **plan), results_of(scene, device="cpu", **plan), strict=True
    ):
        assert cpu.footprint == gpu.footprint
        assert cpu.depth.rmse == pytest.approx(gpu.depth.rmse, abs=1e-4)
        assert cpu.total.rmse == pytest.approx(gpu.total.rmse, abs=1e-4)
