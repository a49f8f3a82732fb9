"""Lights and scenes at places that strain numbers: far away, inside, at a vertex."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from pyopacity.light import DirectionalLight, PointLight, SpotLight
from pyopacity.scene import Scene
from pyopacity.shapes import Mesh, Particles, Shape, Strands, Volume
from pyopacity.stress.bench import Bench
from pyopacity.stress.case import Finding, apart, case, wrong
from pyopacity.stress.shapes import column, hair, opacity_of, random_shapes, sheet, tangle
from pyopacity.stress.way import ALL, CASTING, Way

F64 = npt.NDArray[np.float64]
OFFSETS = (1e3, 1e5, 1e7)
TAU = 0.4


def _moved(points: F64, offset: float) -> F64:
    return points + offset * np.array([1.0, -0.7, 0.4])


def _shifted(shape: Shape, offset: float) -> Shape:
    matrix = np.eye(4)
    matrix[:3, 3] = _moved(np.zeros(3), offset)
    return shape.instance(matrix @ shape.transform)


def _as_at_the_origin(way: Way, T: F64, right: F64, offset: float) -> Finding:
    """The largest of all, though a fragment at a texel's edge may change sides: there it covers
    next to nothing, and of a surface's edge within 2e-9 of a texel's middle there is hardly one.
    """
    found = apart(way, T, right)
    return Finding(way, found.error, f"at {offset:g} {found.got}")


@case(
    "offset",
    input="strands moved by 1e3, 1e5, 1e7 in their points, light and all",
    right="T as at the origin",
    tolerance=1e-4,
)
def far_points(bench: Bench) -> Iterator[Finding]:
    """T depends on differences of positions. At 1e7 float64 keeps 2e-9 of them."""
    points, offsets = tangle(9, 60)
    lights = [None, (3.0, 4.0, 40.0)]
    for place in lights:
        right: dict[object, F64] = {}
        for offset in (0.0, *OFFSETS):
            strands = Strands(_moved(points, offset), offsets, width=0.2, opacity=0.3)
            light = (
                DirectionalLight((0.5, 0.3, -0.8))
                if place is None
                else PointLight(tuple(_moved(np.array(place), offset)))
            )
            scene = Scene(strands, light)
            for way in bench.ways(CASTING):
                T = bench.T(way, scene, strands, bias=0.2)
                yield _as_at_the_origin(way, T, right.setdefault(way, T), offset)


@case(
    "offset",
    input="every kind of caster moved by 1e3, 1e5, 1e7 in its transform",
    right="T as at the origin",
    tolerance=1e-4,
)
def far_transforms(bench: Bench) -> Iterator[Finding]:
    """As with points: transform, light and origin are joined in float64."""
    shapes = random_shapes(12)
    asked = bench.random(1).uniform(-2, 2, (800, 3))
    right: dict[object, F64] = {}
    for offset in (0.0, *OFFSETS):
        scene = Scene([_shifted(s, offset) for s in shapes], DirectionalLight((0.5, 0.3, -0.8)))
        for way in bench.ways(CASTING):
            T = bench.T(way, scene, _moved(asked, offset))
            yield _as_at_the_origin(way, T, right.setdefault(way, T), offset)


@case(
    "near/far 1e6",
    input="strands 1 .. 1e4 from a point light, a receiver 1e6 away",
    right="T as without that receiver",
    tolerance=1e-3,
)
def receivers_far_away(bench: Bench) -> Iterator[Finding]:
    """The map is fitted to what casts; a receiver behind it all moves neither near nor far."""
    points, offsets = tangle(9, 60)
    for distance in (1.0, 1e2, 1e4):
        strands = Strands(points, offsets, width=0.3, opacity=0.3)
        light = PointLight((0.0, 0.0, 20.0 + distance))
        ground = sheet(-1e6, 1.0, half=1e6)
        ground.casts = False
        alone, with_ground = Scene(strands, light), Scene(strands, ground, light)
        for way in bench.ways(CASTING):
            right = bench.T(way, alone, strands)
            yield apart(way, bench.T(way, with_ground, strands), right)


def _three(distance: float, spacing: float, size: float) -> list[Shape]:
    return [sheet(-distance - spacing * k, opacity_of(TAU), half=size) for k in range(3)]


def _of_those_in_front(bench: Bench, scene: Scene, points: F64) -> Iterator[Finding]:
    """Of points before the three, between them, and behind all."""
    for way in bench.ways():
        T = bench.T(way, scene, points, filter="none")
        yield apart(way, T, np.exp(-TAU * np.arange(4)))


@case(
    "near/far 1e6",
    input="three surfaces .1 apart, 1 .. 1e4 from the first caster; the last one is 1e6 away",
    right="exp(-tau) of those in front",
    tolerance=1e-3,
)
def directional_range(bench: Bench) -> Iterator[Finding]:
    """Depth is linear and starts at the first caster: float32 keeps 6e-8 of the distance to that.

    Behind two of three surfaces T is exp(-2 tau), whatever lies elsewhere in the map.
    """
    for distance in (1.0, 1e2, 1e4):
        beside = [sheet(z, opacity_of(1e-3), half=0.5, x=9.0) for z in (0.0, -1e6)]
        scene = Scene(*_three(distance, 0.1, 3.0), *beside, DirectionalLight((0.0, 0.0, -1.0)))
        points = column(-distance - np.array([-0.5, 0.05, 0.15, 2e6]))
        yield from _of_those_in_front(bench, scene, points)


@case(
    "near/far 1e6",
    input="three surfaces 2, 100, 5000 from a point light; casters at 1 and at 1e4",
    right="exp(-tau) of those in front",
    tolerance=1e-3,
)
def point_range(bench: Bench) -> Iterator[Finding]:
    """As under a directional light. What is nearer to a light at a place than 1e-4 of the depth of
    all casters casts nothing: the picture of it would have no digits in float32.
    """
    for distance in (2.0, 1e2, 5e3):
        beside = [sheet(-z, opacity_of(1e-3), half=0.05 * z, x=0.8 * z) for z in (1.0, 1e4)]
        own = _three(distance, 0.05 * distance, 0.5 * distance)
        scene = Scene(*own, *beside, PointLight((0.0, 0.0, 0.0)))
        z = distance * np.array([0.98, 1.03, 1.07, 1.5])
        points = np.stack([0.07 * z, 0.03 * z, -z], axis=1)
        yield from _of_those_in_front(bench, scene, points)


@case(
    "light",
    input="a spot of 1 .. 170 degrees over a surface; behind the light, before and behind that",
    right="1, 1, 1 - opacity",
    tolerance=1e-3,
)
def no_mirrored_shadow(bench: Bench) -> Iterator[Finding]:
    """What lies behind the light is before no caster: a perspective would mirror it."""
    points = np.array([(0.001, 0.002, 3.0), (0.001, 0.002, 0.5), (0.001, 0.002, -0.5)])
    for angle_deg in (1.0, 30.0, 60.0, 120.0, 170.0):
        light = SpotLight((0, 0, 1), (0, 0, -1), angle_deg)
        scene = Scene(sheet(0.0, 0.5), light)
        for way in bench.ways():
            yield apart(way, bench.T(way, scene, points), [1.0, 1.0, 0.5])


@case(
    "light",
    input="a point light among three nested opaque-to-none boxes of surfaces, off their middle",
    right="exp(-tau) for each box between",
    tolerance=1e-3,
)
def light_inside(bench: Bench) -> Iterator[Finding]:
    """Through a closed box each ray leaves once. Directions are kept off its edges."""
    tau = 0.3
    boxes = [_box(size, opacity_of(tau)) for size in (1.0, 2.0, 4.0)]
    scene = Scene(boxes, PointLight((0.03, 0.02, -0.01)))
    directions = bench.random(4).normal(size=(400, 3))
    largest = np.abs(directions).max(axis=1, keepdims=True)
    directions /= largest
    second = np.sort(np.abs(directions), axis=1)[:, 1]
    directions = directions[second < 0.8]
    for factor, crossed in ((0.5, 0), (1.5, 1), (3.0, 2), (9.0, 3)):
        for way in bench.ways():
            T = bench.T(way, scene, factor * directions, 96, filter="none")
            yield apart(way, T, np.exp(-tau * crossed))


def _box(half: float, opacity: float) -> Shape:
    corners = half * np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = np.array([t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))])
    return Mesh(corners, triangles, opacity=opacity)


@case(
    "light",
    input="a light at a vertex, 1e-9 beside it, in a particle, in a voxel, in hair",
    right="finite T in [0, 1]; 1 at the light",
    tolerance=0,
    of="wrong answers",
)
def light_at_a_vertex(bench: Bench) -> Iterator[Finding]:
    """No direction is that of a point to itself; nothing is nearer to the light than the light."""
    casters: list[Shape] = [
        Strands(np.array([(0.0, 0, 0), (0, 0, 1)]), np.array([0, 2]), width=0.1),
        Particles(np.zeros((1, 3)), radius=1.0, opacity=0.5),
        Volume(np.ones((4, 4, 4)), origin=(-1.5, -1.5, -1.5)),
        sheet(0.0, 0.5),
        hair(),
    ]
    asked = bench.random(5).uniform(-1.5, 1.5, (200, 3))
    for chosen in (casters[:1], casters):
        light = PointLight((0.0, 0.0, 0.0))
        scene = Scene(chosen, light)
        for way in bench.ways(ALL):
            for place in ((0.0, 0.0, 0.0), (1e-9, 0.0, 0.0), (0.5, -0.2, 0.1)):
                light.position = place
                T = bench.T(way, scene, np.concatenate([asked, [place]]), 32)
                is_bad = not (np.isfinite(T).all() and T.min() >= 0.0 and T.max() <= 1.0)
                problems = [f"light at {place}: {T.min()} .. {T.max()}"] * is_bad
                problems += [f"T {T[-1]} at the light, {place}"] * bool(T[-1] != 1.0)
                yield wrong(way, problems)
