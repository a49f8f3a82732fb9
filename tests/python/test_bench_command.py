"""The command ``pyopacity bench``: what it refuses, leaves out, prints and writes."""

import json
import pathlib
import shlex
import subprocess
from collections.abc import Callable, Sequence

import numpy as np
import pytest

import interrupting
import pyopacity as po

Shell = Callable[..., subprocess.CompletedProcess[str]]

HAIR = "demo:hair?segments=300"


@pytest.fixture
def bench(python: Shell) -> Shell:
    def run(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
        return python("-m", "pyopacity", "bench", *arguments, **environment)

    return run


def test_without_opengl_it_says_what_it_leaves_out(bench: Shell, tmp_path: pathlib.Path) -> None:
    output = tmp_path / "out"
    flags = ("--quick", "--only", "P2,P4", "--device", "cpu", "--json")
    result = bench("-o", str(output), *flags, OPACITY_LIBEGL="/nonexistent/libEGL.so.1")
    assert (result.returncode, result.stderr) == (0, ""), result.stderr
    document = json.loads(result.stdout)
    rows = document["tables"]["goals"]["rows"]
    assert [row["goal"] for row in rows] == ["P2", "P4"]
    assert "OpenGL" in rows[0]["note"] and rows[1]["measured"] > 0.0
    assert document["machine"]["renderer"] == "none"
    words = shlex.split(document["command"])
    assert words == ["pyopacity", "bench", "--device=cpu", "--only=P2,P4", "--quick"]
    assert {path.name for path in output.iterdir()} == {"goals.csv", "results.json", "index.html"}


def test_what_cannot_be_measured_has_a_page_that_says_why(
    bench: Shell, tmp_path: pathlib.Path
) -> None:
    result = bench("-o", str(tmp_path / "out"), "--quick", "--only", "frames", "--device", "cpu")
    assert (result.returncode, result.stderr) == (0, "")
    assert "not measured: pictures need OpenGL" in result.stdout
    page = pathlib.Path(result.stdout.splitlines()[-1])
    assert "pictures need OpenGL" in page.read_text("utf-8")


def test_a_file_takes_the_place_of_generated_scenes(bench: Shell, tmp_path: pathlib.Path) -> None:
    flags = ("--quick", "--only", "errors", "--device", "cpu", "--map-size", "16", "--layers", "2")
    result = bench(HAIR, "-o", str(tmp_path), *flags, "--opacity", "0", "--json")
    assert result.returncode == 0, result.stderr
    rows = json.loads(result.stdout)["tables"]["errors"]["rows"]
    assert {(row["scene"], row["map"]) for row in rows} == {(HAIR, 16)}
    # Hair that lets everything through: the solid head alone casts, and nobody tells techniques
    # apart.
    layered = [row["total error"] for row in rows if "layers 2" in row["technique"]]
    assert len(layered) > 3 and np.ptp(layered) < 1e-6


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ((), "--output"),
        (("-o", "no/such/folder/out"), "folder"),
        (("-o", "out", "--only", "P12"), "P12"),
        (("-o", "out", "--only", "erorrs"), '"errors"'),
        (("-o", "out", "--scenes", "hare"), '"hair"'),
        (("-o", "out", "--device", "tpu"), "--device"),
        (("-o", "out", "--map-size", "99999"), "1..16384"),
        (("-o", "out", "--layers", "4000"), "1..64"),
        (("-o", "out", "--layers", "128"), "1..64"),
        (("-o", "out", "--opacity", ".3"), "--opacity"),
        (("-o", "out", "--only", "P6,goals", "--scenes", "hair"), "--only errors"),
        (("-o", "out", "--only", "frames,costs", "--map-size", "64"), "frames, costs"),
        (("-o", "out", "--only", "P7", "--layers", "8"), "--only errors or P6 or goals"),
        (("nothing.hair", "-o", "out", "--scenes", "hair"), "--scenes"),
        (("nothing.hair", "-o", "out", "--device", "cpu"), "nothing.hair"),
    ],
)
def test_bad_usage_is_one_line_and_leaves_nothing(
    bench: Shell,
    tmp_path: pathlib.Path,
    monkeypatch: pytest.MonkeyPatch,
    arguments: Sequence[str],
    named: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    result = bench(*arguments)
    assert (result.returncode, result.stdout) == (2, ""), result.stderr
    assert len(result.stderr.splitlines()) == 1 and "; fix: " in result.stderr
    assert named in result.stderr
    assert list(tmp_path.iterdir()) == []


def test_ctrl_c_keeps_whole_tables_and_no_half_file(python: Shell, tmp_path: pathlib.Path) -> None:
    output = tmp_path / "out"
    arguments = ("bench", "-o", str(output), "--quick", "--device", "cpu", "--only", "costs")
    result = python("-c", interrupting.AT_FIRST_PAGE, str(output), *arguments)
    assert (result.returncode, result.stderr) == (130, "")
    assert not list(output.rglob("*.part"))
    tables = json.loads((output / "results.json").read_text("utf-8"))["tables"]
    assert len(tables["passes"]["rows"]) > 0
    assert len({row["technique"] for row in tables["passes"]["rows"]}) < len(po.techniques())
    assert all((output / f"{name}.csv").exists() for name in tables)
    assert (output / "index.html").read_text("utf-8").endswith("</html>\n")
