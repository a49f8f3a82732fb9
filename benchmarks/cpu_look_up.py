"""T at every strand vertex without OpenGL, as a ratio to one ray a vertex traced by Embree.

    python benchmarks/cpu_look_up.py [--segments 1000000] [--rounds 3] > table.md

Both start from nothing each time, on the same cores: the maps with all of their passes, the rays
with their hierarchy. They take turns, three look-ups to a trace; figures are medians. The goal is
1/30.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable

import numpy as np
import numpy.typing as npt

import pyopacity as po

LIGHT = po.DirectionalLight((0.5, 0.3, -0.8))
TECHNIQUE = "bounding_opacity_maps"
LOOK_UPS_A_TRACE = 3


def seconds(work: Callable[[], object]) -> float:
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def passes(scene: po.Scene, map_size: int) -> dict[str, float]:
    """Milliseconds of each pass that ran."""
    with po.Renderer(scene, technique=TECHNIQUE, device="cpu", map_size=map_size) as renderer:
        renderer.transmittance(scene.shapes[0])
        return {row.name: row.ms for row in renderer.report if row.status == "ran"}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--segments", type=int, default=1_000_000)
    parser.add_argument("--map-size", type=int, default=512)
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    scene = po.Scene(po.load(f"demo:hair?segments={arguments.segments}"), LIGHT)
    hair = scene.shapes[0]
    found: dict[str, npt.NDArray[np.float32]] = {}

    def look_up() -> None:
        found["maps"] = po.transmittance(scene, hair, TECHNIQUE, arguments.map_size)

    def trace() -> None:
        found["rays"] = po.trace_transmittance(scene, hair, footprint=0.0)

    maps, rays = [], []
    for _ in range(arguments.rounds):
        maps += [seconds(look_up) for _ in range(LOOK_UPS_A_TRACE)]
        rays.append(seconds(trace))
    ratio = statistics.median(rays) / statistics.median(maps)
    print(f"{len(hair.points):,} vertices, {po.trace_backends()[0]}\n")
    print("| maps, s | rays, s | ratio | mean T, maps | mean T, rays |\n|---|---|---|---|---|")
    times = f"{statistics.median(maps):.3f} | {statistics.median(rays):.1f} | 1/{ratio:.0f}"
    print(f"| {times} | {found['maps'].mean():.4f} | {found['rays'].mean():.4f} |\n")
    print("| pass | ms |\n|---|---|")
    for name, ms in passes(scene, arguments.map_size).items():
        print(f"| `{name}` | {ms:.0f} |")


if __name__ == "__main__":
    main()
