"""What a map costs by the way in which casters get into it: `deposit` blend and scatter.

    python benchmarks/deposit_ways.py [--scene demo:hair] [--map-size 512] > table.md

Prints the tables of docs/performance.md: time of the passes of bounding opacity maps, every pass
anew, scatter over blend; of the bounds over two blended passes. `pyopacity bench --only P3,P4`
measures the goals among them.
"""

from __future__ import annotations

import argparse
from contextlib import ExitStack
from typing import Any

import pyopacity as po
from pyopacity.benchmark.clock import WHOLE, Clock, Turns, all_maps

MAPS, LIGHT = "bounding_opacity_maps", (0.5, 0.3, -0.8)
LAYERS = (4, 8, 16, 32)
BLEND, SCATTER, TWO_PASSES = "blend", "scatter", "two passes"
INTERPOLATIONS = ("linear", "mean_depth")


def ways(layers: int, interpolation: str) -> dict[str, dict[str, Any]]:
    """Parameters of what takes turns; a split that is given needs no search."""
    common = {"layers": layers, "split": "hybrid", "interpolation": interpolation}
    return {
        BLEND: {"deposit": "blend", **common},
        SCATTER: {"deposit": "scatter", **common},
        # For its bounds: one layer, so that turns are short.
        TWO_PASSES: {**common, "deposit": "blend", "bounds": "depth_func", "layers": 1},
    }


def measured(
    scene: po.Scene, map_size: int, rounds: int, parameters: dict[str, dict[str, Any]]
) -> Turns:
    """Seconds of each pass, by way."""
    with ExitStack() as stack:
        works = {}
        for way, given in parameters.items():
            technique = po.technique(MAPS, **given)
            renderer = stack.enter_context(
                po.Renderer(scene, technique=technique, map_size=map_size)
            )
            works[way] = all_maps(renderer)
        return Clock(rounds=rounds, least=rounds).in_turns(works)


def milliseconds(turns: Turns, way: str) -> dict[str, float]:
    """Of the bounds and of the layers."""
    spent = {"bounds": 0.0, "layers": 0.0}
    for name in turns.parts(way):
        if name != WHOLE and name.startswith(f"{MAPS}/"):
            is_layers = name.removeprefix(f"{MAPS}/").startswith(("opacity", "moments"))
            spent["layers" if is_layers else "bounds"] += 1000.0 * turns.median(way, name)
    return spent


def over(a: float, b: float) -> str:
    return f"{a:.0f} / {b:.0f} = {a / b:.2f}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "--scene", action="append", help="again for more: demo:hair?segments=150000"
    )
    parser.add_argument("--map-size", type=int, action="append", help="again for more")
    parser.add_argument("--layers", type=int, action="append", help="again for more")
    parser.add_argument("--rounds", type=int, default=9)
    arguments = parser.parse_args()
    print("| scene | map | layers | interpolation | bounds | layers, ms | whole map |")
    print("|---|---|---|---|---|---|---|")
    for name in arguments.scene or ["demo:hair?segments=150000"]:
        scene = po.Scene(po.load(name), po.DirectionalLight(LIGHT))
        for map_size in arguments.map_size or [512]:
            for layers in arguments.layers or LAYERS:
                for interpolation in INTERPOLATIONS:
                    given = ways(layers, interpolation)
                    turns = measured(scene, map_size, arguments.rounds, given)
                    blend, scatter, two = (
                        milliseconds(turns, way) for way in (BLEND, SCATTER, TWO_PASSES)
                    )
                    cells = [
                        name,
                        f"{map_size}^2",
                        str(layers),
                        interpolation,
                        over(scatter["bounds"], two["bounds"]),
                        over(scatter["layers"], blend["layers"]),
                        over(sum(scatter.values()), sum(blend.values())),
                    ]
                    print("|", " | ".join(cells), "|", flush=True)


if __name__ == "__main__":
    main()
