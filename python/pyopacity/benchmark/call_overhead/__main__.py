"""main.cpp in Python: ``python -m pyopacity.benchmark.call_overhead DEVICE SEGMENTS REPEATS``."""

from __future__ import annotations

import statistics
import sys
from collections.abc import Callable

import numpy as np

from pyopacity.benchmark.clock import seconds_of
from pyopacity.benchmark.run import LIGHT, hair_of, strands_of
from pyopacity.io import load
from pyopacity.light import DirectionalLight
from pyopacity.renderer import Renderer
from pyopacity.scene import Scene

_SIDE = 64  # of the picture, pixels
_WARM_UP = 2


def _measure(renderer: Renderer, has_pictures: bool, repeats: int) -> None:
    """Prints the median microseconds of each kind of frame."""
    hair = strands_of(renderer.scene)
    points, few = hair.points, max(repeats // 30, 9)
    t, rgba = np.empty(len(points), np.float32), np.empty((_SIDE, _SIDE, 4), np.float32)

    def tell(frame: str, times: int, work: Callable[[], object]) -> None:
        for _ in range(_WARM_UP):
            work()
        print(frame, 1e6 * statistics.median(seconds_of(work) for _ in range(times)))

    def anew(work: Callable[[], object]) -> Callable[[], object]:
        def forget_and_work() -> None:
            renderer.invalidate()
            work()

        return forget_and_work

    def ask_shape() -> object:
        return renderer.transmittance(hair, out=t)

    def draw() -> object:
        return renderer.render(out=rgba)

    tell("points", repeats, lambda: renderer.transmittance(points, out=t))
    tell("shape", repeats, ask_shape)
    tell("shape_anew", few, anew(ask_shape))
    if has_pictures:
        tell("picture", repeats, draw)
        tell("picture_anew", few, anew(draw))


def main(device: str, segments: str, repeats: str) -> None:
    """As main.cpp has it."""
    scene = Scene(load(hair_of(int(segments))), DirectionalLight(LIGHT))
    on_gpu = device == "gpu"
    with Renderer(scene, size=(_SIDE, _SIDE), device="gpu" if on_gpu else "cpu") as renderer:
        _measure(renderer, on_gpu, int(repeats))


if __name__ == "__main__":
    main(*sys.argv[1:])
