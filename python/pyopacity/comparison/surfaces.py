"""Rays from the surface about a point, not from a square across the light.

Half of that square lies behind a surface which leans away from the light, and would find it dark.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

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
    footprint: float,
    samples: int,
    progress: Callable[[float], object],
) -> F32:
    """The mean of T, (N,) float32, over what a square across the light cuts out of each tangent.

    Args:
        scene: with one light.
        points, normals: (N, 3), world space; normals of any length but 0.
        bias: (N,), world units; at least a fifth of the footprint is taken.
        footprint: side of the square, above 0.
        samples: rays for each point.
        progress: called with the part that is done.
    """
    means = np.empty(len(points), np.float32)
    step = max(1, _MOST_RAYS_AT_ONCE // samples)
    for first in range(0, len(points), step):
        part = slice(first, first + step)
        starts = _starts(scene, points[part], normals[part], footprint, samples, first)
        biases = np.repeat(np.maximum(bias[part], _LEAST_BIAS * footprint), samples)
        T = trace_transmittance(scene, starts, 0, 0.0, 1, bias=biases)
        means[part] = T.reshape(-1, samples).mean(axis=1, dtype=np.float64)
        progress(min(1.0, (first + step) / len(points)))
    return means


def _starts(
    scene: Scene, points: F64, normals: F64, footprint: float, samples: int, first: int
) -> F64:
    """(N samples, 3): where rays start, those of a point beside each other."""
    along = np.array(scene.lights[0].direction, np.float64)
    along /= np.linalg.norm(along)
    x = np.cross(along, np.eye(3)[np.argmin(np.abs(along))])
    x /= np.linalg.norm(x)
    square = (_square(len(points), samples, first) - 0.5) * footprint
    across = square[..., :1] * x + square[..., 1:] * np.cross(along, x)
    # The plane n . p = 0 at x, y lies at the depth -(n . across) / (n . along).
    facing = normals @ along
    facing = np.where(np.abs(facing) > 1e-9, facing, 1e-9)
    depth = -np.einsum("nsi,ni->ns", across, normals) / facing[:, None]
    limit = _MOST_DEPTH * footprint
    starts: F64 = points[:, None] + across + np.clip(depth, -limit, limit)[..., None] * along
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
