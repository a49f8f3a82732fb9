"""Adaptive opacity maps: their errors beside those of the papers' techniques and of bounding maps.

    python benchmarks/adaptive_planes.py [--table published] > tables.md

Prints the tables of docs/accuracy_tables.md, "Adaptive planes". Maps are the CPU's, so no OpenGL is
needed; the hair models are those of PYOPACITY_DATA.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import Any

import error_models
from compare_scenes import SCENES
from depth_error import LIGHT
from error_models import Bench

import pyopacity as po
from pyopacity.benchmark.ways import ADAPTIVE, PAPERS, PUBLISHED_A_LAYER
from pyopacity.comparison import sample_receivers

MODELS = ("straight.hair", "bear.hair")
MAP_SIZE, RECEIVERS, SEED = 512, 20000, 0
LAYERS = (8, 16)
PUBLISHED = {name: way for name, way in PAPERS.items() if not way.takes_coefficients}
OURS: dict[str, tuple[str, dict[str, Any]]] = {
    "`bounding_opacity_maps`": ("bounding_opacity_maps", {}),
    "the same, `per_texel`": ("bounding_opacity_maps", {"split": "per_texel"}),
    "`adaptive_opacity_maps`": (ADAPTIVE, {}),
    "the same, `refine` 0": (ADAPTIVE, {"refine": 0}),
    "the same, `tile` 4": (ADAPTIVE, {"tile": 4}),
}


class DepthErrors:
    """RMSE of T against the exact lists of the same map, at some of a scene's receivers."""

    def __init__(self, scene: po.Scene, map_size: int) -> None:
        self.receivers = sample_receivers(scene, RECEIVERS, SEED)
        self.renderer = po.Renderer(scene, device="cpu", map_size=map_size, technique="exact")
        self.exact = self.receivers.transmittance(self.renderer)

    def of(self, technique: str, **parameters: Any) -> float:
        self.renderer.technique = po.technique(technique, **parameters)
        return po.metrics.rmse(self.receivers.transmittance(self.renderer), self.exact)


def fourier(depth: DepthErrors, coefficients: int) -> float:
    """The better of global bounds, as published, and of each texel's."""
    ways = [{"bounds": bounds} for bounds in ("global", "per_texel")]
    return min(
        depth.of("fourier_opacity_maps", coefficients=coefficients, own_correction=False, **way)
        for way in ways
    )


def print_published(only: list[str] | None) -> None:
    """At equal layers, and at equal bytes a texel."""
    print(f"| model | layers | papers have | {' | '.join(PUBLISHED)} | Fourier | ours | ratio |")
    print("|---" * (6 + len(PUBLISHED)) + "|")
    for model in error_models.models(only or MODELS):
        depth = DepthErrors(model.scene, MAP_SIZE)
        for layers in LAYERS:
            ours = depth.of(ADAPTIVE, layers=layers)
            for factor in (1, PUBLISHED_A_LAYER):
                count = factor * layers
                errors = [
                    depth.of(way.technique, layers=count, **way.parameters)
                    for way in PUBLISHED.values()
                ]
                errors.append(fourier(depth, count - 1))
                cells = " | ".join(f"{e:.4f}" for e in errors)
                ratio = ours / min(errors)
                print(
                    f"| {model.name} | {layers} | {count} | {cells} | {ours:.4f} | {ratio:.2f} |",
                    flush=True,
                )


def print_total(only: list[str] | None) -> None:
    """Against rays over two texels of each map, 16 layers."""
    sizes = (128, 256, 512, 1024)
    print("| model | technique | " + " | ".join(f"{size}^2" for size in sizes) + " |")
    print("|---" * (2 + len(sizes)) + "|")
    for model in error_models.models(only or MODELS):
        bench = Bench(model)
        exact: list[float] = []
        for name in ("exact", ADAPTIVE, "bounding_opacity_maps"):
            rmse = [
                bench.errors(po.technique(name), size, 2.0 * bench.texel(size))[0].rmse
                for size in sizes
            ]
            exact = exact or rmse
            cells = [
                f"{e:.4f} ({100 * (e / best - 1):+.1f} %)"
                for e, best in zip(rmse, exact, strict=True)
            ]
            print(f"| {model.name} | `{name}` | {' | '.join(cells)} |", flush=True)


def scenes(only: list[str] | None) -> Iterator[tuple[str, po.Scene]]:
    for name in (*SCENES, "demo:dense_grass?segments=60000", "demo:clouds?voxels=100000"):
        if not only or name in only:
            yield name, po.Scene(po.load(name), po.DirectionalLight(LIGHT))


def print_scenes(only: list[str] | None) -> None:
    """At 4, 8 and 16 layers, 256^2."""
    print(f"| scene, 256^2 | {' | '.join(OURS)} |")
    print("|---" * (1 + len(OURS)) + "|")
    for name, scene in scenes(only):
        depth = DepthErrors(scene, 256)
        cells = [
            ", ".join(f"{depth.of(way, layers=n, **more):.4f}" for n in (4, 8, 16))
            for way, more in OURS.values()
        ]
        print(f"| {name} | {' | '.join(cells)} |", flush=True)


TABLES = {"published": print_published, "total": print_total, "scenes": print_scenes}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--table", choices=TABLES, action="append")
    parser.add_argument("--model", action="append", help="only the one of this name")
    arguments = parser.parse_args()
    for table in arguments.table or TABLES:
        TABLES[table](arguments.model)
        print()


if __name__ == "__main__":
    main()
