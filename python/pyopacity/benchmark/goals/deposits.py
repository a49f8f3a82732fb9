"""P3, P4, P10: what it costs to get casters into a map, and how that grows."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from typing import Any

from pyopacity.benchmark import ways
from pyopacity.benchmark.clock import Turns, all_maps
from pyopacity.benchmark.goals.goal import Goal
from pyopacity.benchmark.run import Run, hair_of
from pyopacity.benchmark.table import Row
from pyopacity.renderer import Renderer
from pyopacity.technique import technique

LAYERS = Goal("P3", "layers scattered / blended, 32 layers", 0.2)
BOUNDS = Goal("P4", "both bounds in one pass / in two", 0.6)
_SEGMENTS = Goal("P10", "maps of 10 times the segments / of one", 10.0)
_TEXELS = Goal("P10", "maps of 4 times the texels / of one", 4.0)
_MORE_LAYERS = Goal("P10", "maps of 32 layers / of 4", 1.5)
_MANY, _FEW = 32, 4
_LAYER_PASSES, _BOUNDS_PASSES = ("opacity", "moments"), ("bounds", "start_depth", "end_depth")
_INTERPOLATIONS = ("mean_depth", "linear")

# Segments, texels along a side, parameters of bounding opacity maps.
Case = tuple[int, int, Mapping[str, Any]]


def scattered(run: Run) -> Iterator[Row]:
    """P3, by either interpolation."""
    goals = run.plan.goals
    where = f"{hair_of(goals.deposit_segments)}, map {goals.map_size}"
    if run.plan.device == "cpu":
        yield LAYERS.not_measured(where, "both ways are of OpenGL")
        return
    for interpolation in _INTERPOLATIONS:
        common = {"layers": _MANY, "interpolation": interpolation}
        case = goals.deposit_segments, goals.map_size
        turns = _turns(
            run,
            {
                way: (*case, {**common, "deposit": way, "deposit_rule": "area"})
                for way in ("scatter", "blend")
            },
        )
        of = LAYERS, turns, _LAYER_PASSES
        yield _row(*of, ("scatter", "blend"), where, interpolation)


def bounds(run: Run) -> Iterator[Row]:
    """P4, by either deposit."""
    goals = run.plan.goals
    where = f"{hair_of(goals.segments[0])}, map {goals.map_size}"
    case = goals.segments[0], goals.map_size
    few = {"layers": 1}
    cases: dict[str, Case] = {"two passes": (*case, {**few, "bounds": "depth_func"})}
    if run.plan.device == "cpu":
        cases["one pass"] = (*case, few)
    else:
        cases |= {way: (*case, {**few, "deposit": way}) for way in ("blend", "scatter")}
        cases["two passes"] = (*case, {**few, "bounds": "depth_func", "deposit": "blend"})
    turns = _turns(run, cases)
    for way in cases:
        if way != "two passes":
            yield _row(BOUNDS, turns, _BOUNDS_PASSES, (way, "two passes"), where, way)


def growth(run: Run) -> Iterator[Row]:
    """The three parts of P10."""
    goals = run.plan.goals
    segments, map_size = goals.segments[0], goals.map_size
    cases: dict[str, tuple[Goal, Case, Case]] = {
        f"{hair_of(segments)} and {10 * segments:,}, map {map_size}": (
            _SEGMENTS,
            (segments, map_size, {}),
            (10 * segments, map_size, {}),
        ),
        f"{hair_of(segments)}, maps {map_size} and {2 * map_size}": (
            _TEXELS,
            (segments, map_size, {}),
            (segments, 2 * map_size, {}),
        ),
    }
    for name in _INTERPOLATIONS:
        more = {"interpolation": name}
        cases[f"{hair_of(segments)}, map {map_size}, {name}"] = (
            _MORE_LAYERS,
            (segments, map_size, {**more, "layers": _FEW}),
            (segments, map_size, {**more, "layers": _MANY}),
        )
    for where, (goal, small, large) in cases.items():
        turns = _turns(run, {"small": small, "large": large})
        yield goal.measured(turns.ratio("large", "small"), where, turns.rounds)


def _row(
    goal: Goal,
    turns: Turns,
    passes: tuple[str, ...],
    over_under: tuple[str, str],
    where: str,
    note: str,
) -> Row:
    """Of two ways, by the time of the passes that start with one of these names."""
    own = turns.summed(lambda part: part.rpartition("/")[2].startswith(passes))
    over, under = (1000.0 * own.median(way) for way in over_under)
    if over == 0.0 or under == 0.0:
        return goal.not_measured(where, f"{note}: a map has none of the passes {', '.join(passes)}")
    told = f"{note}; {over:.0f} / {under:.0f} ms"
    return goal.measured(own.ratio(*over_under), where, turns.rounds, told)


def _turns(run: Run, cases: Mapping[str, Case]) -> Turns:
    """Maps of bounding opacity maps with a split that is given: nothing is searched."""
    with ExitStack() as stack:
        works = {}
        for name, (segments, map_size, parameters) in cases.items():
            run.tell(f"maps of {hair_of(segments)}, {map_size}^2: {name}")
            shadows = technique(ways.BOUNDING, **{**ways.FIXED_SPLIT, **parameters})
            renderer = Renderer(
                run.hair(segments), device=run.plan.device, technique=shadows, map_size=map_size
            )
            works[name] = all_maps(stack.enter_context(renderer))
        return run.plan.clock.in_turns(works)
