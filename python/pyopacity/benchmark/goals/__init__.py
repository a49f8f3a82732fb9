"""P1 to P11: the ratios that the project is to reach, each measured, and whether it holds."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from pyopacity.benchmark.goals import calls, deposits, errors, frames, pictures
from pyopacity.benchmark.goals.goal import Goal
from pyopacity.benchmark.run import Run
from pyopacity.benchmark.table import Row, Table

_NOTE = """What the project is to reach, what was measured in this run, and whether it holds."""
_QUICK = """ Scenes are small here, and maps coarse: whether a goal holds is told by a run without
--quick."""

# Whose rows a function yields.
_MEASURES: dict[Callable[[Run], Iterator[Row]], tuple[str, ...]] = {
    frames.frame: ("P1", "P2", "P5"),
    deposits.scattered: ("P3",),
    deposits.bounds: ("P4",),
    errors.total: ("P6",),
    errors.depth: ("P7",),
    calls.look_up: ("P8",),
    calls.call: ("P9",),
    deposits.growth: ("P10",),
    pictures.picture: ("P11",),
}
NAMES = tuple(sorted((n for names in _MEASURES.values() for n in names), key=lambda n: int(n[1:])))


def measure(run: Run, only: tuple[str, ...] = NAMES) -> Iterator[Table]:
    """A table that grows goal by goal; ``only`` those of these names."""
    rows: list[Row] = []
    note = _NOTE + (_QUICK if run.plan.is_quick else "")
    for found, names in _MEASURES.items():
        if not set(names) & set(only):
            continue
        rows = rows + [row for row in found(run) if row["goal"] in only]
        ordered = sorted(rows, key=lambda row: NAMES.index(str(row["goal"])))
        yield Table("goals", "Goals", note, ordered)


__all__ = ["NAMES", "Goal", "measure"]
