"""What a map costs by the way in which casters get into it: `deposit` blend and scatter.

    python benchmarks/deposit_ways.py [--scene demo:hair] [--map-size 512] > table.md

Prints the tables of docs/performance.md: time of the passes of bounding opacity maps, every pass
anew, scatter over blend; of the bounds over two blended passes. Ways take turns, so that what slows
the machine down slows all of them; figures are medians.
"""

from __future__ import annotations

import argparse
import statistics
from collections import defaultdict
from typing import Any

import numpy as np

import pyopacity as po

MAPS, LIGHT = "bounding_opacity_maps", (0.5, 0.3, -0.8)
LAYERS = (4, 8, 16, 32)
BLEND, SCATTER, TWO_PASSES = "blend", "scatter", "two passes"
INTERPOLATIONS = ("linear", "mean_depth")
WARM_UP = 1
ANY_POINT = np.zeros((1, 3), np.float32)


def ways(layers: int, interpolation: str) -> dict[str, dict[str, Any]]:
    """Parameters of what takes turns; a split that is given needs no search."""
    common = {"layers": layers, "split": "hybrid", "interpolation": interpolation}
    return {
        BLEND: {"deposit": "blend", **common},
        SCATTER: {"deposit": "scatter", **common},
        # For its bounds: one layer, so that turns are short.
        TWO_PASSES: {**common, "deposit": "blend", "bounds": "depth_func", "layers": 1},
    }


def part_of(name: str) -> str:
    """Of a pass: the bounds or the layers."""
    return "layers" if name.startswith(("opacity", "moments")) else "bounds"


def measured(
    scene: po.Scene, map_size: int, frames: int, parameters: dict[str, dict[str, Any]]
) -> dict[str, dict[str, float]]:
    """Medians of milliseconds, by way and part."""
    renderers = {
        way: po.Renderer(scene, technique=po.technique(MAPS, **given), map_size=map_size)
        for way, given in parameters.items()
    }
    times: dict[str, dict[str, list[float]]] = {way: defaultdict(list) for way in renderers}
    for _ in range(WARM_UP + frames):
        for way, renderer in renderers.items():
            renderer.invalidate()
            renderer.transmittance(ANY_POINT)
            spent: dict[str, float] = defaultdict(float)
            for row in renderer.report:
                if row.name.startswith(f"{MAPS}/"):
                    spent[part_of(row.name.removeprefix(f"{MAPS}/"))] += row.ms
            for part, ms in spent.items():
                times[way][part].append(ms)
    for renderer in renderers.values():
        renderer.close()
    return {
        way: {part: statistics.median(ms[WARM_UP:]) for part, ms in parts.items()}
        for way, parts in times.items()
    }


def over(a: float, b: float) -> str:
    return f"{a:.0f} / {b:.0f} = {a / b:.2f}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "--scene", action="append", help="again for more: demo:hair?segments=150000"
    )
    parser.add_argument("--map-size", type=int, action="append", help="again for more")
    parser.add_argument("--layers", type=int, action="append", help="again for more")
    parser.add_argument("--frames", type=int, default=9)
    arguments = parser.parse_args()
    print("| scene | map | layers | interpolation | bounds | layers, ms | whole map |")
    print("|---|---|---|---|---|---|---|")
    for name in arguments.scene or ["demo:hair?segments=150000"]:
        scene = po.Scene(po.load(name), po.DirectionalLight(LIGHT))
        for map_size in arguments.map_size or [512]:
            for layers in arguments.layers or LAYERS:
                for interpolation in INTERPOLATIONS:
                    table = measured(scene, map_size, arguments.frames, ways(layers, interpolation))
                    blend, scatter = table[BLEND], table[SCATTER]
                    cells = [
                        name,
                        f"{map_size}^2",
                        str(layers),
                        interpolation,
                        over(scatter["bounds"], table[TWO_PASSES]["bounds"]),
                        over(scatter["layers"], blend["layers"]),
                        over(sum(scatter.values()), sum(blend.values())),
                    ]
                    print("|", " | ".join(cells), "|", flush=True)


if __name__ == "__main__":
    main()
