"""What each way to lay layers costs: depth and total error, and the depth error of the lit surface.

    python benchmarks/layered_techniques.py [--only hair] > table.md

Prints the table of docs/accuracy.md. Real models are those that PYOPACITY_DATA has. Maps are the
CPU's, so no OpenGL is needed.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator

import numpy as np
import scene_errors
from depth_error import DATA, LIGHT, OPACITY

import pyopacity as po
from pyopacity.comparison import Plan, Receivers, sample_receivers
from pyopacity.comparison.truth import FOOTPRINT_TEXELS, Truth

MAP_SIZE, RECEIVERS, RAYS, SEED = 512, 6000, 64, 0
LIT = 0.95
WAYS: dict[str, tuple[str, dict[str, object]]] = {
    "`exact`": ("exact", {}),
    "`bounding_opacity_maps`": ("bounding_opacity_maps", {}),
    "the same, 8 layers": ("bounding_opacity_maps", {"layers": 8}),
    "`adaptive_opacity_maps`": ("adaptive_opacity_maps", {}),
    "`deep_opacity_maps`": ("deep_opacity_maps", {}),
    "the same, 3 layers": ("deep_opacity_maps", {"layers": 3}),
    "`opacity_shadow_maps`": ("opacity_shadow_maps", {}),
    "the same, by density": ("opacity_shadow_maps", {"slicing": "density"}),
    "the same, 128 layers": ("opacity_shadow_maps", {"layers": 128}),
    "`fourier_opacity_maps`": ("fourier_opacity_maps", {}),
    "the same, 15 coefficients": ("fourier_opacity_maps", {"coefficients": 15}),
    "the same, 15, bounds of each texel": (
        "fourier_opacity_maps",
        {"coefficients": 15, "bounds": "per_texel"},
    ),
    "`moment_opacity_maps`": ("moment_opacity_maps", {}),
    "the same, 8 moments": ("moment_opacity_maps", {"moments": 8}),
    "`density_clustering`": ("density_clustering", {}),
    "the same, 2 clusters": ("density_clustering", {"clusters": 2}),
    "the same, 8 clusters": ("density_clustering", {"clusters": 8}),
    "the same, even means": ("density_clustering", {"iterations": 0}),
}


def scenes() -> Iterator[tuple[str, po.Scene]]:
    """Name, and a scene whose first shape receives."""
    for name in ("straight.hair", "bear.hair"):
        if (DATA / "hair" / name).exists():
            shapes = po.load(str(DATA / "hair" / name))
            shapes[0].opacity = OPACITY
            yield name, po.Scene(shapes, po.DirectionalLight(LIGHT))
    for name in ("hair", "tree?leaves=20000", "dense_grass?segments=60000", "smoke?voxels=200000"):
        yield f"demo:{name}", po.Scene(po.load(f"demo:{name}"), po.DirectionalLight(LIGHT))


def receivers_of(scene: po.Scene) -> Receivers:
    """Some of the first shape's points; of a volume voxels that hold something."""
    for shape in scene.shapes:
        shape.receives = shape is scene.shapes[0]
    if isinstance(scene.shapes[0], po.Volume):
        return scene_errors.filled(sample_receivers(scene, 20 * RECEIVERS, SEED))
    return sample_receivers(scene, RECEIVERS, SEED)


def rows(scene: po.Scene) -> Iterator[str]:
    """One for each way."""
    receivers = receivers_of(scene)
    camera = po.Camera.look_at((1, 0, 0), (0, 0, 0))  # no picture is made
    truth = Truth(scene, camera, Plan(samples=RAYS, device="cpu"), receivers, lambda _: None)
    exact = None
    with po.Renderer(scene, device="cpu", map_size=MAP_SIZE) as renderer:
        for name, (technique, parameters) in WAYS.items():
            renderer.technique = po.technique(technique, **parameters)
            T = receivers.transmittance(renderer)
            exact = T if exact is None else exact
            lit = exact >= LIT
            traced = truth.transmittance(FOOTPRINT_TEXELS * receivers.texel_sides(renderer), None)
            depth, total = po.metrics.errors(T, exact), po.metrics.errors(T, traced)
            on_lit = po.metrics.rmse(T[lit], exact[lit]) if lit.any() else np.nan
            yield (
                f"| {name} | {depth.rmse:.4f} ({depth.bias:+.3f}) | {on_lit:.4f} "
                f"| {total.rmse:.4f} ({total.bias:+.3f}) |"
            )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", default="", help="scenes whose name contains this")
    only = parser.parse_args().only
    print("| scene | technique | depth | where lit | total |\n|---|---|---|---|---|")
    for scene_name, scene in scenes():
        if only not in scene_name:
            continue
        for row in rows(scene):
            print(f"| {scene_name} {row}", flush=True)


if __name__ == "__main__":
    main()
