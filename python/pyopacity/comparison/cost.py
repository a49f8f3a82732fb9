"""What the maps of a technique cost: time, passes, memory."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from pyopacity.comparison.truth import Receivers
from pyopacity.renderer import Renderer

# A technique without maps of its own has this too, with the texels of the others.
_EVERY_MAP_HAS = "opaque_moved"
# What asks a map for T, and the answer; what uses it in a picture.
_LOOK_UPS = ("transmittance", "query")
_USES_MAPS = ("lighting", "transmittance")


@dataclass(frozen=True, slots=True)
class Cost:
    """Of one technique on one scene.

    Attributes:
        seconds: for a whole frame, or T at the receivers' shapes where there are no pictures, with
            nothing kept from the last; the median of a few.
        map_seconds: the part of it that made the light's maps.
        passes: that make the maps of all lights from nothing.
        bytes_per_texel: that the maps hold of each of their texels, with what passes hand to each
            other.
    """

    seconds: float
    map_seconds: float
    passes: int
    bytes_per_texel: float


def cost_of(renderer: Renderer, receivers: Receivers, repeats: int) -> Cost:
    """Of the renderer's technique; it renders and looks T up for that."""
    passes, bytes_per_texel = size_of_maps(renderer, receivers.lights)
    once = time_of_look_ups if renderer.device == "cpu" else _time_of_picture
    times = [once(renderer, receivers) for _ in range(repeats)]
    seconds, map_seconds = np.median(times, axis=0)
    return Cost(float(seconds), float(map_seconds), passes, bytes_per_texel)


def size_of_maps(renderer: Renderer, lights: int) -> tuple[int, float]:
    """Passes that make the maps of so many lights, and the bytes that they hold a texel."""
    passes = held = texels = 0
    for light in range(lights):
        renderer.transmittance(np.zeros((1, 3)), light)
        passes += sum(row.status != "culled" and makes_maps(row.name) for row in renderer.report)
        for row in renderer.memory():
            part = _last_part(row.name)
            held += row.bytes if part not in _LOOK_UPS else 0
            texels += row.texels if part == _EVERY_MAP_HAS else 0
    return passes, held / texels


def _time_of_picture(renderer: Renderer, _: Receivers) -> tuple[float, float]:
    """Seconds of a whole frame, and of its passes before the light is used."""
    renderer.invalidate()
    start = time.perf_counter()
    renderer.render()
    return time.perf_counter() - start, _map_seconds(renderer)


def time_of_look_ups(renderer: Renderer, receivers: Receivers) -> tuple[float, float]:
    """Seconds of T at all points of the receivers' shapes, from nothing, and of the maps alone."""
    renderer.invalidate()
    maps = 0.0
    start = time.perf_counter()
    for light in range(receivers.lights):
        for shape, _ in receivers.chosen:
            renderer.transmittance(shape, light)
            maps += _map_seconds(renderer)
    return time.perf_counter() - start, maps


def _map_seconds(renderer: Renderer) -> float:
    return sum(row.ms for row in renderer.report if makes_maps(row.name)) / 1000.0


def makes_maps(name: str) -> bool:
    """Whether a pass of this name makes the light's maps; others use them."""
    return _last_part(name) not in _USES_MAPS


def _last_part(name: str) -> str:
    return name.rpartition("/")[2]
