"""``pyopacity stress``"""

import argparse
import textwrap
import time
from collections import Counter
from collections.abc import Sequence
from functools import partial
from typing import Any

import pyopacity as po
from pyopacity import _arrays, _native
from pyopacity.cli import text
from pyopacity.comparison import available_device
from pyopacity.stress import Bench, Case, Finding, Verdict, chance, chosen, judge
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
    hours = _hours(arguments)
    given = arguments.seed or ("0" if hours is None else str(int(time.time())))
    seed = text.whole("--seed", given, 0, 2**32)
    devices = _devices(arguments.device)
    machine = _machine(devices)
    head = {"version": po.__version__, "machine": machine, "seed": seed}
    if not arguments.json:
        print(f"pyopacity {po.__version__} on {_named(machine)}; seed {seed}\n")
    if hours is not None:
        return _run_long(devices, hours, head, arguments.json)
    with Bench(devices, seed, not arguments.quick) as bench:
        verdicts = _judged(cases, bench, arguments.json)
    return _tell(verdicts, head, arguments.json)


def _judged(cases: Sequence[Case], bench: Bench, is_json: bool) -> list[Verdict]:
    verdicts: list[Verdict] = []
    if not is_json:
        _print_row(_TITLES)
    for number, case in enumerate(cases):
        place = f"{number + 1} of {len(cases)}: {case.name}"
        found = judge(case, bench, partial(_tell_progress, place))
        text.clear_progress()
        verdicts += found
        if not is_json:
            for verdict in found:
                _print_row(_cells(verdict))
    return verdicts


def _tell_progress(place: str, finding: Finding) -> None:
    text.progress(f"{place}, {finding.way or 'no technique'}")


def _run_long(devices: Sequence[Device], hours: float, head: dict[str, Any], is_json: bool) -> int:
    """Random cases until the time is over, at least one; those that fail are told as they come.

    However it ends, by Ctrl-C too, it says how many there were.
    """
    end = time.monotonic() + 3600.0 * hours
    seed, count = head["seed"], 0
    failed: dict[int, list[str]] = {}
    refused: Counter[str] = Counter()
    try:
        with Bench(devices, seed) as bench:
            while count == 0 or time.monotonic() < end:
                case = chance.draw(seed + count)
                text.progress(f"{count} random cases, {len(failed)} fail; {case}")
                outcome = chance.judge(bench, case)
                count += 1
                refused.update(outcome.refused)
                if outcome.problems:
                    failed[case.seed] = [f"{what}: {problem}" for what, problem in outcome.problems]
                    text.clear_progress()
                    if not is_json:
                        _print_failed(case, failed[case.seed])
    finally:
        text.clear_progress()
        if is_json:
            more = {"cases": count, "failed": failed, "refused": dict(refused.most_common())}
            text.print_json(head | more)
        else:
            _print_refused(refused, count)
            print(f"{count} random cases from seed {seed}, {len(failed)} fail", flush=True)
    return FAILED if failed else 0


def _print_failed(case: chance.Draw, problems: Sequence[str]) -> None:
    print(f"{case}; again: pyopacity stress --long 0 --seed {case.seed}")
    print("".join(f"  {problem}\n" for problem in problems), flush=True)


def _print_refused(refused: Counter[str], count: int) -> None:
    """Parameters that exclude each other, as techniques say; a wrong refusal would show."""
    if refused:
        print(f"{refused.total()} of {count * chance.TECHNIQUES} draws of parameters are refused:")
    for words, times in refused.most_common():
        print(f"  {times} x {words}")


def _hours(arguments: argparse.Namespace) -> float | None:
    """Of ``--long``, or None without it."""
    if arguments.long is None:
        return None
    for option, given in (("--only", arguments.only), ("--quick", arguments.quick)):
        if given:
            raise po.ParameterError(
                f"{option} is of the suite's cases, and --long draws cases of its own",
                f"leave out {option} or --long",
            )
    (hours,) = text.numbers("--long", arguments.long, (1,), "a number of hours")
    if not 0.0 <= hours < 1e6:
        raise po.ParameterError(
            f"--long {arguments.long} is no number of hours", "write such as .5 or 8"
        )
    return hours


def _devices(given: str) -> tuple[Device, ...]:
    _arrays.choice("--device", given, ("auto", "gpu", "cpu", "both"))
    if given == "auto":
        given = "both" if available_device() == "gpu" else "cpu"
    if given == "both":
        return "gpu", "cpu"
    return ("gpu",) if given == "gpu" else ("cpu",)


def _machine(devices: Sequence[Device]) -> list[dict[str, str]]:
    """Each device; of OpenGL, what it calls itself.

    Raises:
        ContextError: there is none.
    """
    machine = []
    for device in devices:
        facts = {"device": str(device)}
        if device == "gpu":
            context = _native.Context.headless()
            facts |= {"renderer": context.renderer, "version": context.version}
        machine.append(facts)
    return machine


def _named(machine: Sequence[dict[str, str]]) -> str:
    return ", ".join(
        f"{facts['renderer']} ({facts['version']})" if "renderer" in facts else facts["device"]
        for facts in machine
    )


def _tell(verdicts: Sequence[Verdict], head: dict[str, Any], is_json: bool) -> int:
    failed = [verdict for verdict in verdicts if verdict.verdict == "FAILS"]
    if is_json:
        text.print_json(head | {"verdicts": [_record(verdict) for verdict in verdicts]})
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
        "tolerance_derivation": case.why_tolerance,
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
