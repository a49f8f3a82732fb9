"""Deep opacity maps whose layers end too early or too late, beside bounding ones: 5.4 and 5.5."""

from __future__ import annotations

import numpy as np
from common.scenes import published

import pyopacity as po

DEEP, BOUNDING, LAYERS = "deep opacity maps", "bounding opacity maps", 16


def range_of_depths(used: po.Renderer) -> float:
    """World units along the light that its map holds, as the last frame fitted it."""
    return float(1.0 / np.linalg.norm(used.light_from_world[2, :3]))


def techniques(deep_extent: float) -> dict[str, po.Technique]:
    """As published, evenly split; the deep ones end at a distance that is the same everywhere."""
    return {
        DEEP: published(
            "deep_opacity_maps", layers=LAYERS, layer_sizes="constant", layer_extent=deep_extent
        ),
        BOUNDING: published("bounding_opacity_maps", layers=LAYERS, split_ratio=0.0),
    }


def place_in_layers(used: po.Renderer, points: np.ndarray, deep_extent: float) -> np.ndarray:
    """Of world points, 0 at the first layer's begin to 1 at the last one's end."""
    name = used.technique.name
    at = points @ used.light_from_world[:3, :3].T + used.light_from_world[:3, 3]
    start = used.read(f"{name}/start")
    x, y = (np.clip(at[:, i].astype(int), 0, start.shape[0] - 1) for i in (0, 1))
    first = start[y, x]
    if name == "bounding_opacity_maps":
        extent = used.read(f"{name}/end")[y, x] - first
    else:
        extent = np.full(len(points), deep_extent / range_of_depths(used))
    return (at[:, 2] - first) / np.maximum(extent, 1e-9)
