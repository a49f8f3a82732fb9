"""Small scenes for the benchmarks: each kind of caster within two units, and each kind of light."""

from __future__ import annotations

import generated_scenes
import numpy as np
import numpy.typing as npt

import pyopacity as po
from pyopacity.shapes.mesh import AlphaMode

BELOW = (0.0, 0.0, -1.6)  # where a ground lies

LIGHTS = {
    "directional": po.DirectionalLight((0.3, 0.2, -1.0)),
    "point": po.PointLight((2.0, 1.5, 4.0)),
    "spot": po.SpotLight((0.0, 0.5, 4.0), (0.0, -0.1, -1.0), 70.0),
    "point inside": po.PointLight((0.1, 0.05, 0.0)),
    "area": po.AreaLight((0.0, 0.0, 4.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), 3),
}


def strands() -> po.Strands:
    return generated_scenes.scattered(2000)


def leaf_alpha(side: int = 64) -> npt.NDArray[np.float32]:
    """A disc that fades over half of its radius; of a mask, what is at least half there."""
    x = np.linspace(-1.0, 1.0, side)
    radius = np.hypot(x[:, None], x[None, :])
    return np.clip(2.0 - 2.0 * radius, 0.0, 1.0).astype(np.float32)


def leaves(mode: AlphaMode, count: int = 400, seed: int = 4) -> po.Mesh:
    """Squares turned at random, each with the same picture."""
    random = np.random.default_rng(seed)
    centers = random.uniform(-1.0, 1.0, (count, 1, 3))
    axes = np.linalg.qr(random.normal(size=(count, 3, 3)))[0]
    uvs = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], np.float64)
    corners = centers + 0.3 * (uvs - 0.5) @ axes[:, :2]
    first = 4 * np.arange(count).reshape(-1, 1)
    return po.Mesh(
        corners.reshape(-1, 3),
        (first + np.array([0, 1, 2, 0, 2, 3])).reshape(-1, 3),
        uvs=np.tile(uvs, (count, 1)),
        alpha_map=leaf_alpha(),
        alpha_mode=mode,
    )


def particles(count: int = 800, seed: int = 5) -> po.Particles:
    random = np.random.default_rng(seed)
    centers = random.uniform(-1.0, 1.0, (count, 3))
    return po.Particles(centers, random.uniform(0.05, 0.12, count), opacity=0.4)


def voxels(side: int = 24, seed: int = 6) -> po.Volume:
    """A ball with holes."""
    random = np.random.default_rng(seed)
    x = np.linspace(-1.0, 1.0, side)
    z, y, x = np.meshgrid(x, x, x, indexing="ij")
    inside = np.sqrt(x**2 + y**2 + z**2) < 1.0
    extinction = inside * np.maximum(random.uniform(-1.0, 3.0, inside.shape), 0.0)
    return po.Volume(extinction, origin=(-1.0, -1.0, -1.0), spacing=2.0 / (side - 1))


CASTERS = {
    "strands": strands,
    "mask leaves": lambda: leaves("mask"),
    "blend leaves": lambda: leaves("blend"),
    "particles": particles,
    "voxels": voxels,
}
