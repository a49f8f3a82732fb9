"""T along the light."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import numpy.typing as npt

from pyopacity.light import DirectionalLight, PointLight
from pyopacity.scene import Scene
from pyopacity.stress.bench import MAP_SIZE, Bench
from pyopacity.stress.case import Finding, case, wrong
from pyopacity.stress.shapes import hair, random_shapes
from pyopacity.stress.way import ALL, Way

F64 = npt.NDArray[np.float64]
DOWN = (0.0, 0.0, -1.0)
STEPS = np.linspace(0.0, 1.0, 91)[None, :, None]
LINES = 120
# Both coordinates of a place in a map are float32 texels, rounded by half of the last digit.
OF_TEXELS = 2 * MAP_SIZE * 2.0**-24


def _along(light: tuple[float, float, float], seed: int) -> F64:
    """Lines of 24 units before the middle of the scene to as much behind it: (lines, points, 3)."""
    starts = np.random.default_rng(seed).uniform(-3, 3, (LINES, 1, 3))
    return np.asarray(starts + (48.0 * STEPS - 24.0) * np.array(light))


def _straight_down(seed: int) -> Iterator[tuple[Scene, F64]]:
    """Along one axis, so that each line stays at one place of the map to the last digit."""
    for shapes in (random_shapes(seed), [hair(seed)]):
        yield Scene(shapes, DirectionalLight(DOWN)), _along(DOWN, seed)


def _slanted(seed: int) -> Iterator[tuple[Scene, F64]]:
    """Along no axis, and away from a point."""
    direction, place = (0.2, 0.1, -1.0), np.array([1.0, 2.0, 9.0])
    yield Scene(random_shapes(seed), DirectionalLight(direction)), _along(direction, seed)
    to = np.random.default_rng(seed).uniform(-2, 2, (LINES, 1, 3))
    yield (
        Scene(random_shapes(seed + 1), PointLight(tuple(place))),
        place + 2.5 * STEPS * (to - place),
    )


Scenes = Callable[[int], Iterator[tuple[Scene, F64]]]


def _lines(bench: Bench, scenes: Scenes) -> Iterator[tuple[Way, F64]]:
    for scene, points in scenes(bench.seed):
        for way in bench.ways(ALL, papers=True):
            T = bench.T(way, scene, points.reshape(-1, 3))
            yield way, T.reshape(points.shape[:2])


def _rises(bench: Bench, scenes: Scenes) -> Iterator[Finding]:
    for way, T in _lines(bench, scenes):
        rise = max(float(np.diff(T, axis=1).max()), 0.0)
        yield Finding(way, rise, f"a rise of {rise:.3g}")


@case(
    "monotone",
    input="90 steps straight down through every kind of caster, and through strands",
    right="T never rises",
    tolerance=0,
    of="T, largest rise",
)
def never_rises(bench: Bench) -> Iterator[Finding]:
    """Omega is a sum over what lies in front, of terms that are not negative."""
    yield from _rises(bench, _straight_down)


@case(
    "monotone",
    input="the same along a slanted light, and away from a point",
    right="T never rises, but for places that are rounded to float32",
    tolerance=OF_TEXELS,
    of="T, largest rise",
    why_tolerance="two coordinates below 64 texels are rounded by 2^-24 of that, and T changes by "
    "1 a texel at most",
)
def hardly_rises(bench: Bench) -> Iterator[Finding]:
    """A point farther along the light lies in the same place of the map but for the last digit of
    two coordinates below 64 texels, by which T, at most 1 from texel to texel, may change.
    """
    yield from _rises(bench, _slanted)


@case(
    "monotone",
    input="both of these",
    right="T in [0, 1], finite, 1 before all casters",
    tolerance=0,
    of="wrong answers",
)
def within_0_and_1(bench: Bench) -> Iterator[Finding]:
    """exp of minus a sum that is not negative, and of no terms at the start."""
    for scenes in (_straight_down, _slanted):
        for way, T in _lines(bench, scenes):
            out = T[~(np.isfinite(T) & (T >= 0.0) & (T <= 1.0))]
            first = T[:, 0][T[:, 0] != 1.0]
            problems = [f"T is {value}" for value in out]
            yield wrong(way, problems + [f"{value} in front" for value in first])
