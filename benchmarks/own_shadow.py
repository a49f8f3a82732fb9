"""Own shadow: what strands that stand alone lose of the light to themselves, where truth is T = 1.

    python benchmarks/own_shadow.py > table.md

Prints the table of docs/accuracy_tables.md: mean of 1 - T over the vertices of straight strands in
random directions, which do not shadow each other, and the worst vertex. Maps are the CPU's. The
last rows are what rays over two texels lose: from beside a strand, it stands in front of itself.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

import pyopacity as po
from pyopacity.comparison.truth import texel_side

MAP_SIZES = (128, 256, 512, 1024, 2048)
OPTICAL_DEPTHS = (0.1, 0.36, 1.2, 2.3)
WIDTHS = (0.01, 0.05)
RAYS = "rays over two texels"
LIGHT = (0.0, 0.0, -1.0)
TECHNIQUES: dict[str, dict[str, Any]] = {
    "bounding_opacity_maps": {},
    "bounding_opacity_maps, own_correction off": {"own_correction": False},
    "exact": {},
    RAYS: {},
}


def isolated(
    opacity: float, width: float = 0.01, across: int = 12, points: int = 16, seed: int = 0
) -> po.Scene:
    """Straight strands of length 1, in cells of a grid across the light that none of them leaves.

    A map of 128^2 has ten texels a cell, so that a texel is .14 wide.
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


def losses(scene: po.Scene, technique: po.Technique, map_size: int) -> npt.NDArray[np.float64]:
    """1 - T at every vertex."""
    with po.Renderer(scene, device="cpu", technique=technique, map_size=map_size) as renderer:
        return 1.0 - renderer.transmittance(scene.shapes[0]).astype(np.float64)


def losses_of_rays(scene: po.Scene, map_size: int) -> npt.NDArray[np.float64]:
    """1 - T at every vertex, over a square of two texels of such a map."""
    with po.Renderer(scene, device="cpu", technique="unshadowed", map_size=map_size) as renderer:
        renderer.transmittance(scene.shapes[0])
        side = 2.0 * texel_side(renderer)
    return 1.0 - po.trace_transmittance(scene, scene.shapes[0], 0, side, 64).astype(np.float64)


def cell(lost: npt.NDArray[np.float64]) -> str:
    return f"{lost.mean():.4f} ({lost.max():.2f})"


def main() -> None:
    print("| technique | width | optical depth | " + " | ".join(f"{n}^2" for n in MAP_SIZES) + " |")
    print("|---|---|---|" + "---|" * len(MAP_SIZES))
    for label, parameters in TECHNIQUES.items():
        for width in WIDTHS:
            for depth in OPTICAL_DEPTHS:
                scene = isolated(-np.expm1(-depth), width)
                cells = []
                for size in MAP_SIZES:
                    if label == RAYS:
                        cells.append(cell(losses_of_rays(scene, size)))
                        continue
                    technique = po.technique(label.partition(",")[0], **parameters)
                    cells.append(cell(losses(scene, technique, size)))
                print(f"| {label} | {width} | {depth} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
