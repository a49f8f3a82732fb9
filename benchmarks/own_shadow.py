"""Own shadow: what strands that stand alone lose of the light to themselves, where truth is T = 1.

    python benchmarks/own_shadow.py > table.md

Prints the table of docs/accuracy.md: mean of 1 - T over the vertices of straight strands in random
directions, which do not shadow each other. Maps are the CPU's.
"""

from __future__ import annotations

from typing import Any

import numpy as np

import pyopacity as po

MAP_SIZES = (128, 256, 512, 1024, 2048)
OPTICAL_DEPTHS = (0.1, 0.36, 1.2, 2.3)
LIGHT = (0.0, 0.0, -1.0)
TECHNIQUES: dict[str, dict[str, Any]] = {
    "bounding_opacity_maps": {},
    "bounding_opacity_maps, own_correction off": {"own_correction": False},
    "exact": {},
}


def isolated(
    opacity: float, width: float = 0.01, across: int = 12, points: int = 16, seed: int = 0
) -> po.Scene:
    """Straight strands of length 1, in cells of a grid across the light that none of them leaves.

    A map of 128^2 has ten texels a cell; its texel is ten such widths.
    """
    random = np.random.default_rng(seed)
    direction = random.normal(size=(across**2, 1, 3))
    direction /= np.linalg.norm(direction, axis=-1, keepdims=True)
    cell = np.stack(np.meshgrid(np.arange(across), np.arange(across)), axis=-1) * 1.5
    middle = np.append(cell.reshape(-1, 1, 2), np.zeros((across**2, 1, 1)), axis=-1)
    along = np.linspace(-0.5, 0.5, points)[:, None]
    xyz = (middle + direction * along).reshape(-1, 3)
    offsets = np.arange(across**2 + 1) * points
    strands = po.Strands(xyz, offsets, width=width, opacity=opacity)
    return po.Scene(strands, po.DirectionalLight(LIGHT))


def losses(scene: po.Scene, technique: po.Technique, map_size: int) -> np.ndarray:
    """1 - T at every vertex."""
    with po.Renderer(scene, device="cpu", technique=technique, map_size=map_size) as renderer:
        return 1.0 - renderer.transmittance(scene.shapes[0]).astype(np.float64)


def main() -> None:
    print("| technique | optical depth | " + " | ".join(f"{n}^2" for n in MAP_SIZES) + " |")
    print("|---|---|" + "---|" * len(MAP_SIZES))
    for label, parameters in TECHNIQUES.items():
        for depth in OPTICAL_DEPTHS:
            scene = isolated(opacity=-np.expm1(-depth))
            cells = []
            for map_size in MAP_SIZES:
                technique = po.technique(label.partition(",")[0], **parameters)
                lost = losses(scene, technique, map_size)
                cells.append(f"{lost.mean():.4f} ({lost.max():.2f})")
            print(f"| {label} | {depth} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
