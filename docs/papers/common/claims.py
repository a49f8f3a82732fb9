"""What a figure shows, and whether it shows here: verdicts come from measured numbers alone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise

import numpy as np


@dataclass(frozen=True)
class Claim:
    """One thing that a figure or table shows.

    Attributes:
        what: it is, in a few words.
        paper: its value there.
        ours: what was measured.
        holds: whether ours says the same.
        why: it does not, told by someone who has looked; shown only where it does not hold.
        note: what else to know, whether it holds or not.
    """

    what: str
    paper: str
    ours: str
    holds: bool
    why: str = ""
    note: str = ""

    @property
    def verdict(self) -> str:
        known = self.why or "why is not known"
        told = ["holds" if self.holds else f"does not hold: {known}", self.note]
        return "; ".join(part for part in told if part)


def rises(values: Sequence[float], slack: float = 0.0) -> bool:
    """Whether each value is above the one before.

    Args:
        values: two or more.
        slack: the part of a value by which the next may fall short of it, for what is timed.
    """
    return all(after > before - slack * abs(before) for before, after in pairwise(values))


def in_same_order(
    paper: Mapping[str, float], ours: Mapping[str, float], slack: float = 0.0
) -> bool:
    """Whether what is more in the paper is more here, for each two of its values that differ.

    Args:
        paper: value by name.
        ours: the same names.
        slack: the part by which two of ours may be the wrong way round, for what is timed.
    """
    for a, b in combinations(paper, 2):
        if paper[a] == paper[b]:
            continue
        low, high = (a, b) if paper[a] < paper[b] else (b, a)
        if ours[low] > ours[high] * (1.0 + slack):
            return False
    return True


def line_fit(x: Sequence[float], y: Sequence[float]) -> tuple[float, float, float]:
    """Slope and value at 0 of the line of least squares, and r^2: how much of y it tells."""
    across, upward = np.asarray(x, np.float64), np.asarray(y, np.float64)
    slope, start = np.polyfit(across, upward, 1)
    rest = upward - (slope * across + start)
    spread = float(np.sum((upward - upward.mean()) ** 2))
    return float(slope), float(start), 1.0 - float(np.sum(rest**2)) / spread if spread else 1.0
