"""Times of frames: in turns, so that what slows the machine down slows all; medians."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Mapping

import numpy as np

import pyopacity as po

WARM_UP = 1  # rounds in which programs are made


def medians_in_turns(
    ways: Mapping[str, Callable[[], Mapping[str, float]]], rounds: int
) -> dict[str, dict[str, float]]:
    """Medians of what each way returns, by way and by name.

    Args:
        ways: each measures itself once when it is called.
        rounds: how often, after one that does not count.
    """
    found: dict[str, dict[str, list[float]]] = {name: {} for name in ways}
    for turn in range(-WARM_UP, rounds):
        for name, measure in ways.items():
            for what, value in measure().items():
                if turn >= 0:
                    found[name].setdefault(what, []).append(value)
    return {
        name: {what: statistics.median(values) for what, values in row.items()}
        for name, row in found.items()
    }


def seconds(renderer: po.Renderer) -> float:
    """A clock to take differences of: on a GPU the wall's, in software what all cores have worked,
    which does not count what others on the same cores do."""
    is_software = renderer.device == "cpu" or renderer.context.is_software
    return time.process_time() if is_software else time.perf_counter()


def frame_cost(renderer: po.Renderer) -> dict[str, float]:
    """Milliseconds of a frame with all done anew: "maps", "scene", and both as "frame"."""
    renderer.invalidate()
    start = seconds(renderer)
    renderer.transmittance(np.zeros((1, 3)))  # draws the maps, and asks for one point
    drawn = seconds(renderer)
    renderer.render()
    end = seconds(renderer)
    maps, scene = 1e3 * (drawn - start), 1e3 * (end - drawn)
    return {"maps": maps, "scene": scene, "frame": maps + scene}
