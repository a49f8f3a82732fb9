"""Total error: T on maps of every size against rays through the real geometry."""

import sys
from pathlib import Path

import numpy as np
import pytest

import pyopacity as po

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "benchmarks"))
import error_models
import generated_scenes
import total_error
from error_models import Bench

MAP_SIZES = (64, 128, 256, 512)  # of a scene of a tenth of the usual strands
RECEIVERS, RAYS = 500, 64


@pytest.fixture(scope="module")
def bench() -> Bench:
    return Bench(error_models.model("twigs", [generated_scenes.scattered(1500)]), RECEIVERS, RAYS)


@pytest.mark.parametrize(
    ("name", "goal"), list(zip(total_error.TECHNIQUES, error_models.UNSEEN, strict=True))
)
def test_the_goals_hold_at_every_map_size(bench: Bench, name: str, goal: float) -> None:
    for errors in total_error.total_errors(bench, name, map_sizes=MAP_SIZES).values():
        assert max(e.rmse for e in errors) <= goal
        most = 0.01 if name == "exact" else 0.015  # see "Own shadow" in docs/accuracy.md
        assert max(abs(e.bias) for e in errors) <= most


def test_a_box_as_wide_as_the_footprint_nears_the_rays(bench: Bench) -> None:
    bilinear, box = total_error.total_errors(bench, "exact", map_sizes=MAP_SIZES).values()
    for narrow, wide in zip(bilinear, box, strict=True):
        assert wide.rmse < 0.8 * narrow.rmse and abs(wide.bias) < 0.005


def test_the_papers_deposit_depends_on_the_map_size(bench: Bench) -> None:
    """A line one texel wide is too dark on coarse maps and too light on fine ones."""
    (errors,) = total_error.total_errors(bench, "exact", "paper", MAP_SIZES).values()
    assert errors[0].bias < -0.05 and errors[-1].bias > 0.05
    assert max(e.rmse for e in errors) > 0.12


@pytest.mark.parametrize("name", total_error.TECHNIQUES)
def test_over_one_footprint_finer_maps_are_never_worse(bench: Bench, name: str) -> None:
    """Widths are those of the footprint, whatever the texel; bilinear is not enough."""
    columns = total_error.footprint_errors(
        bench, name, filters=("box", "none"), map_sizes=MAP_SIZES, judged_px=128
    )
    for label in ("box", "box, matched"):
        rmse = np.array([e.rmse for e in columns[label]])
        assert (rmse[1:] <= (1.0 + total_error.NOISE) * rmse[:-1]).all()
    assert columns["none"][-1].rmse > 3.0 * columns["box"][-1].rmse


def test_an_automatic_map_size_follows_the_strands_or_the_filter(bench: Bench) -> None:
    chosen, why = bench.map_size_choice(po.technique("exact"))
    assert "strands" in why and chosen % 32 == 0
    texel = bench.texel(512)
    wide, why = bench.map_size_choice(po.technique("exact", filter_width=8.0 * texel))
    assert why.startswith("half of filter_width")
    assert wide == pytest.approx(512 / 4, abs=32)
