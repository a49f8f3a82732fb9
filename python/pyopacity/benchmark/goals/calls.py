"""P8 and P9: T without OpenGL beside rays, and Python beside C++."""

from __future__ import annotations

from collections.abc import Iterator

from pyopacity.benchmark import calls
from pyopacity.benchmark.goals.goal import Goal
from pyopacity.benchmark.peers import rays
from pyopacity.benchmark.run import Run, hair_of
from pyopacity.benchmark.table import Row

LOOK_UP = Goal("P8", "T of every vertex without OpenGL / one ray a vertex", 1.0 / 30.0)
CALL = Goal("P9", "a frame from Python / the same in C++, everything anew", 1.02)


def look_up(run: Run) -> Iterator[Row]:
    """P8."""
    found = run.once(rays.measure)
    maps, traced = found.turns.median(rays.MAPS), found.turns.median(rays.RAYS)
    note = f"{found.backend}: {maps:.3f} / {traced:.2f} s"
    ratio = found.turns.ratio(rays.MAPS, rays.RAYS)
    yield LOOK_UP.measured(ratio, found.where, found.turns.rounds, note)


def call(run: Run) -> Iterator[Row]:
    """P9, for each kind of frame."""
    where = f"{hair_of(run.plan.goals.call_segments)}, {run.plan.device}"
    if (missing := calls.missing(run)) is not None:
        yield CALL.not_measured(where, missing)
        return
    turns = run.once(calls.turns_of)
    for frame in turns.parts(calls.PYTHON):
        if frame in calls.ANEW:
            theirs, ours = (turns.median(of, frame) for of in (calls.CPP, calls.PYTHON))
            note = f"{ours / 1000.0:.3g} / {theirs / 1000.0:.3g} ms, each turn in a fresh process"
            ratio = calls.ratio(turns, frame)
            yield CALL.measured(ratio, f"{where}, {frame}", turns.rounds, note)
