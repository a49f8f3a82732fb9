"""Split search: what the picked ratio costs, at strand vertices, against the best of eleven.

    python benchmarks/split_search.py [--map-size 256] [--frames 1] > table.md

Prints the table of docs/accuracy_tables.md. Depth error: RMSE of T against the exact lists of the
same map. Scenes: those of generated_scenes.py, and straight.hair where PYOPACITY_DATA has it.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator

import depth_error
import generated_scenes as scenes
import numpy as np

import pyopacity as po

LAYERS = (4, 8, 16, 32)
RATIOS = tuple(tenth / 10 for tenth in range(11))
SIMILARITIES = (
    "error",
    "absolute_difference",
    "correlation",
    "paper_absolute_difference",
    "paper_correlation",
)
MAPS = "bounding_opacity_maps"


def shapes() -> Iterator[tuple[str, po.Strands]]:
    for name, generate in scenes.GENERATED.items():
        yield name, generate()
    for name, _, strands in depth_error.scenes():
        if name == "straight.hair":
            yield name, strands


def picked(renderer: po.Renderer, strands: po.Strands, similarity: str) -> float:
    """The ratio that a search finds, as the report tells it."""
    technique = renderer.technique
    technique.split, technique.similarity = "auto", similarity
    for _ in range(technique.search_frames):
        renderer.transmittance(strands)
    note = next(row.note for row in renderer.report if row.name == f"{MAPS}/split_search")
    return float(note.rpartition(" ")[2])


def errors(renderer: po.Renderer, strands: po.Strands, exact: np.ndarray) -> dict[float, float]:
    """Ratio -> depth error."""
    technique = renderer.technique
    technique.split = "hybrid"
    found = {}
    for ratio in RATIOS:
        technique.split_ratio = ratio
        difference = renderer.transmittance(strands) - exact
        found[ratio] = float(np.sqrt(np.mean(difference**2)))
    return found


def study(
    strands: po.Strands,
    direction: tuple[float, float, float],
    map_size: int,
    layers: tuple[int, ...] = LAYERS,
    similarities: tuple[str, ...] = SIMILARITIES,
    frames: int = 1,
) -> Iterator[tuple[int, dict[float, float], dict[str, float]]]:
    """For each number of layers: ratio -> depth error, and similarity -> the ratio it picks."""
    scene = scenes.lit(strands, direction)
    with po.Renderer(scene, size=(8, 8), technique="exact", map_size=map_size) as renderer:
        exact = renderer.transmittance(strands).astype(np.float64)
        renderer.technique = po.technique(MAPS, search_frames=frames)
        for count in layers:
            renderer.technique.layers = count
            found = errors(renderer, strands, exact)
            yield count, found, {name: picked(renderer, strands, name) for name in similarities}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--map-size", type=int, default=256)
    parser.add_argument("--frames", type=int, default=1, choices=(1, 11))
    arguments = parser.parse_args()
    title = f"scene, {arguments.map_size}^2 | light | layers | best"
    print(f"| {title} | " + " | ".join(SIMILARITIES) + " |")
    print("|---|---|---|---|" + "---|" * len(SIMILARITIES))
    worst = dict.fromkeys(SIMILARITIES, 0.0)
    for name, strands in shapes():
        for light, direction in scenes.LIGHTS.items():
            rows = study(strands, direction, arguments.map_size, frames=arguments.frames)
            for count, found, picks in rows:
                best = min(found, key=found.__getitem__)
                cells = [f"{found[best]:.4f} at {best}"]
                for similarity, ratio in picks.items():
                    excess = found[ratio] / found[best] - 1.0
                    worst[similarity] = max(worst[similarity], excess)
                    cells.append(f"{found[ratio]:.4f} at {ratio} (+{100 * excess:.0f} %)")
                print(f"| {name} | {light} | {count} | " + " | ".join(cells) + " |", flush=True)
    cells = [f"+{100 * worst[similarity]:.0f} %" for similarity in SIMILARITIES]
    print("| worst | | | | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
