"""A case of the stress suite: an input, its right answer, and how far off an answer may be."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from pyopacity.stress.bench import Bench
from pyopacity.stress.way import Way

F64 = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Finding:
    """How far off one way's answer was.

    Attributes:
        way: how it was asked for; None where no technique has a part in it.
        error: in the case's own measure; NaN fails.
        got: the worst answer, for people.
    """

    way: Way | None
    error: float
    got: str


Find = Callable[[Bench], Iterator[Finding]]


@dataclass(frozen=True, slots=True)
class Case:
    """An input with a right answer.

    Attributes:
        row: the row of docs/stress.md that it belongs to.
        name: of the function that finds it; unique.
        input, right: for people.
        tolerance: the largest error that holds, in the unit ``of``.
        of: what the error is: "T", "wrong answers", ..
        find: asks every way that the case runs on.
        is_slow: takes more than some seconds on two cores.
        why_tolerance: its derivation, where it is another than that of the row, or which of the
            row's right answers it is about; else empty.
    """

    row: str
    name: str
    input: str
    right: str
    tolerance: float
    of: str
    find: Find
    is_slow: bool = False
    why_tolerance: str = ""

    @property
    def derivation(self) -> str:
        """Why the right answer is right."""
        return inspect.getdoc(self.find) or ""


def case(
    row: str,
    input: str,
    right: str,
    tolerance: float,
    of: str = "T",
    is_slow: bool = False,
    why_tolerance: str = "",
) -> Callable[[Find], Case]:
    """Makes a case of the function that finds its answers; its docstring derives the right one."""

    def make(find: Find) -> Case:
        name = find.__name__
        return Case(row, name, input, right, tolerance, of, find, is_slow, why_tolerance)

    return make


def table(cases: Iterable[Case]) -> str:
    """What docs/stress.md lists: a row for each."""
    rows = (
        f"| {one.row} | `{one.name}` | {one.tolerance:.3g} | {one.of} | {one.why_tolerance} |"
        for one in cases
    )
    head = ["| row | case | tolerance | of | derivation |", "|---|---|---|---|---|"]
    return "\n".join([*head, *rows]) + "\n"


def apart(way: Way | None, got: npt.ArrayLike, right: npt.ArrayLike) -> Finding:
    """The largest absolute difference, and the answer that has it."""
    answers, truth = np.broadcast_arrays(np.asarray(got, np.float64), np.asarray(right, np.float64))
    if not answers.size:
        return Finding(way, 0.0, "none asked")
    errors = np.abs(answers - truth).ravel()
    at = int(np.argmax(np.where(np.isnan(errors), math.inf, errors)))
    return Finding(way, float(errors[at]), f"{answers.ravel()[at]:.9g}, {truth.ravel()[at]:.9g}")


def relative(way: Way | None, got: npt.ArrayLike, right: npt.ArrayLike) -> Finding:
    """The largest difference relative to the right answer, where that is not 0."""
    answers, truth = np.asarray(got, np.float64), np.asarray(right, np.float64)
    scale = np.where(truth == 0.0, 1.0, truth)
    found = apart(way, answers / scale, truth / scale)
    return Finding(way, found.error, found.got)


def wrong(way: Way | None, problems: list[str]) -> Finding:
    """As many errors as there are problems."""
    return Finding(way, float(len(problems)), problems[0] if problems else "as it should be")


def words_of(error: Exception) -> str:
    """An error in one line."""
    return " ".join(str(error).split()) or type(error).__name__


def refusal(call: Callable[[], Any], words: str, error: type[Exception]) -> list[str]:
    """Nothing, if the call raises this error and names those words; else what it did instead."""
    try:
        call()
    except error as raised:
        return [] if words in str(raised) else [f'no "{words}" in: {raised}']
    except Exception as raised:  # whatever it is, it is the wrong one, and told
        return [f"{type(raised).__name__}: {raised}"]
    return [f"{words} is taken"]
