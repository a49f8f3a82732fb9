"""Metamorphic relations: what another scene says about this one, without a truth for either."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from pyopacity.light import DirectionalLight, PointLight
from pyopacity.scene import Scene
from pyopacity.shapes import Mesh, Particles, Shape, Strands
from pyopacity.stress.bench import Bench
from pyopacity.stress.case import Finding, apart, case
from pyopacity.stress.shapes import hair, random_shapes, sheet, slanted, tangle
from pyopacity.stress.way import Way

F64 = npt.NDArray[np.float64]


def _compared(
    bench: Bench, right: Scene, asked: F64, others: list[tuple[Scene, F64]]
) -> Iterator[tuple[Way, F64, F64]]:
    for way in bench.ways():
        truth = bench.T(way, right, asked, bias=0.0)
        for scene, points in others:
            yield way, bench.T(way, scene, points), truth


def _alike(
    bench: Bench, right: Scene, asked: F64, others: list[tuple[Scene, F64]]
) -> Iterator[Finding]:
    for way, T, truth in _compared(bench, right, asked, others):
        yield apart(way, T, truth)


def _mean(way: Way, T: F64, truth: F64) -> Finding:
    """How far the means over all points are apart, relative."""
    off = abs(T.mean() - truth.mean()) / truth.mean()
    return Finding(way, float(off), f"{T.mean():.6f}, {truth.mean():.6f}")


def permuted_shape(shape: Shape, order: np.random.Generator) -> Shape:
    if isinstance(shape, Strands):
        strands = order.permutation(len(shape.offsets) - 1)
        pieces = [np.arange(shape.offsets[k], shape.offsets[k + 1]) for k in strands]
        index = np.concatenate(pieces)
        sizes = [len(piece) for piece in pieces]
        offsets = np.concatenate([[0], np.cumsum(sizes)])
        values = [np.broadcast_to(v, len(index))[index] for v in (shape.width, shape.opacity)]
        other: Shape = Strands(shape.points[index].copy(), offsets, *values)
    elif isinstance(shape, Particles):
        index = order.permutation(len(shape.points))
        radius, opacity = (
            np.broadcast_to(v, len(index))[index] for v in (shape.radius, shape.opacity)
        )
        other = Particles(shape.points[index].copy(), radius, opacity, profile=shape.profile)
    elif isinstance(shape, Mesh) and shape.alpha_map is None:
        triangles = shape.triangles[order.permutation(len(shape.triangles))]
        other = Mesh(shape.points.copy(), triangles.astype(np.int64), opacity=shape.opacity)
    else:
        return shape.instance()
    other.transform = shape.transform
    return other


@case(
    "metamorphic",
    input="shapes, strands, triangles and particles in another order",
    right="T as before",
    tolerance=1e-5,
)
def permuted(bench: Bench) -> Iterator[Finding]:
    """A sum does not depend on the order of its terms."""
    shapes = random_shapes(bench.seed + 3)
    order = bench.random(1)
    other = [permuted_shape(shape, order) for shape in shapes][::-1]
    asked = bench.random(2).uniform(-2, 2, (1500, 3))
    pair = Scene(shapes, slanted()), Scene(other, slanted())
    yield from _alike(bench, pair[0], asked, [(pair[1], asked)])


@case(
    "metamorphic",
    input="a union of every kind of caster; a directional and a point light",
    right="the product of each part's T",
    tolerance=1e-4,
)
def union(bench: Bench) -> Iterator[Finding]:
    """exp(-(a + b)) = exp(-a) exp(-b), behind all casters and in single texels."""
    shapes = [s for s in random_shapes(bench.seed + 4) if not (isinstance(s, Mesh) and s.opaque)]
    frame = sheet(0.0, 1e-7, half=16.0)  # one map for all parts, of the same place and size
    ends = sheet(-6.0, 1e-7, half=0.1, x=15.0), sheet(6.0, 1e-7, half=0.1, x=15.0)
    below = bench.random(3).uniform((-2, -2, -99), (2, 2, -99), (500, 3))
    for light in (DirectionalLight((0.3, 0.2, -1.0)), PointLight((4.0, 3.0, 30.0))):
        scenes = [
            Scene(*chosen, frame, *ends, light) for chosen in [shapes, *([s] for s in shapes)]
        ]
        for way in bench.ways():
            T = [bench.T(way, scene, below, filter="none") for scene in scenes]
            yield apart(way, T[0], np.prod(T[1:], axis=0))
        bench.clear()


def _turned(points: F64, degrees: float) -> F64:
    a = np.radians(degrees)
    turn = np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])
    return np.ascontiguousarray(points @ turn.T)


def _seen_from_above(points: F64, offsets: npt.NDArray[np.int64], scale: float = 1.0) -> Scene:
    strands = Strands(scale * points, offsets, width=0.3 * scale, opacity=0.4)
    return Scene(strands, DirectionalLight((0.0, 0.0, -1.0)))


@case(
    "metamorphic",
    input="strands and questions turned about the light by 17, 45, 90 degrees",
    right="the mean of T as before",
    tolerance=1e-2,
    of="T, mean, relative",
    why_tolerance="the mean: texels lie elsewhere, and a single T is one of theirs",
)
def turned(bench: Bench) -> Iterator[Finding]:
    """The deposit keeps areas whatever their angle to the map; where texels lie is another."""
    points, offsets = tangle(6, 80)
    asked = bench.random(4).uniform(-6, 6, (4000, 3))
    others = [
        (_seen_from_above(_turned(points, a), offsets), _turned(asked, a)) for a in (17, 45, 90)
    ]
    for found in _compared(bench, _seen_from_above(points, offsets), asked, others):
        yield _mean(*found)


@case(
    "metamorphic",
    input="strands on maps of 64, 128, 256",
    right="the mean of T as before",
    tolerance=1e-2,
    of="T, mean, relative",
    why_tolerance="the mean: texels lie elsewhere, and a single T is one of theirs",
)
def finer(bench: Bench) -> Iterator[Finding]:
    """Optical depth does not depend on the map's resolution."""
    points, offsets = tangle(6, 80)
    scene = _seen_from_above(points, offsets)
    asked = bench.random(4).uniform(-6, 6, (4000, 3))
    for way in bench.ways():
        coarse = bench.T(way, scene, asked, 64)
        for size in (128, 256):
            yield _mean(way, bench.T(way, scene, asked, size), coarse)


@case(
    "metamorphic",
    input="each segment of strands cut in two, four",
    right="T as before",
    tolerance=1e-5,
)
def subdivided(bench: Bench) -> Iterator[Finding]:
    """tau is additive in the part of a column that a segment spans; behind all casters, so that
    where in a column its depth is taken does not matter.
    """
    points, offsets = tangle(6, 80)
    right = _seen_from_above(points, offsets)
    strands = points.reshape(80, -1, 3)
    asked = bench.random(5).uniform((-6, -6, -99), (6, 6, -99), (1500, 3))
    others = []
    for parts in (2, 4):
        mix = np.arange(parts)[:, None] / parts
        cut = strands[:, :-1, None] * (1 - mix) + strands[:, 1:, None] * mix
        whole = np.concatenate([cut.reshape(80, -1, 3), strands[:, -1:]], axis=1)
        count = whole.shape[1]
        scene = _seen_from_above(whole.reshape(-1, 3).copy(), np.arange(81) * count)
        others.append((scene, asked))
    yield from _alike(bench, right, asked, others)


@case(
    "metamorphic",
    input="strands, widths and questions 1e-3, .1, 10, 1e3 times as large",
    right="T as before",
    tolerance=1e-5,
)
def scaled(bench: Bench) -> Iterator[Finding]:
    """T has no unit. Scales are powers of ten, so that each coordinate is rounded anew."""
    points, offsets = tangle(6, 80)
    asked = bench.random(6).uniform(-6, 6, (1500, 3))
    others = [(_seen_from_above(points, offsets, s), s * asked) for s in (1e-3, 0.1, 10.0, 1e3)]
    right = _seen_from_above(points, offsets)
    yield from _alike(bench, right, asked, others)


@case(
    "metamorphic",
    input="strands moved, turned and scaled by a transform; a copy of their points where these lie",
    right="the same T",
    tolerance=1e-4,
)
def instanced(bench: Bench) -> Iterator[Finding]:
    """A transform moves a shadow as moved points would."""
    strands = hair(4, strands=30)
    moved, turned_too = np.eye(4), np.eye(4)
    moved[:3, 3] = turned_too[:3, 3] = (3.0, -2.0, 1.0)
    turned_too[:3, :3] = 1.5 * np.linalg.qr(bench.random(8).normal(size=(3, 3)))[0]
    asked = bench.random(7).uniform(-6, 6, (800, 3))
    # A light at a place is fitted to the boxes of shapes, which do not turn with them.
    for light, matrix, scale in (
        (slanted(), turned_too, 1.5),
        (PointLight((4.0, 3.0, 30.0)), moved, 1.0),
    ):
        points = np.ascontiguousarray(strands.points @ matrix[:3, :3].T + matrix[:3, 3])
        copy = Strands(points, strands.offsets, width=0.3 * scale, opacity=0.4)
        right = Scene(strands, copy, light)
        instance = Scene(strands, strands.instance(matrix), light)
        yield from _alike(bench, right, asked, [(instance, asked)])
