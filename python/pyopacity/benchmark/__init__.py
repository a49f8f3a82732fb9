"""The project's benchmark: time against error, how costs grow, peers, and whether goals hold.

``plan`` says what is measured, ``run`` what sections share while they measure; each section yields
tables, and ``results`` writes them. The command is ``pyopacity bench``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from pyopacity.benchmark import calls, costs, frames, goals, scaling, time_against_error
from pyopacity.benchmark.peers import table as peers
from pyopacity.benchmark.plan import FULL, QUICK, Plan
from pyopacity.benchmark.results import Results
from pyopacity.benchmark.run import Run
from pyopacity.benchmark.table import Table

_SECTIONS: dict[str, Callable[[Run], Iterator[Table]]] = {
    "goals": goals.measure,
    "errors": time_against_error.measure,
    "frames": frames.measure,
    "scaling": scaling.measure,
    "costs": costs.measure,
    "calls": calls.measure,
    "peers": peers.measure,
}
SECTIONS = (*_SECTIONS, *goals.NAMES)


def measure(run: Run, only: Sequence[str] = ()) -> Iterator[Table]:
    """Tables as they are found; one of a name that was there replaces it.

    Args:
        run: the plan under way.
        only: of :data:`SECTIONS`, or names of goals; none for all sections.
    """
    some = tuple(name for name in goals.NAMES if name in only)
    for name, section in _SECTIONS.items():
        if name == "goals" and some and name not in only:
            yield from goals.measure(run, some)
        elif not only or name in only:
            yield from section(run)


__all__ = ["FULL", "QUICK", "SECTIONS", "Plan", "Results", "Run", "Table", "measure"]
