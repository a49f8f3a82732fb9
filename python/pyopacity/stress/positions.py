"""Vertices that are nowhere, and primitives without an extent."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np

from pyopacity.errors import ParameterError
from pyopacity.scene import Scene
from pyopacity.shapes import Mesh, Particles, Strands, Volume
from pyopacity.stress.bench import Bench
from pyopacity.stress.case import Finding, apart, case, refusal, wrong
from pyopacity.stress.shapes import slanted, tangle
from pyopacity.stress.way import ALL

COUNT = 100_000
AT = 77_777  # 1 in 1e5


@case(
    "positions bad",
    input="NaN, Inf, -Inf in one of 1e5 points of strands, a mesh, particles; of a question",
    right="a ParameterError that names the point",
    tolerance=0,
    of="wrong answers",
    why_tolerance="a typed error, always: nothing is cleaned, and no option would",
)
def points_that_are_nowhere(bench: Bench) -> Iterator[Finding]:
    """A point that is not finite has no place in a map."""
    problems = []
    good = bench.random().uniform(-1, 1, (COUNT, 3))
    offsets = np.array([0, COUNT])
    triangles = np.array([[0, 1, 2]])
    kept = [Strands(good, offsets), Mesh(good, triangles), Particles(good)]
    scene = Scene(kept[0], slanted())
    for value in (np.nan, np.inf, -np.inf):
        for dtype in (np.float32, np.float64):
            points: Any = good.astype(dtype)
            points[AT, 1] = value
            tries: list[Callable[[], object]] = [
                partial(Strands, points, offsets),
                partial(Mesh, points, triangles),
                partial(Particles, points),
                *(partial(setattr, shape, "points", points) for shape in kept),
            ]
            for call in tries:
                problems += refusal(call, f"[{AT}", ParameterError)
            asked = points[AT - 1 : AT + 1].copy()
            for way in bench.ways(ALL[:1]):
                ask = partial(bench.renderer(way, scene, 16).transmittance, asked)
                problems += refusal(ask, "[1]", ParameterError)
    yield wrong(None, problems)


def _hair_with(stop: int | None) -> tuple[Strands, np.ndarray]:
    """Strands, after ``stop`` points one again: a segment of no length; and the other points."""
    points, offsets = tangle(5, strands=60)
    is_own = np.ones(len(points) + (stop is not None), bool)
    if stop is not None:
        points = np.insert(points, stop, points[stop], axis=0)
        offsets = offsets + (offsets > stop)
        is_own[stop] = False
    return Strands(points, offsets, width=0.3, opacity=0.4), is_own


@case(
    "positions bad",
    input="a segment of no length, strands of one point and of none; triangles that are a line",
    right="T of the rest, bit for bit",
    tolerance=0,
    why_tolerance="no error: they are taken, and the rest is unchanged",
)
def primitives_without_extent(bench: Bench) -> Iterator[Finding]:
    """They cover nothing, so that they deposit nothing, and move no bound."""
    corners = np.array([(-5.0, -5, 1), (5, -5, 2), (5, 5, 1), (-5, 5, 0), (0, 0, 1.25)])
    veil = Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]), opacity=0.3)
    degenerate = np.array([[0, 1, 2], [3, 3, 3], [0, 0, 2], [0, 2, 3], [1, 4, 1]])
    torn = Mesh(corners, degenerate, opacity=0.3)
    short, is_own = _hair_with(stop=203)
    lone = Strands(tangle(5)[0][:3].copy(), np.array([0, 1, 1, 2, 3]), width=0.3, opacity=0.9)
    whole = Scene(_hair_with(None)[0], veil, slanted())
    broken = Scene(short, torn, lone, slanted())
    asked = bench.random(2).uniform(-8, 8, (1500, 3))
    for way in bench.ways(ALL, papers=True):
        right = bench.T(way, whole, asked)
        yield apart(way, bench.T(way, broken, asked), right)


@case(
    "positions bad",
    input="shapes without points, of no width, of no radius, of no extinction, and 1e-30 wide",
    right="finite T in [0, 1]",
    tolerance=0,
    of="wrong answers",
    why_tolerance="no error: they are taken",
)
def shapes_of_nothing(bench: Bench) -> Iterator[Finding]:
    """What has no area casts nothing; a map that is fitted to nothing is still a map."""
    point = np.zeros((4, 3))
    tiny = np.array([[1e-30, 0, 0], [0, 1e-30, 0]])
    shapes = [
        Strands(point, np.array([0, 2, 2, 3, 4]), width=0.1),
        Strands(np.zeros((0, 3)), np.array([0])),
        Strands(np.array([[0.0, 0, 0], [0, 0, 1]]), np.array([0, 2]), width=0.0),
        Mesh(point, np.array([[0, 1, 2], [3, 3, 3]]), opacity=0.5),
        Mesh(np.zeros((0, 3)), np.zeros((0, 3), np.int64)),
        Strands(tiny, np.array([0, 2]), width=1e-30),
        Particles(point, 0.0, 0.5),
        Particles(np.zeros((0, 3))),
        Particles(point, 1e-30, 0.5),
        Volume(np.zeros((2, 2, 2))),
        Volume(np.full((1, 1, 1), 1e18), spacing=1e-18),
    ]
    asked = bench.random(3).normal(size=(50, 3))
    scenes = [Scene(chosen, slanted()) for chosen in [*([shape] for shape in shapes), shapes]]
    problems: dict[object, list[str]] = {way: [] for way in bench.ways(ALL)}
    for scene in scenes:
        for way in bench.ways(ALL):
            T = bench.T(way, scene, asked, 16)
            if not (np.isfinite(T).all() and T.min() >= 0.0 and T.max() <= 1.0):
                problems[way].append(f"{scene.shapes}: {T.min()} .. {T.max()}")
    for way in bench.ways(ALL):
        yield wrong(way, problems[way])
