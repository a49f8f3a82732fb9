"""Rays from the surface about a point, not from a square across the light.

Half of that square lies behind a surface which leans away from the light, and would find it dark.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from pyopacity.light import DirectionalLight, Light, PositionalLight
from pyopacity.scene import Scene
from pyopacity.trace import trace_transmittance

F32 = npt.NDArray[np.float32]
F64 = npt.NDArray[np.float64]

# In footprints: how far the tangent plane is followed toward the light where it is nearly parallel
# to it, as far as a map moves a surface (docs/accuracy.md: eight texels).
_MOST_DEPTH = 4.0
# In footprints: what a curved surface lies in front of its own tangent plane.
_LEAST_BIAS = 0.2
_MOST_RAYS_AT_ONCE = 1 << 20


def trace_on_surfaces(
    scene: Scene,
    points: F64,
    normals: F64,
    bias: F64,
    footprint: float | F64,
    samples: int,
    progress: Callable[[float], object],
    light: int = 0,
) -> F32:
    """The mean of T over what a square across the light cuts out of each tangent.

    Args:
        scene: with lights.
        points, normals: (N, 3), world space; normals of any length but 0.
        bias: (N,), world units; at least a fifth of the footprint is taken.
        footprint: side of the square, above 0; one for all, or (N,).
        samples: rays for each point.
        progress: called with the part that is done.
        light: index into the scene's lights.

    Returns:
        (N,) float32; (N, 3) of a tinted scene.
    """
    means = []
    sides = np.broadcast_to(np.asarray(footprint, np.float64), len(points))
    along = _directions(scene.lights[light], points)
    step = max(1, _MOST_RAYS_AT_ONCE // samples)
    for first in range(0, len(points), step):
        part = slice(first, first + step)
        square = (_square(len(points[part]), samples, first) - 0.5) * sides[part, None, None]
        starts = _starts(points[part], normals[part], along[part], square, sides[part])
        biases = np.repeat(np.maximum(bias[part], _LEAST_BIAS * sides[part]), samples)
        T = trace_transmittance(scene, starts, light, 0.0, 1, bias=biases)
        samples_of = T.reshape(-1, samples, *T.shape[1:])
        means.append(samples_of.mean(axis=1, dtype=np.float64).astype(np.float32))
        progress(min(1.0, (first + step) / len(points)))
    return np.concatenate(means)


def _directions(light: Light, points: F64) -> F64:
    """(N, 3), of length 1: in which light arrives at points, from an area's middle."""
    if isinstance(light, DirectionalLight):
        along = np.tile(np.array(light.direction, np.float64), (len(points), 1))
    else:
        assert isinstance(light, PositionalLight)
        along = points - np.array(light.position, np.float64)
    length = np.linalg.norm(along, axis=1, keepdims=True)
    unit: F64 = np.where(length > 0.0, along / np.where(length > 0.0, length, 1.0), (0.0, 0.0, 1.0))
    return unit


def _starts(points: F64, normals: F64, along: F64, square: F64, sides: F64) -> F64:
    """(N samples, 3): where rays start, those of a point beside each other."""
    x = np.cross(along, np.eye(3)[np.argmin(np.abs(along), axis=1)])
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    y = np.cross(along, x)
    across = square[..., :1] * x[:, None] + square[..., 1:] * y[:, None]
    # The plane n . p = 0 at x, y lies at the depth -(n . across) / (n . along).
    facing = np.einsum("ni,ni->n", normals, along)
    facing = np.where(np.abs(facing) > 1e-9, facing, 1e-9)
    depth = -np.einsum("nsi,ni->ns", across, normals) / facing[:, None]
    limit = _MOST_DEPTH * sides[:, None]
    clipped = np.clip(depth, -limit, limit)[..., None] * along[:, None]
    starts: F64 = points[:, None] + across + clipped
    return starts.reshape(-1, 3)


def _square(count: int, samples: int, first: int) -> F64:
    """(count, samples, 2) in [0, 1): Hammersley's points, moved around at random for each point."""
    bits = np.arange(samples, dtype=np.uint32)
    reversed_bits = np.zeros(samples, np.uint32)
    for bit in range(32):
        reversed_bits |= ((bits >> np.uint32(bit)) & np.uint32(1)) << np.uint32(31 - bit)
    pattern = np.stack([bits / samples, reversed_bits / 2.0**32], axis=-1)
    moved = np.random.default_rng(first).uniform(size=(count, 1, 2))
    square: F64 = (pattern + moved) % 1.0
    return square
