"""The split search: what it finds, how well, in which frames, and when it does so again."""

import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyopacity as po

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "benchmarks"))
import generated_scenes as generated
import split_search

pytestmark = pytest.mark.gl

MAPS = "bounding_opacity_maps"
SEARCH = f"{MAPS}/split_search"
TRIALS = 11


def ran(renderer: po.Renderer) -> set[str]:
    names = {row.name for row in renderer.report if row.status == "ran"}
    return {name.removeprefix(f"{MAPS}/") for name in names}


def note(renderer: po.Renderer) -> str:
    return next(row.note for row in renderer.report if row.name == SEARCH)


def why(renderer: po.Renderer) -> str:
    return next(row.why for row in renderer.report if row.name == SEARCH)


@pytest.fixture
def by_frames(new_renderer: Callable[[], po.Renderer]) -> Iterator[po.Renderer]:
    """Searches in eleven frames, by neighbours, so that no histogram is drawn."""
    with new_renderer() as renderer:
        renderer.technique.search_frames = TRIALS
        renderer.technique.similarity = "correlation"
        yield renderer


def search(renderer: po.Renderer) -> list[str]:
    """The notes of all frames until nothing runs."""
    notes = []
    for _ in range(TRIALS + 5):
        renderer.render()
        if not ran(renderer):
            return notes
        notes.append(note(renderer))
    raise AssertionError("the search does not end")


# ---- what it finds ----


@pytest.mark.parametrize("layers", [2, 16])
@pytest.mark.parametrize("similarity", split_search.SIMILARITIES)
def test_every_similarity_finds_one_of_eleven_ratios(
    renderer: po.Renderer, similarity: str, layers: int
) -> None:
    renderer.technique.similarity, renderer.technique.layers = similarity, layers
    renderer.render()
    start, _, ratio = note(renderer).rpartition(" ")
    assert start == "split ratio"
    assert float(ratio) in split_search.RATIOS


def test_the_found_ratio_is_the_one_drawn(renderer: po.Renderer) -> None:
    points = renderer.scene.shapes[0]
    found = renderer.transmittance(points)
    ratio = float(note(renderer).rpartition(" ")[2])
    renderer.technique.split, renderer.technique.split_ratio = "hybrid", ratio
    assert np.array_equal(renderer.transmittance(points), found)


@pytest.mark.parametrize("similarity", split_search.SIMILARITIES)
def test_eleven_frames_find_what_one_does(needs_gl: None, similarity: str) -> None:
    """Up to the histogram's cells: the same ratio, or the next with nearly the same depth error.

    Four layers: with eight, the two correlations of histogram and layers differ by up to .3.
    """
    strands = generated.tree(leaves=1500)
    kept = []
    for frames in (1, TRIALS):
        rows = split_search.study(
            strands, generated.ABOVE, 128, layers=(4,), similarities=(similarity,), frames=frames
        )
        ((_, errors, picks),) = rows
        kept.append(picks[similarity])
    assert abs(kept[0] - kept[1]) < 0.11
    assert errors[kept[0]] == pytest.approx(errors[kept[1]], rel=0.1)


@pytest.mark.parametrize("light", generated.LIGHTS)
@pytest.mark.parametrize("kind", generated.GENERATED)
def test_the_default_search_costs_at_most_a_tenth(needs_gl: None, kind: str, light: str) -> None:
    """Depth error of the picked ratio against the best of the eleven."""
    small = {"hair": 6000, "grass": 1500, "tree": 2500, "scattered": 2500}
    rows = split_search.study(
        generated.GENERATED[kind](small[kind]),
        generated.LIGHTS[light],
        map_size=128,
        layers=(4, 16),
        similarities=("error",),
    )
    for layers, errors, picks in rows:
        assert errors[picks["error"]] <= 1.1 * min(errors.values()), layers


def test_one_layer_has_nothing_to_search(renderer: po.Renderer) -> None:
    renderer.technique.layers = 1
    for frames in (1, TRIALS):
        renderer.technique.search_frames = frames
        renderer.render()
        assert all(row.name != SEARCH for row in renderer.report)
        renderer.render()
        assert ran(renderer) == set()


def test_search_frames_are_one_or_eleven() -> None:
    assert po.technique(MAPS).search_frames == 1
    assert po.technique(MAPS, search_frames=11.0).search_frames == 11
    for wrong in (0, 2, 10, 12, True, "11", 1.5):
        with pytest.raises(po.ParameterError, match="search_frames"):
            po.technique(MAPS, search_frames=wrong)


# ---- eleven frames ----


def test_each_frame_is_a_trial_and_then_nothing_runs(by_frames: po.Renderer) -> None:
    for trial in range(TRIALS):
        by_frames.render()
        assert {"opacity", "split_search", "lighting"} <= ran(by_frames)
        assert ("bounds" in ran(by_frames)) == (trial == 0)
        progress = f"trial {trial + 1} of 11: ratio {trial / 10}"
        assert note(by_frames).startswith(progress)
    found = note(by_frames).removeprefix(f"{progress}; ")
    assert found.startswith("split ratio ")
    by_frames.render()  # draws what was found, unless the last trial was the best
    assert ran(by_frames) <= {"opacity", "split_search", "lighting"}
    assert note(by_frames).endswith(found)
    by_frames.render()
    assert ran(by_frames) == set()
    assert note(by_frames).endswith(found)


def test_each_trial_shades_its_frame(by_frames: po.Renderer) -> None:
    points = by_frames.scene.shapes[0]
    trials = [by_frames.transmittance(points) for _ in range(TRIALS)]
    by_frames.technique.split = "hybrid"
    for ratio, of_trial in zip(split_search.RATIOS, trials, strict=True):
        by_frames.technique.split_ratio = ratio
        assert np.array_equal(by_frames.transmittance(points), of_trial)


def move_light(renderer: po.Renderer) -> None:
    renderer.scene.lights[0].direction = (0.1, 0.6, -0.8)


def move_casters(renderer: po.Renderer) -> None:
    hair = renderer.scene.shapes[0]
    hair.points = hair.points * 0.98


def fade(renderer: po.Renderer) -> None:
    renderer.scene.shapes[0].opacity = 0.2


def fewer_layers(renderer: po.Renderer) -> None:
    renderer.technique.layers = 6


def another_similarity(renderer: po.Renderer) -> None:
    renderer.technique.similarity = "absolute_difference"


def another_bias(renderer: po.Renderer) -> None:
    renderer.technique.bias = 0.1


def by_hand(renderer: po.Renderer) -> None:
    renderer.needs_recompute()


RESTARTS = [
    move_light,
    move_casters,
    fade,
    fewer_layers,
    another_similarity,
    another_bias,
    by_hand,
]


@pytest.mark.parametrize("change", RESTARTS, ids=lambda change: change.__name__)
def test_it_searches_again_after_a_change(
    by_frames: po.Renderer, change: Callable[[po.Renderer], Any]
) -> None:
    search(by_frames)
    change(by_frames)
    notes = search(by_frames)
    assert notes[0] == "trial 1 of 11: ratio 0.0"
    assert notes[TRIALS - 1].startswith("trial 11 of 11: ratio 1.0; split ratio ")

    change_again = move_light if change is not move_light else fade
    change_again(by_frames)
    for _ in range(4):  # in the middle of a search
        by_frames.render()
    by_hand(by_frames)
    assert search(by_frames) == search_of_a_new_renderer(by_frames)


def search_of_a_new_renderer(used: po.Renderer) -> list[str]:
    with po.Renderer(
        used.scene, used.camera, technique=used.technique, size=used.size, map_size=used.map_size
    ) as fresh:
        return search(fresh)


@pytest.mark.parametrize("frames", [1, TRIALS])
def test_the_report_says_what_made_it_search(
    new_renderer: Callable[[], po.Renderer], frames: int
) -> None:
    with new_renderer() as renderer:
        renderer.technique.search_frames = frames
        search(renderer)
        for change, moved in (
            (by_hand, "needs_recompute"),
            (fade, "opacity"),
            (another_similarity, "similarity"),
            (fewer_layers, "layers"),
            (another_bias, "bias"),
        ):
            change(renderer)
            renderer.render()
            assert "split_search" in ran(renderer), moved
            assert moved in why(renderer)


def test_opaque_casters_that_move_start_a_search_in_the_next_frame(
    by_frames: po.Renderer,
) -> None:
    search(by_frames)
    ball = by_frames.scene.shapes[1]
    points = ball.points.copy()
    points[2 * 17 + 2] += 0.02 * (ball.bounds[0] + ball.bounds[1] - 2 * points[2 * 17 + 2])
    ball.points = points  # a dent that leaves the light's map where it is
    notes = search(by_frames)
    assert notes[1] == "trial 1 of 11: ratio 0.0"
    assert notes[TRIALS].startswith("trial 11 of 11: ratio 1.0; split ratio ")


@pytest.mark.parametrize("frames", [1, TRIALS])
def test_what_the_split_does_not_depend_on_starts_no_search(
    new_renderer: Callable[[], po.Renderer], frames: int
) -> None:
    with new_renderer() as renderer:
        renderer.technique.search_frames = frames
        search(renderer)
        found = note(renderer)
        renderer.camera = po.Camera.look_at((2, -3, 1), (0, 0, 0.4))
        renderer.scene.shapes[0].color = (1, 0, 0)
        renderer.scene.lights[0].intensity = 0.5
        renderer.render()
        assert ran(renderer) == {"lighting"}
        assert note(renderer) == found


def test_what_was_found_outlasts_the_cached_passes(
    by_frames: po.Renderer, same: Callable[..., bool]
) -> None:
    search(by_frames)
    kept = by_frames.render()
    by_frames.invalidate()
    assert same(by_frames.render(), kept)


def test_renderers_that_share_a_technique_search_apart(
    new_renderer: Callable[[], po.Renderer],
) -> None:
    with new_renderer() as first, new_renderer() as second:
        technique = po.technique(MAPS, search_frames=TRIALS, similarity="absolute_difference")
        first.technique = second.technique = technique
        for _ in range(3):
            first.render()
        second.render()
        assert note(first).startswith("trial 3 of 11")
        assert note(second).startswith("trial 1 of 11")
