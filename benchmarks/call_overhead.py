"""What a call from Python costs beside the same frame in C++, and what an unchanged frame costs.

    python benchmarks/call_overhead.py [--device gpu] [--segments 10000] [--repeats 300] > table.md

Builds call_overhead/main.cpp against the installed package, and does the same here: T at points, T
at a shape and a picture of 64 x 64, each into an array that is there; unchanged, then everything
anew. Both take turns; figures are medians of the turns' medians. The goal is 1.02 anew.
"""

from __future__ import annotations

import argparse
import collections
import pathlib
import statistics
import subprocess
import tempfile
import time
from collections.abc import Callable

import numpy as np

import pyopacity as po
from pyopacity.cli.main import cmake_dir

LIGHT = po.DirectionalLight((0.5, 0.3, -0.8))
TURNS = 5
Times = dict[str, float]


def built(folder: str) -> pathlib.Path:
    source = pathlib.Path(__file__).parent / "call_overhead"
    configure = ["cmake", "-S", source, "-B", folder, f"-Dopacity_DIR={cmake_dir()}"]
    for command in ([*configure, "-DCMAKE_BUILD_TYPE=Release"], ["cmake", "--build", folder]):
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return pathlib.Path(folder) / "call_overhead"


def in_cpp(program: pathlib.Path, device: str, segments: int, repeats: int) -> Times:
    command = [program, device, str(segments), str(repeats)]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split("\n")
    return {name: float(us) for name, us in (line.split() for line in lines if line)}


def median_us(repeats: int, work: Callable[[], object]) -> float:
    times = []
    for _ in range(repeats + 2):  # the first two warm up
        begin = time.perf_counter()
        work()
        times.append(1e6 * (time.perf_counter() - begin))
    return statistics.median(times[2:])


def in_python(device: str, segments: int, repeats: int) -> Times:
    scene = po.Scene(po.load(f"demo:hair?segments={segments}"), LIGHT)
    hair = scene.shapes[0]
    points = np.asarray(hair.points)
    t, image = np.empty(len(points), np.float32), np.empty((64, 64, 4), np.float32)
    few = max(repeats // 30, 9)
    with po.Renderer(scene, size=(64, 64), device=device) as renderer:  # type: ignore[arg-type]

        def anew(work: Callable[[], object]) -> Callable[[], object]:
            return lambda: (renderer.invalidate(), work())

        def ask_shape() -> object:
            return renderer.transmittance(hair, out=t)

        def draw() -> object:
            return renderer.render(out=image)

        times = {
            "points": median_us(repeats, lambda: renderer.transmittance(points, out=t)),
            "shape": median_us(repeats, ask_shape),
            "shape_anew": median_us(few, anew(ask_shape)),
        }
        if device == "gpu":
            times["picture"] = median_us(repeats, draw)
            times["picture_anew"] = median_us(few, anew(draw))
    return times


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--device", choices=("cpu", "gpu"), default="cpu")
    parser.add_argument("--segments", type=int, default=10_000)
    parser.add_argument("--repeats", type=int, default=300)
    arguments = parser.parse_args()
    case = (arguments.device, arguments.segments, arguments.repeats)
    taken: dict[str, list[tuple[float, float]]] = collections.defaultdict(list)
    with tempfile.TemporaryDirectory() as folder:
        program = built(folder)
        for _ in range(TURNS):
            python, cpp = in_python(*case), in_cpp(program, *case)
            for name, us in python.items():
                taken[name].append((us, cpp[name]))
    print("| frame | C++, ms | Python, ms | ratio |\n|---|---|---|---|")
    for name, pairs in taken.items():
        python_ms, cpp_ms = (1e-3 * statistics.median(us) for us in zip(*pairs, strict=True))
        print(f"| {name} | {cpp_ms:.3f} | {python_ms:.3f} | {python_ms / cpp_ms:.3f} |")


if __name__ == "__main__":
    main()
