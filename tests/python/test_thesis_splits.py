"""The thesis's tables A.11.1 to A.11.6 and 5.2.3.1, in the paper's mode on generated scenes.

Trends only: its models and its machine are gone. What does not show here is in docs/accuracy.md.
"""

import sys
from pathlib import Path

import pytest

import pyopacity as po

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "docs/papers"))
from bounding_opacity_maps import _splits as thesis_splits

MAP_SIZE = 128
DIFFERENCES, CORRELATION = (f"{name}, thesis" for name in thesis_splits.THESIS)
Scenes = dict[tuple[str, str], po.Scene]
Picks = dict[tuple[str, str, str, int], float]


@pytest.fixture(scope="module")
def scenes() -> Scenes:
    return {(name, light): scene for name, light, scene in thesis_splits.scenes()}


@pytest.fixture(scope="module")
def picks(scenes: Scenes) -> Picks:
    """By scene, light, measure and layers."""
    return {
        (name, light, measure, layers): thesis_splits.picked(scene, MAP_SIZE, measure, layers)
        for (name, light), scene in scenes.items()
        for measure in (DIFFERENCES, CORRELATION)
        for layers in (16, 32)
    }


def test_the_ratio_falls_when_layers_grow(picks: Picks) -> None:
    """Never the other way from above; sideways correlation keeps ratios near 1 (A.11.4: .8, .7)."""
    for name in thesis_splits.SCENES:
        for light in thesis_splits.LIGHTS:
            few, many = (picks[name, light, DIFFERENCES, layers] for layers in (16, 32))
            assert many < few
        few, many = (picks[name, "above", CORRELATION, layers] for layers in (16, 32))
        assert many < few


def test_sparse_grass_has_no_higher_ratio_than_dense_grass(picks: Picks) -> None:
    """From above; sideways correlation takes 1.0 for sparse and .3 for dense grass of 32 layers."""
    for measure in (DIFFERENCES, CORRELATION):
        for layers in (16, 32):
            sparse, dense = (
                picks[name, "above", measure, layers] for name in ("grass", "dense grass")
            )
            assert sparse <= dense
    assert picks["grass", "above", CORRELATION, 16] < picks["dense grass", "above", CORRELATION, 16]


def test_grass_from_above_is_sparser_than_from_sideways(picks: Picks) -> None:
    for layers in (16, 32):
        above, sideways = (
            picks["grass", light, CORRELATION, layers] for light in thesis_splits.LIGHTS
        )
        assert above < sideways


def test_correlation_spans_more_than_absolute_differences_on_grass(picks: Picks) -> None:
    def span(measure: str) -> float:
        found = [
            picks[name, light, measure, layers]
            for name in ("grass", "dense grass")
            for light in thesis_splits.LIGHTS
            for layers in (16, 32)
        ]
        return max(found) - min(found)

    assert span(CORRELATION) > span(DIFFERENCES)


@pytest.mark.parametrize("ratio", [0.0, 1.0])
def test_correlation_rises_with_layers(scenes: Scenes, ratio: float) -> None:
    """So that it cannot choose their number (table 5.2.3.1: .66 .83 .92 .96 on trees)."""
    for scene in scenes.values():
        found = [
            thesis_splits.mean_correlation(scene, MAP_SIZE, layers, ratio)
            for layers in (4, 8, 16, 32)
        ]
        assert found == sorted(found) and found[-1] > found[0] + 0.01
        assert found[0] > 0.0 and found[-1] < 1.0
