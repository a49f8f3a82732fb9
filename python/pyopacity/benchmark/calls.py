"""What a call from Python costs beside the same frame in C++.

Two programmes in call_overhead/ do the same, one built against the installed package, one in
Python: T at points, T at a shape and a picture, each into an array that is there; unchanged, then
everything anew. Each turn is a process of its own in both: one that has freed large blocks before,
as a long benchmark has, keeps its pages and is up to a fifth faster, in either language.
"""

from __future__ import annotations

import pathlib
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator

from pyopacity._cmake import cmake_dir
from pyopacity.benchmark.clock import Parts, Turns
from pyopacity.benchmark.run import Run, hair_of
from pyopacity.benchmark.table import Row, Table
from pyopacity.errors import Error

ANEW = ("shape_anew", "picture_anew")
CPP, PYTHON = "C++", "Python"
_MODULE = "pyopacity.benchmark.call_overhead"
_SOURCE = pathlib.Path(__file__).parent / "call_overhead"
_NOTE = """The same frames from C++ and from Python, in turns, each turn a fresh process that loads
the scene, warms up and times frames into an array that is there; medians of each turn's median,
microseconds. points: T at so many points. shape: T at the strands' own. picture: 64 x 64 pixels.
These are unchanged, what was asked before; anew: with every pass."""


def measure(run: Run) -> Iterator[Table]:
    """A row for each kind of frame; or the reason why there are none."""
    scene = hair_of(run.plan.goals.call_segments)
    rows: list[Row]
    if (why := missing(run)) is not None:
        rows = [{"scene": scene, "note": f"not measured: {why}"}]
    else:
        turns = run.once(turns_of)
        rows = [
            {
                "scene": scene,
                "frame": frame,
                "C++, us": turns.median(CPP, frame),
                "Python, us": turns.median(PYTHON, frame),
                "ratio": ratio(turns, frame),
                "rounds": turns.rounds,
            }
            for frame in turns.parts(PYTHON)
        ]
    yield Table("calls", "Calls from Python", _NOTE, rows)


def ratio(turns: Turns, frame: str) -> float:
    """Python over C++."""
    return turns.ratio(PYTHON, CPP, frame)


def missing(run: Run) -> str | None:
    """What the programme needs that is not there, and how to get it; None where nothing is."""
    if run.plan.goals.call_repeats == 0:
        return "the plan has no calls"
    if not (cmake_dir() / "opacityConfig.cmake").exists():
        return "the package is not installed: make setup"
    tools = [tool for tool in ("cmake", "c++") if shutil.which(tool) is None]
    return f"install {' and '.join(tools)}" if tools else None


def turns_of(run: Run) -> Turns:
    """Microseconds of each frame, in either language."""
    run.tell("calls from Python and in C++")
    goals = run.plan.goals
    sizes = run.plan.device, str(goals.call_segments), str(goals.call_repeats)
    with tempfile.TemporaryDirectory() as folder:
        program = _built(folder)
        return run.plan.clock.in_turns(
            {
                PYTHON: lambda: _times(sys.executable, "-m", _MODULE, *sizes),
                CPP: lambda: _times(program, *sizes),
            }
        )


def _built(folder: str) -> str:
    configure = ["cmake", "-S", str(_SOURCE), "-B", folder, f"-Dopacity_DIR={cmake_dir()}"]
    for command in ([*configure, "-DCMAKE_BUILD_TYPE=Release"], ["cmake", "--build", folder]):
        _output(*command)
    return str(pathlib.Path(folder) / _SOURCE.name)


def _times(*command: str) -> Parts:
    """What a programme printed: a frame and its microseconds a line."""
    lines = _output(*command).splitlines()
    return {frame: float(us) for frame, us in (line.split() for line in lines)}


def _output(*command: str) -> str:
    """What a command printed.

    Raises:
        Error: it failed; with the last that it said.
    """
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        said = done.stderr.strip().splitlines() or [f"it ended with {done.returncode}"]
        raise Error(
            f"calls cannot be measured: {pathlib.Path(command[0]).name}: {said[-1].strip()}",
            "see that the device and a C++20 compiler are there, or leave this out: --only",
        )
    return done.stdout
