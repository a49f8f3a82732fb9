"""The thesis's scenes, a tree, grass, dense grass, a scattered tree; and layers of their maps."""

from __future__ import annotations

import numpy as np
from common import Run
from common.scenes import SIDEWAYS, Vector, lit

import pyopacity as po

# Of Crystal Space nothing is left but two models, which are small: these stand in.
SIZES = {
    "tree": ("demo:tree?leaves={}", (30_000, 8_000, 300)),
    "sparse tree": ("demo:sparse_tree?leaves={}", (6_000, 3_000, 300)),
    "grass": ("demo:grass?segments={}", (60_000, 20_000, 1_000)),
    "dense grass": ("demo:dense_grass?segments={}", (250_000, 80_000, 2_000)),
}


# What the thesis calls scattered or of low alpha.
LEAF_OPACITY = 0.3


def thesis_scene(run: Run, name: str, light: Vector = SIDEWAYS, intensity: float = 1.3) -> po.Scene:
    """One of these under a directional light."""
    file, sizes = SIZES[name]
    scene = lit(file.format(run.pick(*sizes)), light, intensity=intensity)
    if name == "sparse tree":
        scene.shapes[0].opacity = LEAF_OPACITY
    return scene


def layers_of(used: po.Renderer) -> np.ndarray:
    """(K, H, W): opacity of each layer and all before it, of the last frame's map."""
    technique = used.technique
    planes = used.read(f"{technique.name}/opacity")  # (targets, H, W, 4)
    optical_depth = np.moveaxis(planes, -1, 1).reshape(-1, *planes.shape[1:3])
    return -np.expm1(-optical_depth[: technique.layers].astype(np.float64))


def new_information(layers: np.ndarray) -> list[float]:
    """Mean absolute difference of each layer and the one before, over covered texels, as a part of
    what the last holds; before the first lies nothing."""
    covered = layers[-1] > 0.0
    means = np.array([layer[covered].mean() for layer in layers])
    return [float(value) for value in np.diff(means, prepend=0.0) / means[-1]]
