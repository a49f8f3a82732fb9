"""Time, measured so that it can be compared: things take turns, and figures are medians.

What slows the machine down meanwhile slows all of them, and a ratio of two things of one round
hardly sees it.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from pyopacity.comparison.cost import makes_maps
from pyopacity.renderer import Renderer

Parts = Mapping[str, float]
WHOLE = "whole"


class Turns:
    """What was measured: for each name its parts, a value a round."""

    def __init__(self, rounds: Mapping[str, list[Parts]]) -> None:
        self._rounds = rounds

    @property
    def rounds(self) -> int:
        """Of which figures are medians."""
        return min(len(parts) for parts in self._rounds.values())

    def values(self, name: str, part: str = WHOLE) -> list[float]:
        """Of each round; 0 where that round had no such part."""
        return [parts.get(part, 0.0) for parts in self._rounds[name]]

    def median(self, name: str, part: str = WHOLE) -> float:
        """Of all rounds."""
        return statistics.median(self.values(name, part))

    def summed(self, wanted: Callable[[str], bool]) -> Turns:
        """Of each round the parts of these names alone, as the whole; 0 where there are none."""
        return Turns(
            {
                name: [{WHOLE: sum(t for part, t in one.items() if wanted(part))} for one in rounds]
                for name, rounds in self._rounds.items()
            }
        )

    def parts(self, name: str) -> list[str]:
        """In the order in which they came."""
        return list(dict.fromkeys(part for parts in self._rounds[name] for part in parts))

    def ratio(self, over: str, under: str, part: str = WHOLE, part_under: str = "") -> float:
        """The median of each round's ratio; not a number where there was nothing to divide by."""
        pairs = zip(self.values(over, part), self.values(under, part_under or part), strict=True)
        ratios = [a / b for a, b in pairs if b > 0.0]
        return statistics.median(ratios) if ratios else float("nan")


@dataclass(frozen=True, slots=True)
class Clock:
    """How often things take turns.

    Attributes:
        rounds: as many, if there is time.
        least: as many in any case.
        budget_s: seconds, after which no more than the least begin.
        warm_up: rounds before, that do not count: programs are compiled in them.
    """

    rounds: int = 9
    least: int = 5
    budget_s: float = 100.0
    warm_up: int = 1

    def in_turns(self, works: Mapping[str, Callable[[], Parts]]) -> Turns:
        """Calls each in turn, round after round; each says what its parts took."""
        found: dict[str, list[Parts]] = {name: [] for name in works}
        for _ in range(self.warm_up):
            for work in works.values():
                work()
        start = time.perf_counter()
        for done in range(self.rounds):
            if done >= self.least and time.perf_counter() - start >= self.budget_s:
                break
            for name, work in works.items():
                found[name].append(work())
        return Turns(found)


def seconds_of(work: Callable[[], object]) -> float:
    """On the wall, of one call."""
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def timed(work: Callable[[], object]) -> Callable[[], Parts]:
    """A thing to take turns, as one part."""
    return lambda: {WHOLE: seconds_of(work)}


def all_maps(renderer: Renderer) -> Callable[[], Parts]:
    """Has the maps of all lights made from nothing: seconds of each pass, and of all together.

    The report's times end when the device has finished a pass.
    """

    def make() -> Parts:
        renderer.invalidate()
        passes: dict[str, float] = {}
        for light in range(max(1, len(renderer.scene.lights))):
            renderer.transmittance(np.zeros((1, 3)), light)
            for row in renderer.report:
                if row.status == "ran" and makes_maps(row.name):
                    passes[row.name] = row.ms / 1000.0
        return {**passes, WHOLE: sum(passes.values())}

    return make
