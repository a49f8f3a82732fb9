"""A goal of the project, and what was measured of it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from pyopacity.benchmark.table import Row


def quotient(over: float, under: float) -> float:
    """Not a number where there is nothing to divide by."""
    return over / under if under > 0.0 else math.nan


@dataclass(frozen=True, slots=True)
class Goal:
    """A ratio that is to be reached.

    Attributes:
        name: "P1".
        what: is divided by what.
        most: that the ratio may be.
    """

    name: str
    what: str
    most: float

    def measured(self, ratio: float, where: str, rounds: int = 1, note: str = "") -> Row:
        """A row: what was found, on which scene and maps, and how often.

        A ratio that is not a number, as :func:`quotient` has it, makes one that was not measured.
        """
        if math.isnan(ratio):
            why = "there is nothing to divide by"
            return self.not_measured(where, f"{why}: {note}" if note else why)
        return self._row(ratio, ratio <= self.most, where, rounds, note)

    def not_measured(self, where: str, why: str) -> Row:
        """A row that says what is missing."""
        return self._row(None, None, where, None, f"not measured: {why}")

    def _row(
        self, ratio: float | None, holds: bool | None, where: str, rounds: int | None, note: str
    ) -> Row:
        return {
            "goal": self.name,
            "ratio": self.what,
            "at most": self.most,
            "measured": ratio,
            "holds": holds,
            "where": where,
            "rounds": rounds,
            "note": note,
        }
