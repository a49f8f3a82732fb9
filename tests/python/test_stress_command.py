"""Random cases, and ``pyopacity stress``: what it prints, and how it ends."""

import json
import re
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import pyopacity as po
from pyopacity import _native
from pyopacity.cli import main
from pyopacity.cli import stress as command
from pyopacity.stress import Bench, Case, Finding, Way, chance

# ---- random cases ----


@settings(
    max_examples=6,
    derandomize=True,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(seed=st.integers(0, 2**31 - 1))
def test_chance_breaks_nothing(seed: int) -> None:
    with Bench(["cpu"]) as bench:
        assert chance.judge(bench, chance.draw(seed)).problems == []


@pytest.mark.gl
def test_chance_breaks_nothing_on_a_driver() -> None:
    with Bench(["gpu", "cpu"]) as bench:
        assert chance.judge(bench, chance.draw(0)).problems == []


def test_a_seed_draws_the_same_again() -> None:
    first, second = (chance.draw(11) for _ in range(2))
    assert str(first) == str(second) and first.techniques == second.techniques
    assert np.array_equal(first.asked, second.asked)


BREAKS = (
    po.ShaderError("it broke", "mend it"),
    po.OutOfMemoryError("no room", "less"),
    MemoryError(),
)


@pytest.mark.parametrize("error", BREAKS, ids=lambda error: type(error).__name__)
def test_an_error_of_the_engine_is_a_problem_of_its_seed(
    error: Exception, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def breaks(bench: Bench, of: chance.Draw, way: Way) -> list[str]:
        bench.T(way, po.Scene(), of.asked)
        raise error

    monkeypatch.setattr(chance, "CHECKS", (breaks,))
    assert main(["stress", "--long", "0", "--seed", "5", "--device", "cpu", "--json"]) == 1
    document = json.loads(capsys.readouterr().out)
    assert document["cases"] == 1 and document["seed"] == 5
    assert len(document["failed"]["5"]) == chance.TECHNIQUES
    told = str(error).split("\n")[0] or type(error).__name__
    assert all(line.startswith("cpu ") and told in line for line in document["failed"]["5"])


def test_refused_parameters_are_counted(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def refuses(bench: Bench, of: chance.Draw, way: Way) -> list[str]:
        raise po.ParameterError("they exclude each other", "choose one")

    monkeypatch.setattr(chance, "CHECKS", (refuses,))
    assert main(["stress", "--long", "0", "--seed", "5", "--device", "cpu"]) == 0
    told = capsys.readouterr().out
    assert "3 of 3 draws of parameters are refused" in told
    assert len(re.findall("1 x [a-z_]+: they exclude each other", told)) == 3


# ---- the command ----


def test_the_command_tells_each_verdict(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["stress", "--only", "split*", "--only", "thin_*", "--device", "cpu"]) == 0
    told = capsys.readouterr().out
    assert re.search(r"^\d+ hold, \d+ named exceptions, 0 fail$", told, re.MULTILINE)
    assert "right answer" in told and "z0 = z1" in told
    assert main(["stress", "--only", "thin_surface", "--device", "cpu", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    (record,) = document["verdicts"]
    assert document["version"] == po.__version__ and document["seed"] == 0
    assert document["machine"] == [{"device": "cpu"}]
    assert record["verdict"] == "holds" and record["error"] <= record["tolerance"] == 1e-6


def test_a_failure_is_the_exit_code(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def find(bench: Bench) -> Iterator[Finding]:
        """A wrong answer."""
        yield Finding(None, 2.0, "2")

    wrong = Case("row", "name", "in", "right", 1.0, "T", find)
    monkeypatch.setattr(command, "chosen", lambda only: [wrong])
    assert main(["stress", "--device", "cpu"]) == command.FAILED == 1
    assert "FAILS" in capsys.readouterr().out


@pytest.mark.parametrize(
    "bad",
    [
        ("--only", "nothing"),
        ("--device", "tpu"),
        ("--seed", "-1"),
        ("--long", "-1"),
        ("--long", "0", "--only", "self"),
        ("--long", "0", "--quick"),
    ],
)
def test_bad_options_are_refused(bad: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["stress", *bad]) == 2
    assert "fix:" in capsys.readouterr().err


def test_a_random_case_is_told_with_its_seed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["stress", "--long", "0", "--seed", "3", "--device", "cpu"]) == 0
    assert "1 random cases from seed 3, 0 fail" in capsys.readouterr().out


def test_an_interruption_tells_how_far_it_came(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    answers = iter([chance.Outcome([("cpu exact", "off")], []), KeyboardInterrupt()])

    def judged(bench: Bench, of: chance.Draw) -> chance.Outcome:
        answer = next(answers)
        if isinstance(answer, KeyboardInterrupt):
            raise answer
        return answer

    monkeypatch.setattr(chance, "judge", judged)
    assert main(["stress", "--long", "1", "--seed", "7", "--device", "cpu"]) == 130
    told = capsys.readouterr().out
    assert "pyopacity stress --long 0 --seed 7" in told and "cpu exact: off" in told
    assert told.endswith("1 random cases from seed 7, 1 fail\n")


@pytest.mark.parametrize("more", [(), ("--json",), ("--long", "0"), ("--long", "0", "--json")])
def test_a_gpu_that_is_not_there_has_the_exit_code_of_all_commands(
    more: tuple[str, ...], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    class NoContext:
        @staticmethod
        def headless() -> None:
            raise po.ContextError("no OpenGL", "install a driver")

    monkeypatch.setattr(_native, "Context", NoContext)
    only = [] if "--long" in more else ["--only", "thin_surface"]
    assert main(["stress", "--device", "gpu", *only, *more]) == 3
    out, err = capsys.readouterr()
    assert out == "" and err == "pyopacity: no OpenGL; fix: install a driver\n"


# Without casters a map is a single part of work, which needs no threads.
THREADS = """
import numpy as np, pyopacity as po
strands = po.Strands(np.eye(3), np.array([0, 3]), width=0.5)
po.transmittance(po.Scene(strands, po.DirectionalLight()), strands)
"""


def test_a_number_of_threads_that_is_none_is_told(python: Callable[..., Any]) -> None:
    for wrong in ("0", "-1", "two", "1.5", "2000"):
        result = python("-c", THREADS, OPACITY_THREADS=wrong)
        assert f"ParameterError: OPACITY_THREADS={wrong} is no number of threads" in result.stderr
    assert python("-c", THREADS, OPACITY_THREADS="3").returncode == 0
