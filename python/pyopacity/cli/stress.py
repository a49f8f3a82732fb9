"""``pyopacity stress``"""

import argparse
import textwrap
import time
from collections.abc import Iterator, Sequence
from typing import Any

import pyopacity as po
from pyopacity import _arrays, _native
from pyopacity.cli import text
from pyopacity.comparison import available_device
from pyopacity.stress import Bench, Finding, Verdict, chance, chosen, judge
from pyopacity.stress.way import Device

FAILED = 1  # the exit code
_TITLES = ("input", "right answer", "got (worst)", "tolerance", "verdict")
_WIDTHS = (38, 26, 40, 22, 9)


def add_to(commands: Any) -> None:
    """The command's options."""
    summary = "hold every way to make maps on this driver to inputs that break numbers"
    add = text.add_command(commands, "stress", run, summary).add_argument
    add(
        "--only",
        action="append",
        default=[],
        metavar="NAME",
        help="a row or a case of docs/stress.md, or a pattern of them; again for more",
    )
    add(
        "--device",
        default="auto",
        metavar="NAME",
        help="gpu, cpu, or both; auto: both where there is OpenGL, else cpu (default: auto)",
    )
    add(
        "--seed",
        metavar="N",
        help="of everything random (default: 0, with --long the time); random cases count up from "
        "it, so that --long 0 --seed N is the one that was told as N",
    )
    add(
        "--quick",
        action="store_true",
        help="smaller sizes where those of the table take minutes, as in the project's own tests",
    )
    add(
        "--long",
        nargs="?",
        const="1",
        metavar="HOURS",
        help="random scenes, lights and parameters instead, one after the other (default: 1 hour)",
    )


def run(arguments: argparse.Namespace) -> int:
    """Prints each verdict as it comes, then how many hold."""
    cases = chosen(arguments.only)
    hours = None if arguments.long is None else _hours(arguments.long)
    given = arguments.seed or ("0" if hours is None else str(int(time.time())))
    seed = text.whole("--seed", given, 0, 2**32)
    devices = _devices(arguments.device)
    if not arguments.json:
        print(f"pyopacity {po.__version__} on {', '.join(_named(devices))}; seed {seed}\n")
    if hours is not None:
        return _run_long(devices, seed, hours, arguments.json)
    verdicts: list[Verdict] = []
    if not arguments.json:
        _print_row(_TITLES)
    with Bench(devices, seed, not arguments.quick) as bench:
        for number, case in enumerate(cases):

            def tell(finding: Finding, place: str = f"{number + 1} of {len(cases)}: {case.name}"
            ) -> None:  # fmt: skip
                text.progress(f"{place}, {finding.way or 'no technique'}")

            found = judge(case, bench, tell)
            text.clear_progress()
            verdicts += found
            if not arguments.json:
                for verdict in found:
                    _print_row(_cells(verdict))
    return _tell(verdicts, arguments.json)


def _run_long(devices: Sequence[Device], seed: int, hours: float, is_json: bool) -> int:
    """Random cases until the time is over, at least one; those that fail are told as they come."""
    end = time.monotonic() + 3600.0 * hours
    failed: dict[int, list[str]] = {}
    count = 0
    with Bench(devices, seed) as bench:
        while count == 0 or time.monotonic() < end:
            case = chance.draw(seed + count)
            text.progress(f"{count} random cases, {len(failed)} fail; {case}")
            problems = [f"{what}: {problem}" for what, problem in chance.judge(bench, case)]
            count += 1
            if problems:
                failed[case.seed] = problems
                text.clear_progress()
                if not is_json:
                    print(f"{case}; again: pyopacity stress --long 0 --seed {case.seed}")
                    print("".join(f"  {problem}\n" for problem in problems), flush=True)
    text.clear_progress()
    if is_json:
        text.print_json({"seed": seed, "cases": count, "failed": failed})
    else:
        print(f"{count} random cases from seed {seed}, {len(failed)} fail")
    return FAILED if failed else 0


def _hours(given: str) -> float:
    (hours,) = text.numbers("--long", given, (1,), "a number of hours")
    if not 0.0 <= hours < 1e6:
        raise po.ParameterError(f"--long {given} is no number of hours", "write such as .5 or 8")
    return hours


def _devices(given: str) -> tuple[Device, ...]:
    _arrays.choice("--device", given, ("auto", "gpu", "cpu", "both"))
    if given == "auto":
        given = "both" if available_device() == "gpu" else "cpu"
    if given == "both":
        return "gpu", "cpu"
    return ("gpu",) if given == "gpu" else ("cpu",)


def _named(devices: Sequence[Device]) -> Iterator[str]:
    for device in devices:
        if device == "gpu":
            context = _native.Context.headless()
            yield f"{context.renderer} ({context.version})"
        else:
            yield "cpu"


def _tell(verdicts: Sequence[Verdict], is_json: bool) -> int:
    failed = [verdict for verdict in verdicts if verdict.verdict == "FAILS"]
    if is_json:
        text.print_json([_record(verdict) for verdict in verdicts])
    else:
        held = sum(verdict.verdict == "holds" for verdict in verdicts)
        exceptions = len(verdicts) - held - len(failed)
        print(f"{held} hold, {exceptions} named exceptions, {len(failed)} fail")
    return FAILED if failed else 0


def _record(verdict: Verdict) -> dict[str, Any]:
    case, worst = verdict.case, verdict.worst
    return {
        "row": case.row,
        "case": case.name,
        "input": case.input,
        "right": case.right,
        "derivation": case.derivation,
        "error_of": case.of,
        "got": worst.got,
        "error": worst.error if worst.error == worst.error else None,
        "worst_way": str(worst.way) if worst.way else None,
        "ways": verdict.ways,
        "tolerance": case.tolerance,
        "allowed": verdict.allowed,
        "exception": verdict.exception.why if verdict.exception else None,
        "verdict": verdict.verdict,
    }


def _cells(verdict: Verdict) -> tuple[str, ...]:
    case, worst = verdict.case, verdict.worst
    got = f"{worst.error:.3g}: {worst.got}"
    if worst.way is not None:
        got += f" ({worst.way}, of {verdict.ways})"
    allowed = f"{verdict.allowed:g} of {case.of}"
    if verdict.exception is not None:
        allowed += f", not {case.tolerance:g}: {verdict.exception.why}"
    return f"{case.row}: {case.input}", case.right, got, allowed, verdict.verdict


def _print_row(cells: Sequence[str]) -> None:
    """Each cell in a column of its own, on as many lines as the longest takes, and a rule."""
    columns = [textwrap.wrap(cell, width) for cell, width in zip(cells, _WIDTHS, strict=True)]
    for i in range(max(map(len, columns))):
        line = "  ".join(
            (column[i] if i < len(column) else "").ljust(width)
            for column, width in zip(columns, _WIDTHS, strict=True)
        )
        print(line.rstrip())
    print("-" * (sum(_WIDTHS) + 2 * len(_WIDTHS) - 2), flush=True)
