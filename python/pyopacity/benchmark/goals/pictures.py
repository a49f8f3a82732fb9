"""P11: a picture, beside Mitsuba's."""

from __future__ import annotations

from collections.abc import Iterator

from pyopacity.benchmark.goals.goal import Goal
from pyopacity.benchmark.peers import mitsuba
from pyopacity.benchmark.run import Run
from pyopacity.benchmark.table import Row, text_of

TIME = Goal("P11", "a picture, albedo x T / Mitsuba 3 volpath with 16 samples", 1.0 / 150.0)
ERROR = Goal("P11", "RMSE of that picture against Mitsuba's with 256 samples", 0.03)


def picture(run: Run) -> Iterator[Row]:
    """Time and error."""
    if (why := mitsuba.missing(run)) is not None:
        for goal in (TIME, ERROR):
            yield goal.not_measured(run.plan.hair, why)
        return
    found = run.once(mitsuba.measure)
    ours, theirs = (found.turns.median(who) for who in (mitsuba.OURS, mitsuba.THEIRS))
    note = f"{ours:.3f} / {theirs:.2f} s"
    ratio = found.turns.ratio(mitsuba.OURS, mitsuba.THEIRS)
    yield TIME.measured(ratio, found.where, found.turns.rounds, note)
    note = (
        f"of the pixels with strands alone {text_of(found.on_strands)}; "
        f"Mitsuba's own with fewer samples {found.noise:.4f}"
    )
    yield ERROR.measured(found.difference, found.where, 1, note)
