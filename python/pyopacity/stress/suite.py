"""Every case, and whether what was found holds."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from fnmatch import fnmatch
from typing import Literal

from pyopacity.errors import Error, ParameterError
from pyopacity.stress import (
    clouds,
    devices,
    digests,
    footprints,
    formulas,
    opacities,
    order,
    outliers,
    overlaps,
    own,
    places,
    positions,
    relations,
    series,
    skips,
)
from pyopacity.stress.bench import Bench
from pyopacity.stress.case import Case, Finding, words_of
from pyopacity.stress.exceptions import NamedException, exception_of

_FAMILIES = (
    opacities,
    positions,
    overlaps,
    own,
    outliers,
    places,
    formulas,
    series,
    footprints,
    clouds,
    relations,
    order,
    devices,
    digests,
    skips,
)
# In the order of the table of docs/stress.md.
CASES: tuple[Case, ...] = tuple(
    entry for family in _FAMILIES for entry in vars(family).values() if isinstance(entry, Case)
)


@dataclass(frozen=True, slots=True)
class Verdict:
    """What came of a case: of all ways that the tolerance is for, or that one exception is about.

    Attributes:
        case: the case.
        exception: why another size counts, if one does.
        worst: the finding with the largest error.
        ways: how many were asked.
    """

    case: Case
    exception: NamedException | None
    worst: Finding
    ways: int

    @property
    def allowed(self) -> float:
        """The largest error that holds."""
        return self.exception.size if self.exception else self.case.tolerance

    @property
    def verdict(self) -> Literal["holds", "FAILS", "exception"]:
        """Whether it does; NaN does not."""
        if not self.worst.error <= self.allowed:
            return "FAILS"
        return "exception" if self.exception else "holds"


def chosen(only: Iterable[str]) -> list[Case]:
    """The cases whose row or name one of the patterns is, or all without any.

    Raises:
        ParameterError: a pattern that no row and no name fits.
    """
    patterns = list(only)
    for pattern in patterns:
        if not any(_fits(case, pattern) for case in CASES):
            rows = ", ".join(dict.fromkeys(case.row for case in CASES))
            raise ParameterError(f'no row or case is called "{pattern}"', f"there are {rows}")
    return [case for case in CASES if not patterns or any(_fits(case, p) for p in patterns)]


def judge(
    case: Case, bench: Bench, tell: Callable[[Finding], object] = lambda _: None
) -> list[Verdict]:
    """Asks every way of a case. An error that is none of its answers fails it, by the way asked."""
    groups: dict[NamedException | None, list[Finding]] = {}
    try:
        for finding in case.find(bench):
            tell(finding)
            exception = exception_of(case.name, str(finding.way)) if finding.way else None
            groups.setdefault(exception, []).append(finding)
    except (Error, MemoryError) as error:
        found = Finding(bench.asked, float("nan"), words_of(error))
        groups.setdefault(None, []).append(found)
    finally:
        bench.clear()
    return [
        Verdict(case, exception, max(found, key=_badness), len({str(f.way) for f in found}))
        for exception, found in groups.items()
    ]


def run(cases: Iterable[Case], bench: Bench) -> Iterator[Verdict]:
    """Judges one case after the other."""
    for case in cases:
        yield from judge(case, bench)


def _fits(case: Case, pattern: str) -> bool:
    return any(fnmatch(name.lower(), pattern.lower()) for name in (case.row, case.name))


def _badness(finding: Finding) -> float:
    return finding.error if finding.error == finding.error else float("inf")
