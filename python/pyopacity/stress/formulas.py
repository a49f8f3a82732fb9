"""Formulas of the engine's core, of no driver: the split curve, the correlation of images."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from pyopacity import _native
from pyopacity.stress.bench import Bench
from pyopacity.stress.case import Finding, apart, case, wrong

F64 = npt.NDArray[np.float64]


@case(
    "split curve",
    input="ratio 0, .1 .. 1, positions 0 .. 1",
    right="(1 - r) x + r log2(1 + 255 x) / 8, rising, and its inverse",
    tolerance=1e-6,
    of="position",
)
def split_curve(bench: Bench) -> Iterator[Finding]:
    """The closed form by numpy; f(0) = 0 and f(1) = 1, since log2(256) = 8."""
    x = np.linspace(0.0, 1.0, 1001)
    for ratio in np.linspace(0.0, 1.0, 11):
        y = _native.split_curve(x, ratio)
        yield apart(None, y, (1.0 - ratio) * x + ratio * np.log2(1.0 + 255.0 * x) / 8.0)
        yield apart(None, _native.split_inverse(y, ratio), x)
        yield apart(None, y[[0, -1]], [0.0, 1.0])
        yield Finding(None, float((np.diff(y) <= 0.0).sum()), "steps that do not rise")


@case(
    "split curve",
    input="ratio 0, .1 .. 1, 1 .. 64 layers",
    right="planes where the curve is k / K, rising also as float32",
    tolerance=1e-6,
    of="layer's number / K",
)
def planes_of_layers(bench: Bench) -> Iterator[Finding]:
    """Layer k of K ends where f(x) = k / K, for f in the closed form above."""
    for ratio in np.linspace(0.0, 1.0, 11):
        for layers in range(1, 65):
            planes = _native.layer_planes(layers, ratio).astype(np.float64)
            curve = (1.0 - ratio) * planes + ratio * np.log2(1.0 + 255.0 * planes) / 8.0
            yield apart(None, curve, np.arange(layers + 1) / layers)
            yield Finding(None, float((np.diff(planes) <= 0.0).sum()), "planes that do not rise")


def two_passes(x: F64, y: F64) -> float:
    """C by the definition: first the means, then the sums; in float64."""
    dx, dy = x - x.mean(), y - y.mean()
    return float((dx * dy).sum() / np.sqrt((dx * dx).sum() * (dy * dy).sum()))


def noisy(random: np.random.Generator, mean: float, slope: float, noise: float) -> tuple[F64, F64]:
    """Two images of deviation about 1 around a mean."""
    x = random.normal(0.0, 1.0, 50_000)
    return mean + x, mean + slope * x + random.normal(0.0, noise, x.size)


@case(
    "correlation",
    input="two images, mean / deviation 0, 1, 1e4; identical, opposite",
    right="C of two passes in float64, in [-1, 1]",
    tolerance=1e-6,
    of="C",
)
def correlation(bench: Bench) -> Iterator[Finding]:
    """The thesis's equation 5.2.3.1 as it stands, in float64."""
    random = bench.random()
    for mean in (0.0, 1.0, 1e4):
        for slope in (1.0, 0.9, 0.01, 0.0, -2.0):
            for noise in (0.5, 1e-3):
                x, y = noisy(random, mean, slope, noise)
                yield apart(None, _native.correlation(x, y), two_passes(x, y))
        x, _ = noisy(random, mean, 1.0, 0.0)
        for y, right in ((x.copy(), 1.0), (2.0 * mean - x, -1.0)):
            found = _native.correlation(x, y)
            yield apart(None, found, right)
            yield wrong(None, [] if abs(found) <= 1.0 else [f"C is {found}"])


@case(
    "correlation",
    input="constant images, one pixel, none; zeros around them",
    right="1, never NaN; what is masked changes nothing",
    tolerance=1e-6,
    of="C",
)
def correlation_of_nothing(bench: Bench) -> Iterator[Finding]:
    """A constant layer tells nothing that its neighbour does not. Zeros on both sides would
    correlate: with as many as pixels, of mean 3, C of independent images were about .7.
    """
    random = bench.random()
    constant, noise = np.full(100, 0.1), random.normal(size=100)
    for x, y in ((constant, noise), (noise, constant), (constant, constant)):
        yield apart(None, _native.correlation(x, y), 1.0)
    yield apart(None, _native.correlation(np.array([1.0]), np.array([2.0])), 1.0)
    yield apart(None, _native.correlation(np.empty(0), np.empty(0)), 1.0)
    x, y = noisy(random, 3.0, 0.2, 1.0)
    covered = random.uniform(size=x.size) < 0.5
    yield apart(
        None, _native.correlation(x[covered], y[covered]), two_passes(x[covered], y[covered])
    )
