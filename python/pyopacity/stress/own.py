"""What a strand alone takes of its own light."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from pyopacity.scene import Scene
from pyopacity.shapes import Strands
from pyopacity.stress.bench import Bench
from pyopacity.stress.case import Finding, apart, case
from pyopacity.stress.shapes import down, opacity_of
from pyopacity.stress.way import Way
from pyopacity.trace import trace_transmittance

POINTS = 16
TAUS = (0.1, 0.36, 1.2, 2.3)
SIZE, ACROSS, CELL = 96, 8, 1.5
F64 = npt.NDArray[np.float64]


def isolated(
    tau: float, width: float, across: int, random: np.random.Generator, points: int = POINTS
) -> Strands:
    """Straight strands of length 1, in cells of a grid across the light that none leaves."""
    direction = random.normal(size=(across**2, 1, 3))
    direction /= np.linalg.norm(direction, axis=-1, keepdims=True)
    cell = np.stack(np.meshgrid(np.arange(across), np.arange(across)), axis=-1) * CELL
    middle = np.append(cell.reshape(-1, 1, 2), np.zeros((across**2, 1, 1)), axis=-1)
    xyz = (middle + direction * np.linspace(-0.5, 0.5, points)[:, None]).reshape(-1, 3)
    return Strands(xyz, np.arange(across**2 + 1) * points, width=width, opacity=opacity_of(tau))


def nearest_to_light(strands: Strands) -> npt.NDArray[np.bool_]:
    """Of isolated strands under a light from above: which points are the highest of theirs."""
    heights = np.asarray(strands.points)[:, 2].reshape(len(strands.offsets) - 1, -1)
    return np.asarray(heights == heights.max(axis=1, keepdims=True)).ravel()


def _losses(bench: Bench) -> Iterator[tuple[Way, npt.NDArray[np.bool_], F64, tuple[float, float]]]:
    """(way, which points are nearest to the light, T, (tau, loss of rays)).

    Strands are .1 and .5 texels wide.
    """
    for tau in TAUS:
        for width in (0.0125, 0.0625):
            strands = isolated(tau, width, ACROSS, bench.random(1))
            nearest = nearest_to_light(strands)
            scene = Scene(strands, down())
            truth = trace_transmittance(scene, strands, footprint=2.0 * ACROSS * CELL / SIZE)
            rays = float(1.0 - truth.mean(dtype=np.float64))
            for way in bench.ways():
                yield way, nearest, bench.T(way, scene, strands, SIZE, bias="auto"), (tau, rays)


@case(
    "self",
    input="strands alone, in random directions, tau .1 .. 2.3: the end toward the light",
    right="T = 1",
    tolerance=1e-6,
)
def first_fragment(bench: Bench) -> Iterator[Finding]:
    """The first surface that light meets has nothing in front."""
    for way, nearest, T, _ in _losses(bench):
        yield apart(way, T[nearest], 1.0)


@case(
    "self",
    input="the same: all of the strand",
    right="at most what rays over two texels lose: what lies in front within a texel",
    tolerance=0.01,
    of="T, mean, beyond the rays'",
    why_tolerance="the rays' own bias over a footprint of two texels (accuracy.md, Own shadow)",
)
def own_shadow(bench: Bench) -> Iterator[Finding]:
    """Where a strand runs along the light it has itself in front, within a texel: so has the mean
    of rays over a footprint (docs/accuracy.md, "Own shadow"), whose bias may be .01.
    """
    for way, _, T, (tau, rays) in _losses(bench):
        lost = float(1.0 - T.mean())
        yield Finding(way, max(lost - rays, 0.0), f"{lost:.4f}, {rays:.4f} at tau {tau:g}")
