"""Shapes that many cases share; z points toward the light, unless a case says otherwise."""

from __future__ import annotations

from typing import Literal

import numpy as np
import numpy.typing as npt

from pyopacity.light import DirectionalLight
from pyopacity.shapes import Mesh, Particles, Shape, Strands, Volume

F64 = npt.NDArray[np.float64]

_SQUARE = np.array([(-1.0, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)])
_TWO_TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]])
# In no symmetry of a map, nor on an edge of a triangle.
ASIDE = (0.31, 0.17)


def down() -> DirectionalLight:
    """Light from above."""
    return DirectionalLight((0.0, 0.0, -1.0))


def slanted() -> DirectionalLight:
    """Light along no axis."""
    return DirectionalLight((0.5, 0.3, -0.8))


def opacity_of(optical_depth: float) -> float:
    """What lets exp(-tau) through."""
    return float(-np.expm1(-optical_depth))


def sheet(
    height: float = 0.0, opacity: float = 0.5, half: float = 1.0, x: float = 0.0, y: float = 0.0
) -> Mesh:
    """A square across the light."""
    return Mesh(_SQUARE * half + (x, y, height), _TWO_TRIANGLES, opacity=opacity)


def stack(heights: npt.ArrayLike, opacity: float, half: float = 1.0, x: float = 0.0) -> Mesh:
    """Squares across the light, one at each height, in one shape."""
    z = np.asarray(heights, np.float64)
    corners = (_SQUARE * half + (x, 0, 0))[None] + z[:, None, None] * np.array([0.0, 0.0, 1.0])
    first = 4 * np.arange(len(z))[:, None, None]
    return Mesh(corners.reshape(-1, 3), (first + _TWO_TRIANGLES).reshape(-1, 3), opacity=opacity)


def column(heights: npt.ArrayLike, x: float = ASIDE[0], y: float = ASIDE[1]) -> F64:
    """Points one below the other."""
    z = np.atleast_1d(np.asarray(heights, np.float64))
    return np.stack([np.full_like(z, x), np.full_like(z, y), z], axis=1)


def ribbons(count: int, opacity: float, half: float = 1.0, depth: float = 1.0) -> Strands:
    """Squares as strands, one behind the other: whole texels, a fragment of each in each."""
    ends = np.zeros((count, 2, 3))
    ends[:, 0, 0], ends[:, 1, 0] = -half, half
    ends[:, :, 2] = -depth * (np.arange(count) / max(count - 1, 1))[:, None]
    return Strands(ends.reshape(-1, 3), 2 * np.arange(count + 1), width=2.0 * half, opacity=opacity)


def tangle(
    seed: int = 1, strands: int = 40, points: int = 8, step: float = 1.0
) -> tuple[F64, npt.NDArray[np.int64]]:
    """Random walks in a ball of radius 10 or so; (points, offsets)."""
    random = np.random.default_rng(seed)
    starts = random.uniform(-6, 6, (strands, 1, 3))
    steps = random.normal(0, step, (strands, points, 3))
    walk = starts + np.cumsum(steps, axis=1)
    return walk.reshape(-1, 3), np.arange(strands + 1) * points


def hair(seed: int = 1, strands: int = 60, width: float = 0.3, opacity: float = 0.4) -> Strands:
    """A tangle as strands."""
    points, offsets = tangle(seed, strands)
    return Strands(points, offsets, width=width, opacity=opacity)


def random_shapes(seed: int) -> list[Shape]:
    """A caster of each kind, about three units across, with changing attributes, each moved."""
    random = np.random.default_rng(seed)
    steps = random.normal(0.0, 0.4, (8, 7, 3))
    steps[0, 3] = 0.0  # a point twice
    xyz = (random.uniform(-1, 1, (8, 1, 3)) + np.cumsum(steps, axis=1)).reshape(-1, 3)
    width, opacity = random.uniform(0.05, 0.5, 56), random.uniform(0.0, 1.0, 56)
    width[3], opacity[3] = width[2], opacity[2]
    strands = Strands(xyz, np.arange(0, 57, 7), width, opacity)
    corners = random.uniform(-1.5, 1.5, (12, 3, 3)).astype(np.float32).reshape(-1, 3)
    veils = Mesh(corners, np.arange(36).reshape(12, 3), opacity=random.uniform(0, 1, 36))
    stone = Mesh(0.4 * corners[:9], np.arange(9).reshape(3, 3))
    dust = Particles(
        random.uniform(-1.2, 1.2, (10, 3)), random.uniform(0.1, 0.6, 10), random.uniform(0, 1, 10)
    )
    balls = Particles(0.8 * dust.points, dust.radius, dust.opacity, profile="metaball")
    density = random.uniform(0.0, 2.0, (5, 3, 4)).astype(np.float32)
    density[random.uniform(size=density.shape) < 0.5] = 0.0
    smoke = Volume(density, (-0.6, -0.4, -0.8), (0.4, 0.5, 0.3))
    shapes: list[Shape] = [strands, veils, stone, dust, smoke, *_leaves(random), balls]
    for shape in shapes:
        matrix = np.eye(4)
        matrix[:3, :3] = np.linalg.qr(random.normal(size=(3, 3)))[0] * random.uniform(0.5, 2.0)
        matrix[:3, 3] = random.uniform(-0.5, 0.5, 3)
        shape.transform = matrix
    return shapes


def _leaves(random: np.random.Generator) -> list[Mesh]:
    """With an alpha map of each mode, which repeats over them."""
    modes: tuple[Literal["mask", "blend"], ...] = ("mask", "blend")
    return [
        Mesh(
            random.uniform(-1.2, 1.2, (12, 3)),
            np.arange(12).reshape(4, 3),
            opacity=random.uniform(0.5, 1, 12),
            uvs=random.uniform(-1.5, 2.5, (12, 2)),
            alpha_map=random.uniform(0, 1, (3, 5)).astype(np.float32),
            alpha_mode=mode,
        )
        for mode in modes
    ]
