"""P1, P2, P5: a frame with shadows, over the same frame without."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from pyopacity.benchmark import frames, ways
from pyopacity.benchmark.clock import WHOLE
from pyopacity.benchmark.goals.goal import Goal
from pyopacity.benchmark.run import Run
from pyopacity.benchmark.table import Row
from pyopacity.technique import EXACT, UNSHADOWED

EVERYTHING = Goal("P1", "frame with shadows / without, everything moving", 1.25)
CAMERA = Goal("P2", "frame with shadows / without, only the camera moving", 1.05)
SEARCH = Goal("P5", "search of a split / a frame without it", 2.0)
_OURS = (
    ways.BOUNDING_FIXED,
    frames.LINEAR,
    frames.ALONG_STRANDS,
    ways.BOUNDING,
    ways.ADAPTIVE,
    EXACT,
)


def frame(run: Run) -> Iterator[Row]:
    """Three rows for each size of the scene: of ours the one that takes least."""
    for segments in run.plan.goals.segments:
        where = frames.where(run, segments)
        if run.plan.device == "cpu":
            for goal in (EVERYTHING, CAMERA, SEARCH):
                yield goal.not_measured(where, frames.NEEDS_OPENGL)
            continue
        turns = run.once(frames.turns_of, segments)
        for goal, part in ((EVERYTHING, WHOLE), (CAMERA, frames.CAMERA)):
            ratios = {way: turns.ratio(way, UNSHADOWED, part) for way in _OURS}
            yield goal.measured(min(ratios.values()), where, turns.rounds, _told(ratios))
        if turns.median(ways.BOUNDING, frames.SEARCH) == 0.0:
            yield SEARCH.not_measured(where, "nothing casts that a search would split")
            continue
        ratio = turns.ratio(ways.BOUNDING, ways.BOUNDING_FIXED, frames.SEARCH, WHOLE)
        note = f"passes of a search of {ways.BOUNDING} / a frame of {ways.BOUNDING_FIXED}"
        yield SEARCH.measured(ratio, where, turns.rounds, note)


def _told(ratios: Mapping[str, float]) -> str:
    """Of which way the ratio is, then the others: another goal may have another best one."""
    best, *others = sorted(ratios, key=ratios.__getitem__)
    rest = "; ".join(f"{way} {ratios[way]:.2f}" for way in others)
    return f"of {best} alone; others: {rest}"
