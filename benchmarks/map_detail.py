"""Fewer, wider strands in maps: what they add to T, and what they save.

    python benchmarks/map_detail.py [--table errors] [--table auto] [--table time] > tables.md

Prints the tables of docs/accuracy.md and docs/performance.md. Errors are those of maps of the CPU,
16 layers; times too, unless there is OpenGL (--device gpu).
"""

from __future__ import annotations

import argparse
import statistics
import time
from typing import Any

import error_models
import numpy as np
from error_models import Bench

import pyopacity as po

MODELS = ("demo:hair", "grass", "straight.hair", "bear.hair")
MAP_SIZES = (128, 256, 512, 1024)
DETAILS = (1.0, 0.5, 0.25, 0.125)
TECHNIQUES: dict[str, dict[str, Any]] = {
    "exact": {},
    "bounding_opacity_maps": {"layers": 16, "split": "hybrid"},
}
SEGMENTS = (150_000, 1_050_000)
ROUNDS = 5


def rms(difference: Any) -> float:
    return float(np.sqrt(np.mean(np.square(difference, dtype=np.float64))))


def found(bench: Bench, technique: str, size: int, detail: float | str) -> Any:
    made = po.technique(technique, **TECHNIQUES[technique])
    bench.renderer.map_size, bench.renderer.technique = size, made
    bench.renderer.map_detail = detail
    return bench.receivers.transmittance(bench.renderer)


def print_errors() -> None:
    """By detail: what is added to the exact lists of all strands; total error; depth error."""
    heads = [f"{detail:g}" for detail in DETAILS]
    print("| model | map |", " | ".join(f"added, {d}" for d in heads[1:]), end=" | ")
    print(" | ".join(f"total, {d}" for d in heads), end=" | ")
    print(" | ".join(f"depth, {d}" for d in heads), "|")
    print("|---" * (1 + len(DETAILS) * 3) + "|---|")
    for model in error_models.models(MODELS):
        bench = Bench(model)
        for size in MAP_SIZES:
            truth = bench.truth(2.0 * bench.texel(size))
            exact = [found(bench, "exact", size, d) for d in DETAILS]
            layered = [found(bench, "bounding_opacity_maps", size, d) for d in DETAILS]
            added = [f"{rms(t - exact[0]):.3f}" for t in exact[1:]]
            total = [f"{rms(t - truth):.3f} ({np.mean(t - truth):+.3f})" for t in exact]
            depth = [f"{rms(a - b):.3f}" for a, b in zip(layered, exact, strict=True)]
            print(
                "|", " | ".join([model.name, f"{size}^2", *added, *total, *depth]), "|", flush=True
            )


def fine_hair() -> po.Scene:
    """Seven times as many strands as demo:hair has, a third as wide."""
    hair = po.load("demo:hair?segments=1050000")[0]
    assert isinstance(hair, po.Strands)
    hair.width = hair.width * np.float32(1.0 / 3.0)
    return po.Scene(hair, po.DirectionalLight((0.5, 0.3, -0.8)))


def print_auto() -> None:
    """What "auto" takes, and what it adds."""
    print("| model | map | 1 of n strands | added |\n|---|---|---|---|")
    chosen = [(model.name, model.scene) for model in error_models.models(MODELS)]
    chosen.append(("demo:hair, 1,050,000 segments", scene_of(1_050_000)))
    chosen.append(("the same, a third as wide", fine_hair()))
    for name, scene in chosen:
        bench = Bench(error_models.Model(name, scene))
        for size in MAP_SIZES:
            difference = found(bench, "exact", size, "auto") - found(bench, "exact", size, 1.0)
            found(bench, "exact", size, "auto")
            note = next(row.note for row in bench.renderer.report if row.name == "map_detail")
            n = note.split()[2] if note.startswith("1 of") else "1"
            print(f"| {name} | {size}^2 | {n} | {rms(difference):.4f} |", flush=True)


def scene_of(segments: int) -> po.Scene:
    shapes = po.load(f"demo:hair?segments={segments}")
    return po.Scene(shapes, po.DirectionalLight((0.5, 0.3, -0.8)))


def print_times(device: Any) -> None:
    """All passes of the maps anew, but those of the look-up, over the same with all strands."""
    at = np.zeros((1, 3))
    print("| segments | technique |", " | ".join(f"{d:g}" for d in DETAILS), "|")
    print("|---|---" + "|---" * len(DETAILS) + "|")
    for segments in SEGMENTS:
        scene = scene_of(segments)
        for name, parameters in TECHNIQUES.items():
            renderers = [
                po.Renderer(
                    scene,
                    size=(8, 8),
                    technique=po.technique(name, **parameters),
                    map_detail=detail,
                    device=device,
                )
                for detail in DETAILS
            ]
            times: list[list[float]] = [[] for _ in renderers]
            for turn in range(ROUNDS + 1):
                for renderer, row in zip(renderers, times, strict=True):
                    renderer.invalidate()
                    begin = time.perf_counter()
                    renderer.transmittance(at)
                    if turn:
                        row.append(time.perf_counter() - begin)
            medians = [statistics.median(row) for row in times]
            cells = [f"{1e3 * medians[0]:.0f} ms", *(f"{t / medians[0]:.2f}" for t in medians[1:])]
            print(f"| {segments:,} | `{name}` |", " | ".join(cells), "|", flush=True)
            for renderer in renderers:
                renderer.close()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--table", action="append", choices=("errors", "auto", "time"))
    parser.add_argument("--device", choices=("cpu", "gpu"), default="cpu")
    arguments = parser.parse_args()
    tables = arguments.table or ["errors", "auto", "time"]
    if "errors" in tables:
        print_errors()
    if "auto" in tables:
        print_auto()
    if "time" in tables:
        print_times(arguments.device)


if __name__ == "__main__":
    main()
