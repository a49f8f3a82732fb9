"""The scripts of docs/papers: each runs, the index tells what they found, verdicts are right."""

import ast
import json
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "docs/papers"))
import run_all
from common import Claim, chart, in_same_order, line_fit, medians_in_turns, pictures, rises, script

PAPERS = script.PAPERS
SCRIPTS = script.scripts()
MOST_LINES, MOST_OF_A_FUNCTION, MOST_BYTES = 150, 40, 2_500_000


def name_of(path: Path) -> str:
    return path.relative_to(PAPERS).as_posix()


# ---- every script ----


def test_there_is_one_of_each_paper() -> None:
    assert {path.parent.name for path in SCRIPTS} == set(run_all.NAMES)
    assert len(SCRIPTS) >= 25


@pytest.mark.gl
@pytest.mark.parametrize("path", SCRIPTS, ids=name_of)
def test_a_script_runs(tmp_path: Path, path: Path) -> None:
    result = script.run(path, "smallest", tmp_path)
    assert json.loads((tmp_path / f"{path.stem}.json").read_text("utf-8")) == result
    assert result["figure"] and result["shows"]
    assert result["claims"]
    for claim in result["claims"]:
        assert all(claim[key] for key in ("what", "paper", "ours", "verdict"))
        assert "nan" not in claim["ours"]
    for name in result["pictures"]:
        with Image.open(tmp_path / name) as picture:
            assert picture.mode == "P"
            assert len(picture.getcolors(256)) > 3


@pytest.mark.parametrize("path", sorted(PAPERS.rglob("*.py")), ids=name_of)
def test_scripts_and_their_functions_are_short(path: Path) -> None:
    text = path.read_text("utf-8")
    assert len(text.splitlines()) <= MOST_LINES
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef):
            assert node.end_lineno - node.lineno < MOST_OF_A_FUNCTION, node.name


# ---- the index ----


def test_the_index_lists_every_script_and_what_it_found() -> None:
    page = (PAPERS / "README.md").read_text("utf-8")
    for path in SCRIPTS:
        assert f"]({name_of(path)})" in page
        assert path.with_suffix(".json").exists()
    assert run_all.tables() in page


def test_pictures_are_those_of_scripts_and_small() -> None:
    told = {path.parent / name for path, found in run_all.results() for name in found["pictures"]}
    there = set(PAPERS.rglob("*.png"))
    assert there == told
    assert sum(path.stat().st_size for path in there) < MOST_BYTES


def test_a_verdict_that_fails_says_why() -> None:
    for path, found in run_all.results():
        for claim in found["claims"]:
            assert claim["holds"] or "not known" not in claim["verdict"], (path, claim["what"])


# ---- verdicts, by numbers made up ----


def test_what_rises() -> None:
    assert rises([1.0, 2.0, 3.0])
    assert not rises([1.0, 2.0, 2.0])
    assert not rises([1.0, 2.0, 1.9])
    assert rises([1.0, 2.0, 1.9], slack=0.1)
    assert not rises([1.0, 2.0, 1.7], slack=0.1)


def test_what_is_in_the_same_order() -> None:
    paper = {"a": 1.0, "b": 2.0, "c": 2.0, "d": 10.0}
    assert in_same_order(paper, {"a": 5.0, "b": 7.0, "c": 6.0, "d": 8.0})
    assert not in_same_order(paper, {"a": 5.0, "b": 7.0, "c": 6.0, "d": 6.5})
    assert in_same_order(paper, {"a": 5.0, "b": 7.0, "c": 6.0, "d": 6.5}, slack=0.1)
    assert not in_same_order(paper, {"a": 9.0, "b": 7.0, "c": 6.0, "d": 10.0}, slack=0.1)


def test_a_line_is_found_and_how_well_it_fits() -> None:
    slope, start, fit = line_fit([1, 2, 3, 4], [5.0, 7.0, 9.0, 11.0])
    assert (slope, start, fit) == pytest.approx((2.0, 3.0, 1.0))
    # Of 0, 0, 3 over 0, 1, 2: slope 1.5, residuals .5, -1, .5, spread 6.
    slope, start, fit = line_fit([0, 1, 2], [0.0, 0.0, 3.0])
    assert (slope, start, fit) == pytest.approx((1.5, -0.5, 1.0 - 1.5 / 6.0))


def test_verdicts_say_what_is_known() -> None:
    told = {"what": "it", "paper": "1", "ours": "2"}
    assert Claim(**told, holds=True, why="never shown").verdict == "holds"
    assert Claim(**told, holds=True, note="and more").verdict == "holds; and more"
    assert Claim(**told, holds=False, why="other").verdict == "does not hold: other"
    assert "not known" in Claim(**told, holds=False).verdict


def test_turns_give_medians_without_the_first_round() -> None:
    values = {"a": iter([100.0, 3.0, 1.0, 2.0]), "b": iter([0.0, 5.0, 5.0, 50.0])}
    ways = {name: lambda row=row: {"ms": next(row)} for name, row in values.items()}
    assert medians_in_turns(ways, 3) == {"a": {"ms": 2.0}, "b": {"ms": 5.0}}


# ---- pictures ----


def test_pictures_are_srgb_over_white() -> None:
    linear = np.array([[[0.0, 0.0, 0.0, 1.0], [0.5, 0.5, 0.5, 1.0], [0.0, 0.0, 0.0, 0.0]]])
    assert pictures.to_srgb(linear)[0, :, 0].tolist() == [0, 188, 255]


def test_layers_go_from_green_to_black() -> None:
    colors = pictures.layer_colors(np.array([-0.1, 0.0, 0.24, 0.25, 0.99, 1.5]), 4)
    assert colors[0].tolist() == colors[2].tolist() == pictures.FIRST.tolist()
    assert colors[3].tolist() != colors[2].tolist()
    assert colors[4].tolist() == colors[5].tolist() == [0.0, 0.0, 0.0]


def test_axes_have_round_steps() -> None:
    assert chart.steps(0.0, 1.0) == pytest.approx([0.0, 0.2, 0.4, 0.6, 0.8, 1.0])
    assert chart.steps(10.0, 200.0) == pytest.approx([50.0, 100.0, 150.0, 200.0])
