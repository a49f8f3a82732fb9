"""Series of the density along a texel, by their formulas in float64."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt
from numpy.polynomial import legendre

from pyopacity.scene import Scene
from pyopacity.shapes import Shape
from pyopacity.stress.bench import Bench
from pyopacity.stress.case import Finding, apart, case, wrong
from pyopacity.stress.shapes import column, down, opacity_of, sheet
from pyopacity.stress.way import Way, parameters_of

F64 = npt.NDArray[np.float64]
BASES = ("fourier", "piecewise_constant", "cosine", "legendre")
_AUTO_MARGIN = {"fourier": 1 / 3}  # by the number of harmonics; others have none


def functions(basis: str, count: int, z: F64) -> F64:
    """f_k at z in 0 .. 1: (count, points)."""
    k = np.arange(count)[:, None]
    if basis == "fourier":
        angle = 2 * np.pi * ((k + 1) // 2) * z
        waves: F64 = np.where(k % 2 == 1, np.cos(angle), np.where(k == 0, 1.0, np.sin(angle)))
        return np.asarray(waves, np.float64)
    if basis == "cosine":
        return np.asarray(np.cos(np.pi * k * z), np.float64)
    if basis == "legendre":
        return np.asarray(legendre.legvander(2 * z - 1, count - 1).T, np.float64)
    return np.asarray(np.minimum(z * count, count - 0.5).astype(int) == k, np.float64)


def integrals(basis: str, count: int, z: F64) -> F64:
    """Of f_k from 0 to z, in closed form: (count, points)."""
    k = np.arange(count)[:, None]
    if basis == "fourier":
        rate = 2 * np.pi * np.maximum((k + 1) // 2, 1)
        waves = np.where(k % 2 == 1, np.sin(rate * z), 1.0 - np.cos(rate * z)) / rate
        return np.asarray(np.where(k == 0, z, waves), np.float64)
    if basis == "cosine":
        rate = np.pi * np.maximum(k, 1)
        return np.asarray(np.where(k == 0, z, np.sin(rate * z) / rate), np.float64)
    if basis == "legendre":
        # (2 k + 1) P_k = (P_k+1 - P_k-1)', and dz = dx / 2; both are equal at x = -1.
        p = legendre.legvander(2 * z - 1, count).T
        before = np.concatenate([np.full((1, z.size), -1.0), p[:-2]])
        return np.asarray((p[1:] - before) / (2.0 * (2 * k + 1)), np.float64)
    return np.asarray(np.clip(z * count - k, 0.0, 1.0) / count, np.float64)


def norms(basis: str, count: int) -> F64:
    """1 / the integral of f_k^2: what makes f_k times it the dual of f_k."""
    k = np.arange(count)
    if basis == "legendre":
        return np.asarray(2.0 * k + 1.0, np.float64)
    if basis == "piecewise_constant":
        return np.full(count, float(count))
    return np.where(k == 0, 1.0, 2.0).astype(np.float64)


def inset_of(basis: str, count: int) -> float:
    """How far the first caster lies from the start of the period, in periods."""
    margin = _AUTO_MARGIN.get(basis, 0.0) / (count // 2)
    return margin / (1 + 2 * margin)


def part_before(basis: str, count: int, caster: npt.ArrayLike, places: F64) -> F64:
    """The part of a caster before each place: the series' integral up to there, in closed form.

    Depths are 0 .. 1 of the light's space. Source: Jansen and Bavoil 2010, equations 5 to 7.
    """
    inset = inset_of(basis, count)
    at, to = (
        inset + (1 - 2 * inset) * np.atleast_1d(np.asarray(x, np.float64)) for x in (caster, places)
    )
    density = norms(basis, count) * functions(basis, count, at)[:, 0]
    return np.asarray(density @ integrals(basis, count, to))


def between_0_and_10(*shapes: Shape) -> Scene:
    """Squares aside, at heights 10 and 0, hold the depths: from 10 to somewhat below 0."""
    ends = [sheet(height, opacity_of(0.5), 1.0, x=-9.0) for height in (10.0, 0.0)]
    return Scene([*ends, *shapes], down())


def depths(light_from_world: F64, heights: npt.ArrayLike) -> F64:
    """Of the light's space, 0 .. 1, under a light from above."""
    z = np.asarray(heights, np.float64)
    return np.asarray(light_from_world[2, 2] * z + light_from_world[2, 3])


def _ways(bench: Bench, basis: str) -> list[Way]:
    every = [way for way in bench.ways() if "coefficients" in parameters_of(way.technique)]
    return [Way(way.device, way.technique, (("basis", basis),)) for way in every]


def _sheets(bench: Bench, basis: str) -> Iterator[tuple[Way, F64, F64]]:
    heights = np.linspace(9.9, 0.1, 57)
    for count, tau in ((3, 0.1), (8, 1.0), (15, 20.0), (31, 5.0), (63, 2.0)):
        # T of more than 16.6 is that of an opaque caster, so that there are two.
        scene = between_0_and_10(*(sheet(6.3, opacity_of(tau / 2), 4.0) for _ in range(2)))
        for way in _ways(bench, basis):
            T = bench.T(way, scene, column(heights), 32, coefficients=count)
            matrix = bench.renderer(way, scene, 32, coefficients=count).light_from_world
            part = part_before(basis, count, depths(matrix, 6.3), depths(matrix, heights))
            yield way, T, np.exp(-tau * np.clip(part, 0.0, 1.0))


@case(
    "FOM",
    input="one surface, tau .1 .. 20, 3 .. 63 coefficients, of each basis",
    right="the series of a point, its integral in closed form, in float64",
    tolerance=1e-4,
)
def series_of_a_point(bench: Bench) -> Iterator[Finding]:
    """The coefficients of a point at d are f_k(d); T is exp of minus the integral of their sum,
    held between 0 and the caster's optical depth.
    """
    for basis in BASES:
        yield from (apart(*answer) for answer in _sheets(bench, basis))


@case(
    "FOM",
    input="the same",
    right="T in [0, 1]",
    tolerance=0,
    of="wrong answers",
)
def clamped_series(bench: Bench) -> Iterator[Finding]:
    """A series rings above 1 and below what all casters let through; T is clamped."""
    for basis in BASES:
        for way, T, _ in _sheets(bench, basis):
            out = T[~((T >= 0.0) & (T <= 1.0))]
            yield wrong(way, [f"T is {value}" for value in out])
