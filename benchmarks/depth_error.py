"""Depth error: what layers alone cost, at strand vertices, against the exact lists of the same map.

    python benchmarks/depth_error.py [--map-size 512] > table.md

Prints the table of docs/accuracy.md. Scenes: demo:hair, and where PYOPACITY_DATA (default:
../shared/data beside the checkout) has them straight.hair, and bear.hair on bear_body.obj.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator
from pathlib import Path

import pyopacity as po

LAYERS = (4, 8, 16, 32)
SPLITS = ("linear", "logarithmic", "hybrid", "auto")
LIGHT = (0.5, 0.3, -0.8)
OPACITY = 0.3
DATA = Path(
    os.environ.get("PYOPACITY_DATA", Path(__file__).resolve().parents[2] / "shared" / "data")
)


def scenes(opacity: float = OPACITY) -> Iterator[tuple[str, po.Scene, po.Strands]]:
    """Name, scene and the strands at whose vertices T is compared."""
    files = {
        "demo:hair": ["demo:hair"],
        "straight.hair": [DATA / "hair/straight.hair"],
        "bear.hair on bear_body.obj": [DATA / "hair/bear.hair", DATA / "opaque/bear_body.obj"],
    }
    for name, paths in files.items():
        if not all(str(path).startswith("demo:") or Path(path).exists() for path in paths):
            continue
        scene = po.Scene()
        for path in paths:
            scene.add(po.load(str(path)))
        scene.add(po.DirectionalLight(direction=LIGHT))
        strands = next(shape for shape in scene.shapes if isinstance(shape, po.Strands))
        strands.opacity = opacity
        yield name, scene, strands


def errors(
    scene: po.Scene, strands: po.Strands, map_size: int
) -> dict[tuple[str, int], tuple[float, float]]:
    """(split, layers) -> (RMSE, mean) of T minus that of the exact lists."""
    result = {}
    with po.Renderer(scene, size=(8, 8), technique="exact", map_size=map_size) as r:
        exact = r.transmittance(strands)
        r.technique = po.technique("bounding_opacity_maps")
        for split in SPLITS:
            r.technique.split = split
            for layers in LAYERS:
                r.technique.layers = layers
                found = po.metrics.errors(r.transmittance(strands), exact)
                result[split, layers] = found.rmse, found.bias
    return result


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--map-size", type=int, default=512)
    map_size = parser.parse_args().map_size
    print(f"| scene, {map_size}^2 | split | " + " | ".join(f"{n} layers" for n in LAYERS) + " |")
    print("|---|---|" + "---|" * len(LAYERS))
    for name, scene, strands in scenes():
        table = errors(scene, strands, map_size)
        for split in SPLITS:
            cells = [f"{table[split, n][0]:.4f} ({table[split, n][1]:+.3f})" for n in LAYERS]
            print(f"| {name} | {split} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
