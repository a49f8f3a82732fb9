"""A split ratio for each texel, or each region, against the best and the searched one for all.

    python benchmarks/local_splits.py [--map-size 256] [--device cpu|gpu] > table.md

Prints the table of docs/accuracy_tables.md. Depth error: RMSE of T at all vertices of everything in
the scene, against the exact lists of the same map. Scenes: generated ones, and those of
PYOPACITY_DATA where it has them.
"""

from __future__ import annotations

import argparse
import os
import pathlib
from collections.abc import Iterator
from typing import Any

import numpy as np

import pyopacity as po

MAPS = "bounding_opacity_maps"
LIGHT = (0.5, 0.3, -0.8)
LAYERS = (8, 16)
RATIOS = tuple(tenth / 10 for tenth in range(11))
DATA = pathlib.Path(
    os.environ.get("PYOPACITY_DATA", pathlib.Path(__file__).resolve().parents[1] / "../shared/data")
)
GENERATED = (
    "demo:mixed",
    "demo:hair?segments=60000",
    "demo:tree?leaves=5000",
    "demo:grass?segments=20000",
    "demo:smoke",
)
REAL = ("hair/straight.hair", "hair/bear.hair")


def scenes() -> Iterator[tuple[str, po.Scene]]:
    """Name and scene; the hair with a width and an opacity, since its files have none."""
    for name in GENERATED:
        yield name, po.Scene(po.load(name), po.DirectionalLight(LIGHT))
    for name in REAL:
        if not (DATA / name).exists():
            continue
        scene = po.Scene(po.load(str(DATA / name)), po.DirectionalLight(LIGHT))
        for strands in scene.shapes:
            strands.width, strands.opacity = (0.15 if "bear" in name else 0.1), 0.3
        yield pathlib.Path(name).name, scene


class Errors:
    """Depth errors of one scene."""

    def __init__(self, scene: po.Scene, map_size: int, device: str) -> None:
        self._scene, self._map_size, self._device = scene, map_size, device
        self._exact = self._ask("exact")

    def _ask(self, name: str, **parameters: Any) -> np.ndarray:
        with po.Renderer(
            self._scene,
            technique=po.technique(name, **parameters),
            map_size=self._map_size,
            device=self._device,
            size=(8, 8),
        ) as renderer:
            receiving = [shape for shape in self._scene.shapes if shape.receives]
            return np.concatenate([renderer.transmittance(shape) for shape in receiving])

    def of(self, **parameters: Any) -> float:
        difference = self._ask(MAPS, **parameters).astype(np.float64) - self._exact
        return float(np.sqrt(np.mean(difference**2)))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--map-size", type=int, default=256)
    parser.add_argument("--device", default="cpu", choices=("cpu", "gpu"))
    arguments = parser.parse_args()
    splits = ("auto", "per_region", "per_texel")
    print(f"| scene, {arguments.map_size}^2 | layers | best ratio | " + " | ".join(splits) + " |")
    print("|---|---|---|---|---|---|")
    for name, scene in scenes():
        errors = Errors(scene, arguments.map_size, arguments.device)
        for layers in LAYERS:
            found = {
                ratio: errors.of(layers=layers, split="hybrid", split_ratio=ratio)
                for ratio in RATIOS
            }
            best = min(found, key=found.__getitem__)
            cells = []
            for split in splits:
                error = errors.of(layers=layers, split=split)
                cells.append(f"{error:.4f} ({100 * (error / found[best] - 1):+.0f} %)")
            row = f"| {name} | {layers} | {found[best]:.4f} at {best} | "
            print(row + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
