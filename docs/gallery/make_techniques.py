"""Renders four scenes by each technique: python docs/gallery/make_techniques.py [SCENE...]

A sheet of pictures for each scene, in the order of WAYS, three in a row. Only the shadow differs:
pictures are opaque.
"""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import numpy.typing as npt
from make_gallery import FRONT, HERE, LEFT, OPTIONS, Picture, staged

import pyopacity as po

ROW = 3
SIZE = (280, 210)
SCENES = {
    "hair": Picture("demo:hair", FRONT, zoom=1.5),
    "tree": Picture("demo:tree", LEFT, zoom=1.7),
    "grass": Picture("demo:dense_grass?segments=60000", LEFT, zoom=1.5),
    "smoke": Picture("demo:smoke", LEFT, (-0.8, -0.2, -0.6), zoom=1.4),
}
WAYS: dict[str, tuple[str, dict[str, Any]]] = {
    "exact": ("exact", {}),
    "bounding opacity maps, 16 layers": ("bounding_opacity_maps", {}),
    "deep shadow maps": ("deep_shadow_maps", {}),
    "deep opacity maps, 16 layers": ("deep_opacity_maps", {}),
    "deep opacity maps, 3 layers": ("deep_opacity_maps", {"layers": 3}),
    "density clustering, 4 clusters": ("density_clustering", {}),
    "opacity shadow maps, 8 slices": ("opacity_shadow_maps", {"layers": 8}),
    "opacity shadow maps, 64 slices": ("opacity_shadow_maps", {"layers": 64}),
    "shadow map": ("shadow_map", {}),
    "Fourier opacity maps, 7 coefficients": ("fourier_opacity_maps", {}),
    "Fourier opacity maps, 15 between bounds": (
        "fourier_opacity_maps",
        {"coefficients": 15, "bounds": "per_texel"},
    ),
    "moment opacity maps, 4 moments": ("moment_opacity_maps", {}),
    "adaptive opacity maps, 16 layers": ("adaptive_opacity_maps", {}),
    "adaptive opacity maps, 4 layers": ("adaptive_opacity_maps", {"layers": 4}),
    "bounding opacity maps, 4 layers": ("bounding_opacity_maps", {"layers": 4}),
}


def pictures(picture: Picture) -> list[npt.NDArray[np.float32]]:
    """One a way."""
    options = {**OPTIONS, "size": SIZE, "compositing": "opaque", "antialiasing": 2}
    found = []
    with po.Renderer(*staged(picture), **options) as renderer:
        for technique, parameters in WAYS.values():
            renderer.technique = po.technique(technique, **parameters)
            found.append(renderer.render())
    return found


def sheet(parts: list[npt.NDArray[np.float32]]) -> npt.NDArray[np.float32]:
    rows = [np.concatenate(parts[i : i + ROW], axis=1) for i in range(0, len(parts), ROW)]
    return np.concatenate(rows, axis=0)


def main() -> None:
    for name in sys.argv[1:] or SCENES:
        po.save_image(str(HERE / f"techniques_{name}.png"), sheet(pictures(SCENES[name])))
        print(name, flush=True)


if __name__ == "__main__":
    main()
