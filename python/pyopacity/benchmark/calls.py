"""What a call from Python costs beside the same frame in C++.

The programme in call_overhead/ is built against the installed package, and does what this module
does: T at points, T at a shape and a picture, each into an array that is there; unchanged, then
everything anew.
"""

from __future__ import annotations

import pathlib
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator

import numpy as np

from pyopacity._cmake import cmake_dir
from pyopacity.benchmark.clock import WHOLE, Parts, Turns, seconds_of
from pyopacity.benchmark.run import Run, hair_of, strands_of
from pyopacity.benchmark.table import Row, Table
from pyopacity.errors import Error
from pyopacity.renderer import Renderer

ANEW = ("shape_anew", "picture_anew")
_CPP, _PYTHON = "C++", "Python"
_TURNS = 5
_SIDE = 64  # of the picture, pixels
_WARM_UP = 2
_SOURCE = pathlib.Path(__file__).parent / "call_overhead"
_NOTE = """The same frames from C++ and from Python, in turns; medians of each turn's median,
microseconds. Unchanged: what was asked before; anew: with every pass."""


def measure(run: Run) -> Iterator[Table]:
    """A row for each kind of frame; none where the programme cannot be built."""
    if missing(run) is None:
        turns = run.once(turns_of)
        rows: list[Row] = [
            {
                "scene": hair_of(run.plan.goals.call_segments),
                "frame": frame,
                "C++, us": turns.median(_CPP, frame),
                "Python, us": turns.median(_PYTHON, frame),
                "ratio": ratio(turns, frame),
                "rounds": turns.rounds,
            }
            for frame in turns.parts(_PYTHON)
        ]
        yield Table("calls", "Calls from Python", _NOTE, rows)


def ratio(turns: Turns, frame: str) -> float:
    """Python over C++."""
    return turns.ratio(_PYTHON, _CPP, frame)


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
    with tempfile.TemporaryDirectory() as folder:
        program = _built(folder)
        rounds: dict[str, list[Parts]] = {_PYTHON: [], _CPP: []}
        for _ in range(_TURNS):
            rounds[_PYTHON].append(_in_python(run))
            rounds[_CPP].append(_in_cpp(run, program))
    return Turns(rounds)


def _built(folder: str) -> pathlib.Path:
    configure = ["cmake", "-S", str(_SOURCE), "-B", folder, f"-Dopacity_DIR={cmake_dir()}"]
    for command in ([*configure, "-DCMAKE_BUILD_TYPE=Release"], ["cmake", "--build", folder]):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise Error(
                f"{_SOURCE.name} cannot be built: {done.stderr.strip()[-400:]}",
                "see that a C++20 compiler is there, or leave this out: --only",
            )
    return pathlib.Path(folder) / "call_overhead"


def _in_cpp(run: Run, program: pathlib.Path) -> Parts:
    goals = run.plan.goals
    command = [program, run.plan.device, str(goals.call_segments), str(goals.call_repeats)]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split("\n")
    return {name: float(us) for name, us in (line.split() for line in lines if line)}


def _in_python(run: Run) -> Parts:
    goals, device = run.plan.goals, run.plan.device
    scene = run.hair(goals.call_segments)
    hair, repeats = strands_of(scene), goals.call_repeats
    points = np.asarray(hair.points, np.float32)
    t, image = np.empty(len(points), np.float32), np.empty((_SIDE, _SIDE, 4), np.float32)
    few = max(repeats // 30, 9)
    with Renderer(scene, size=(_SIDE, _SIDE), device=device) as renderer:

        def anew(work: Callable[[], object]) -> Callable[[], object]:
            def forget_and_work() -> None:
                renderer.invalidate()
                work()

            return forget_and_work

        def ask() -> object:
            return renderer.transmittance(hair, out=t)

        times = {
            "points": _median_us(repeats, lambda: renderer.transmittance(points, out=t)),
            "shape": _median_us(repeats, ask),
            "shape_anew": _median_us(few, anew(ask)),
        }
        if device == "gpu":
            times["picture"] = _median_us(repeats, lambda: renderer.render(out=image))
            times["picture_anew"] = _median_us(few, anew(lambda: renderer.render(out=image)))
    return times


def _median_us(repeats: int, work: Callable[[], object]) -> float:
    for _ in range(_WARM_UP):
        work()
    turns = Turns({"": [{WHOLE: 1e6 * seconds_of(work)} for _ in range(repeats)]})
    return turns.median("")
