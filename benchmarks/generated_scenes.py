"""Generated scenes for the benchmarks: strands of every kind of density, the same for one seed."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

import pyopacity as po

Array = npt.NDArray[np.float64]

ABOVE = (0.15, 0.1, -1.0)
SIDEWAYS = (1.0, 0.3, -0.25)
LIGHTS = {"above": ABOVE, "sideways": SIDEWAYS}


def curves(points: Array, width: float, opacity: float) -> po.Strands:
    """Strands from (S, N, 3) points."""
    strands, count = points.shape[:2]
    offsets = np.arange(strands + 1) * count
    return po.Strands(points.reshape(-1, 3), offsets, width=width, opacity=opacity)


def grass(blades: int = 4000, seed: int = 1) -> po.Strands:
    """Blades that rise from a square of side 2 and bend: dense from sideways, thin from above."""
    random = np.random.default_rng(seed)
    along = np.linspace(0.0, 1.0, 6)[:, None]
    roots = random.uniform((-1, -1, 0), (1, 1, 0.02), (blades, 1, 3))
    rise = random.uniform((-0.08, -0.08, 0.25), (0.08, 0.08, 0.5), (blades, 1, 3))
    bend = random.normal(0.0, (0.12, 0.12, 0.02), (blades, 1, 3))
    return curves(roots + along * rise + along**2 * bend, width=0.012, opacity=0.5)


def tree(leaves: int = 6000, seed: int = 2) -> po.Strands:
    """A crown of leaves in clumps at the ends of branches: groups with gaps between them."""
    random = np.random.default_rng(seed)
    direction = random.normal(0.0, 1.0, (60, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    clumps = (0.0, 0.0, 1.2) + direction * random.uniform(0.3, 0.8, (60, 1))
    centers = clumps[random.integers(0, 60, leaves)] + random.normal(0.0, 0.09, (leaves, 3))
    halves = random.normal(0.0, 0.025, (leaves, 3))
    along = np.array([-1.0, 0.0, 1.0])[None, :, None]
    return curves(centers[:, None] + along * halves[:, None], width=0.03, opacity=0.6)


def scattered(twigs: int = 5000, seed: int = 3) -> po.Strands:
    """Short twigs spread evenly over a cube of side 2: few in each texel."""
    random = np.random.default_rng(seed)
    centers = random.uniform(-1.0, 1.0, (twigs, 1, 3))
    halves = random.normal(0.0, 0.05, (twigs, 1, 3))
    return curves(centers + np.array([-1.0, 0.0, 1.0])[None, :, None] * halves, 0.02, 0.4)


def hair(segments: int = 15000) -> po.Strands:
    """The generated head of hair, with strands as much wider as there are fewer of them."""
    (strands,) = (
        shape
        for shape in po.load(f"demo:hair?segments={segments}")
        if isinstance(shape, po.Strands)
    )
    strands.opacity = 0.3
    strands.width = 0.15
    return strands


GENERATED = {"hair": hair, "grass": grass, "tree": tree, "scattered": scattered}


def lit(strands: po.Strands, direction: tuple[float, float, float]) -> po.Scene:
    """A scene of its own for each light."""
    return po.Scene(strands, po.DirectionalLight(direction=direction))
