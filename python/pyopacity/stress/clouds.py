"""Beer-Lambert on Poisson clouds, by tests of each texel."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np
import numpy.typing as npt

from pyopacity.scene import Scene
from pyopacity.shapes import Particles
from pyopacity.stress.bench import Bench
from pyopacity.stress.case import Finding, apart, case
from pyopacity.stress.grid import Grid
from pyopacity.stress.way import Way

F64 = npt.NDArray[np.float64]

SIDE = 32  # texels
OPACITY = 0.6
RADIUS_TEXELS = 0.2
MOST_Z = 3.5
# How often a right map may fail one of these tests: one run of the suite in a thousand.
ALPHA = 1e-3
_RINGS = 20_000


@dataclass(frozen=True, slots=True)
class Cloud:
    """Spheres whose centres are a Poisson process, less those across a texel's border.

    What is left is a Poisson process too, so that the counts of the texels are independent, with
    one mean.

    Attributes:
        scene: the spheres, and faint sheets that hold the map where it is.
        mean: of a texel's count.
        one: the optical depth of a texel with one sphere.
        behind: a point behind each texel's middle, (SIDE^2, 3).
    """

    scene: Scene
    mean: float
    one: float
    behind: F64


def _mean_opacity() -> float:
    """Of a sphere over its disc: 1 - exp(-tau c) at half chords c, on the area 2 c dc."""
    c = (np.arange(_RINGS) + 0.5) / _RINGS
    return float(np.mean(2.0 * c * -np.expm1(np.log1p(-OPACITY) * c)))


def cloud(bench: Bench, points: int) -> Cloud:
    """About so many spheres."""
    grid = Grid(bench, SIDE)
    random = bench.random(1)
    low, high = 2.0, SIDE - 2.0  # the sheets cover these
    at = random.uniform((low, low, 0.0), (high, high, grid.last), (random.poisson(points), 3))
    inside = np.abs(at[:, :2] - np.floor(at[:, :2]) - 0.5).max(axis=1) < 0.5 - RADIUS_TEXELS
    radius = float(np.float32(RADIUS_TEXELS * grid.texel))
    middles = np.arange(low, high) + 0.5
    x, y = (axis.ravel() for axis in np.meshgrid(middles, middles))
    area = math.pi * (radius / grid.texel) ** 2
    return Cloud(
        grid.scene(Particles(grid.world(at[inside]), radius, OPACITY)),
        points * (1.0 - 2.0 * RADIUS_TEXELS) ** 2 / (high - low) ** 2,
        -math.log1p(-area * _mean_opacity()),
        grid.world(np.stack([x, y, np.full(x.size, 1.5)], axis=1)),
    )


def _counts(bench: Bench, of: Cloud) -> Iterator[tuple[Way, F64]]:
    """How many spheres each texel's T says that it has: -log(T) / one."""
    for way in bench.ways():
        T = bench.T(way, of.scene, of.behind, SIDE, filter="none")
        yield way, -np.log(np.maximum(T, 1e-30)) / of.one


def z_values(counts: F64, mean: float) -> F64:
    """Of Poisson counts, nearly normal also in the tails: 2 (sqrt(n + 3/8) - sqrt(mean + 1/8)).

    Source: Anscombe, "The transformation of Poisson, binomial and negative-binomial data",
    Biometrika 35, 1948; the second constant centres it, to 1 / mean.
    """
    return np.asarray(2.0 * (np.sqrt(counts + 0.375) - math.sqrt(mean + 0.125)))


def _z_of_texels(bench: Bench) -> Iterator[tuple[Way, F64]]:
    """Of the large cloud, by each way."""
    of = cloud(bench, 1_000_000 if bench.is_thorough else 100_000)
    for way, counts in _counts(bench, of):
        yield way, z_values(counts, of.mean)


@case(
    "Beer-Lambert",
    input="a Poisson cloud of 1e6 spheres; each texel's T behind it",
    right="exp(-lambda a): abs(z) <= 3.5 on 99.5 % of the texels",
    tolerance=0.005,
    of="texels beyond 3.5",
    is_slow=True,
)
def texels_beyond(bench: Bench) -> Iterator[Finding]:
    """-log T over one sphere's optical depth is a Poisson count. Of a normal one 1 in 2149 texels
    lies beyond 3.5.
    """
    for way, values in _z_of_texels(bench):
        z = np.abs(values)
        yield Finding(way, float(np.mean(~(z <= MOST_Z))), f"most z {z.max():.2f}")


@case(
    "Beer-Lambert",
    input="the same: the largest z of all texels",
    right="below the Sidak bound of as many independent tests at .001",
    tolerance=1.0,
    of="z, by the bound",
    is_slow=True,
    why_tolerance="Sidak's bound of as many tests at .001",
)
def largest_z(bench: Bench) -> Iterator[Finding]:
    """Texels are independent, so that all stay below the quantile of (1 - .001)^(1/M) together in
    999 of 1000 right maps: Sidak's correction is exact.
    """
    for way, values in _z_of_texels(bench):
        each = 1.0 - (1.0 - ALPHA) ** (1.0 / values.size)
        bound = NormalDist().inv_cdf(1.0 - 0.5 * each)
        z = float(np.abs(values).max())
        yield Finding(way, z / bound, f"{z:.3f}, at most {bound:.3f}")


@case(
    "Beer-Lambert",
    input="the same: the sum of z^2, and the mean of z",
    right="chi squared of as many degrees, and normal: at .001 each",
    tolerance=1.0,
    of="z, by the bound",
    is_slow=True,
    why_tolerance="the bounds of two tests at .0005 each",
)
def spread_of_z(bench: Bench) -> Iterator[Finding]:
    """Too even is as wrong as too uneven. Wilson and Hilferty's cube root makes chi squared
    normal; two tests a way share the .001 by halves (Bonferroni).
    """
    bound = NormalDist().inv_cdf(1.0 - 0.25 * ALPHA)
    for way, z in _z_of_texels(bench):
        spread = 2.0 / (9.0 * z.size)
        squares = ((np.mean(z**2)) ** (1.0 / 3.0) - (1.0 - spread)) / math.sqrt(spread)
        mean = float(z.mean()) * math.sqrt(z.size)
        worst = max(abs(float(squares)), abs(mean))
        yield Finding(way, worst / bound, f"mean {mean:.2f}, squares {squares:.2f}")


@case(
    "Beer-Lambert",
    input="the same: what each texel holds, counted",
    right="a whole number of spheres",
    tolerance=1e-4,
    of="spheres",
    is_slow=True,
    why_tolerance="25 terms of .05 each round by 2^-24 of a sum of 1.25 at most, 2e-6: 4e-5 "
    "spheres",
)
def whole_counts(bench: Bench) -> Iterator[Finding]:
    """A sphere within a texel takes the same from it wherever it lies there. Of the first hundred
    a texel; more lose digits of T.
    """
    of = cloud(bench, 20_000)
    for way, counts in _counts(bench, of):
        yield apart(way, counts, np.round(counts))
