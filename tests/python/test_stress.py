"""The stress suite, small: what ``pyopacity stress`` asks, and what its verdicts mean."""

import math
import pathlib
import re
from collections.abc import Iterator
from fnmatch import fnmatch
from typing import Any

import numpy as np
import pytest

import pyopacity as po
from pyopacity.comparison import available_device
from pyopacity.stress import (
    CASES,
    EXCEPTIONS,
    Bench,
    Case,
    Finding,
    NamedException,
    Verdict,
    Way,
    chosen,
    exceptions,
    judge,
    own,
    series,
)
from pyopacity.stress.case import table
from pyopacity.stress.exceptions import exception_of
from pyopacity.stress.shapes import down
from pyopacity.stress.way import ALL, parameters_of, ways

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/stress.md"
# Of the definitions: the tolerances of each row of what must hold; it has a case, or several. The
# last two rows ask for one without naming a size.
ROWS: dict[str, set[float]] = {
    "opacity edge": {1e-6, 1.0},  # the second in steps of fixed point
    "opacity bad": {0.0},
    "positions bad": {0.0},
    "accumulate": {2e-4, 1e-3, 2e-2},
    "thin object": {1e-6},
    "boundary": {0.0},
    "self": {1e-6},
    "outlier": {1.1},
    "near/far 1e6": {1e-3},
    "offset": {1e-4},
    "light": {1e-3, 0.0},
    "empty": {0.0},
    "all opaque": {0.0},
    "one layer": {0.0},
    "one fragment": {0.0},
    "split curve": {1e-6},
    "correlation": {1e-6},
    "FOM": {1e-4, 0.0},
    "silhouette": {1e-3},
    "Beer-Lambert": {0.005},
    "metamorphic": {1e-5, 1e-4, 1e-2},
    "monotone": {0.0},
    "determinism": {0.0},
    "skip": {0.0},
    "oracle": set(),
    "devices": set(),
}


def marked(case: Case) -> Any:
    return pytest.param(case, id=case.name, marks=[pytest.mark.slow] * case.is_slow)


MARKED = [marked(case) for case in CASES]

# All techniques on the CPU; with OpenGL those that a change of shaders shows first. These are
# compiled for each scene anew, which takes minutes in software. The command asks all of them.
ON_GPU = ("bounding_opacity_maps", "exact")


@pytest.fixture(scope="module")
def devices() -> tuple[Any, ...]:
    return ("gpu", "cpu") if available_device() == "gpu" else ("cpu",)


@pytest.mark.parametrize("case", MARKED)
def test_holds(case: Case, devices: tuple[Any, ...]) -> None:
    with Bench(devices, on_gpu=ON_GPU) as bench:
        verdicts = judge(case, bench)
    for verdict in verdicts:
        worst = verdict.worst
        assert verdict.verdict != "FAILS", f"{worst.way}: {worst.error:.3g}, {worst.got}"


@pytest.mark.parametrize("case", MARKED)
def test_says_what_is_right_and_why(case: Case) -> None:
    assert case.input and case.right and case.of and case.tolerance >= 0.0
    assert len(case.derivation) > 40


def test_every_row_has_cases() -> None:
    assert {case.row for case in CASES} == set(ROWS)
    assert len({case.name for case in CASES}) == len(CASES)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_a_tolerance_is_that_of_the_row_or_derived(case: Case) -> None:
    is_derived = len(case.why_tolerance) > 20
    assert is_derived or case.tolerance in ROWS[case.row]
    assert is_derived or not re.search(r"mean$|%", case.of), "less is asked than of every T"


def test_docs_list_the_tolerances() -> None:
    assert table(CASES) in PAGE.read_text("utf-8")


# ---- exceptions ----


Used = dict[tuple[NamedException, str], float]


def used_by(named: list[NamedException], bench: Bench) -> Used:
    """The largest error by an exception and one of its patterns of ways."""
    found: Used = {}
    for case in (case for case in CASES if any(one.case == case.name for one in named)):

        def tell(finding: Finding, case: Case = case) -> None:
            for one in named:
                if one.is_about(case.name, str(finding.way)):
                    own = str(finding.way).partition(" ")[2]
                    for key in ((one, p) for p in one.ways if fnmatch(own, p)):
                        found[key] = max(found.get(key, 0.0), finding.error)

        judge(case, bench, tell)
    return found


def assert_needed(named: list[NamedException], found: Used) -> None:
    """Each pattern is beyond the case's tolerance; the worst has at least half of the size."""
    assert named
    for one in named:
        tolerance = next(case.tolerance for case in CASES if case.name == one.case)
        errors = {pattern: found.get((one, pattern)) for pattern in one.ways}
        assert all(error is not None and error > tolerance for error in errors.values()), (
            f"{one.case} {errors}: no way is asked, or it needs no exception from {tolerance}"
        )
        worst = max(error for error in errors.values() if error is not None)
        assert one.size / 2 <= worst <= one.size, f"{one.case} {errors}: {one.size} is told"


def quick_exceptions(on_gpu: bool) -> list[NamedException]:
    """Those of the GPU alone, or all others, of cases that are not slow."""
    slow = {case.name for case in CASES if case.is_slow}
    is_wanted = [(one.only_on == "gpu") == on_gpu and one.case not in slow for one in EXCEPTIONS]
    return [one for one, wanted in zip(EXCEPTIONS, is_wanted, strict=True) if wanted]


def test_every_exception_is_needed() -> None:
    """One that no way has any more is taken out, and one that has shrunk is told anew."""
    named = quick_exceptions(on_gpu=False)
    with Bench(["cpu"]) as bench:
        assert_needed(named, used_by(named, bench))


@pytest.mark.gl
@pytest.mark.slow
def test_every_exception_of_a_gpu_is_needed() -> None:
    named = quick_exceptions(on_gpu=True)
    with Bench(["gpu", "cpu"], on_gpu=("bounding_opacity_maps", "moment_opacity_maps")) as bench:
        assert_needed(named, used_by(named, bench))


def test_an_exception_that_is_not_needed_is_told() -> None:
    one, bounding = quick_exceptions(on_gpu=False)[0], "bounding_opacity_maps"
    too_large = NamedException(one.case, one.ways, 2.5, one.why)
    no_way = NamedException(one.case, ("no_such_technique*",), 1.0, one.why)
    not_needed = NamedException(one.case, (bounding,), 1.0, one.why)
    named = [one, too_large, no_way, not_needed]
    with Bench(["cpu"]) as bench:
        found = used_by(named, bench)
    assert_needed([one], found)
    for wrong, words in ((too_large, "is told"), (no_way, "no way"), (not_needed, "no way")):
        with pytest.raises(AssertionError, match=words):
            assert_needed([wrong], found)


def test_slices_shadow_the_first_point_of_short_segments_alone() -> None:
    """Why ``first_fragment`` is an exception of opacity shadow maps: docs/stress.md."""
    way, lost = Way("cpu", "opacity_shadow_maps"), {}
    with Bench(["cpu"]) as bench:
        for points in (2, own.POINTS):
            random = np.random.default_rng(1)
            strands = own.isolated(2.3, 0.0625, own.ACROSS, random, points)
            T = bench.T(way, po.Scene(strands, down()), strands, own.SIZE, layers=4, bias="auto")
            lost[points] = 1.0 - T[own.nearest_to_light(strands)].min()
    assert lost[2] < 1e-5 and lost[own.POINTS] > 1e-2


def test_docs_list_the_exceptions() -> None:
    assert exceptions.table() in PAGE.read_text("utf-8")


def test_an_exception_is_about_its_own_ways() -> None:
    for exception in EXCEPTIONS:
        assert any(case.name == exception.case for case in CASES), exception
        assert exception.size > next(c.tolerance for c in CASES if c.name == exception.case)
    assert exception_of("no such case", f"cpu {ALL[0]}") is None


# ---- right answers ----


@pytest.mark.parametrize("basis", series.BASES)
def test_integrals_of_a_basis_are_sums_of_its_functions(basis: str) -> None:
    """By the midpoint rule between the places where steps jump: 15 x 400 steps from 0 to 1."""
    steps = 6000
    middles, ends = (np.arange(steps) + 0.5) / steps, np.arange(1, steps + 1) / steps
    sums = np.cumsum(series.functions(basis, 15, middles), axis=1) / steps
    assert np.abs(series.integrals(basis, 15, ends) - sums).max() < 1e-6


# ---- verdicts ----


def of(*errors: float, tolerance: float = 0.5) -> list[Verdict]:
    def find(bench: Bench) -> Iterator[Finding]:
        """Errors that are given, to see what becomes of them."""
        yield from (Finding(Way("cpu", ALL[0]), error, "") for error in errors)

    case = Case("row", "name", "in", "right", tolerance, "T", find)
    with Bench(["cpu"]) as bench:
        return judge(case, bench)


@pytest.mark.parametrize(
    ("errors", "verdict"),
    [
        ((0.1, 0.5), "holds"),
        ((0.1, 0.51), "FAILS"),
        ((0.1, math.nan), "FAILS"),
        ((math.nan, 0.1), "FAILS"),
        ((math.inf,), "FAILS"),
    ],
)
def test_the_worst_answer_decides(errors: tuple[float, ...], verdict: str) -> None:
    (found,) = of(*errors)
    assert found.verdict == verdict


def test_an_error_of_the_engine_fails_the_case_and_names_the_way() -> None:
    way = Way("cpu", ALL[0])

    def find(bench: Bench) -> Iterator[Finding]:
        """It breaks."""
        bench.T(way, po.Scene(), np.zeros((1, 3)))
        raise po.ShaderError("it broke", "mend it")
        yield

    case = Case("row", "name", "in", "right", 1.0, "T", find)
    with Bench(["cpu"]) as bench:
        (verdict,) = judge(case, bench)
    assert verdict.verdict == "FAILS" and "it broke" in verdict.worst.got
    assert verdict.worst.way == way and bench.asked is None


def test_names_choose_rows_and_cases() -> None:
    assert chosen([]) == list(CASES)
    assert {case.row for case in chosen(["OPACITY*"])} == {"opacity edge", "opacity bad"}
    assert [case.name for case in chosen(["thin_surface"])] == ["thin_surface"]
    with pytest.raises(po.ParameterError, match="no row or case"):
        chosen(["opcaity"])


def test_every_way_to_deposit_is_asked() -> None:
    on_gpu, on_cpu = (ways([device], ALL, papers=True) for device in ("gpu", "cpu"))
    for name in ALL:
        if "deposit" in parameters_of(name):
            given = {way.given("deposit") for way in on_gpu if way.technique == name}
            assert given >= {"blend", "scatter"}
    assert {way.technique for way in on_cpu} == set(ALL)
