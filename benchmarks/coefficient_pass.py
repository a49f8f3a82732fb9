"""What summing coefficients costs beside slices of as many channels (Jansen and Bavoil 2010).

    python benchmarks/coefficient_pass.py [--device cpu] [--only plume] > table.md

Prints the ratio of the medians of both passes, timed in turns, whole frames of transmittance less
everything else; both blend. The goal is at most 1.6.
"""

from __future__ import annotations

import argparse
import statistics
import time

import numpy as np

import pyopacity as po

ROUNDS = 9
LIGHT = po.DirectionalLight((0.5, 0.3, -0.8))
SCENES = {
    "plume": "demo:plume?particles=16000",
    "hair": "demo:hair?segments=150000",
    "smoke": "demo:smoke?voxels=200000",
}
CHANNELS = (7, 15, 31)
MAP_SIZES = (256, 512, 1024)
GOAL = 1.6


def technique_of(name: str, channels: int) -> po.Technique:
    if name == "opacity_shadow_maps":
        return po.technique(name, layers=channels, deposit="blend")
    return po.technique(name, coefficients=channels)


def build_seconds(renderer: po.Renderer) -> float:
    """Of all passes that a question needs, drawn anew; one point is asked."""
    renderer.invalidate()
    start = time.perf_counter()
    renderer.transmittance(np.zeros((1, 3)))
    return time.perf_counter() - start


def ratio(scene: po.Scene, channels: int, map_size: int, device: str) -> tuple[float, float]:
    """Of the medians, and that of slices in milliseconds."""
    names = ("opacity_shadow_maps", "fourier_opacity_maps")
    taken: dict[str, list[float]] = {name: [] for name in names}
    renderers = {
        name: po.Renderer(
            scene, technique=technique_of(name, channels), map_size=map_size, device=device
        )
        for name in names
    }
    for round_ in range(ROUNDS + 2):
        for name, renderer in renderers.items():
            seconds = build_seconds(renderer)
            if round_ > 1:  # after programs have been made
                taken[name].append(seconds)
    for renderer in renderers.values():
        renderer.close()
    slices, fourier = (statistics.median(taken[name]) for name in names)
    return fourier / slices, 1e3 * slices


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--device", default="gpu", choices=["gpu", "cpu"])
    parser.add_argument("--only", default="", help="scenes whose name contains this")
    options = parser.parse_args()
    print("| scene | map | channels | slices, ms | coefficients / slices |\n|---|---|---|---|---|")
    for name, file in SCENES.items():
        if options.only not in name:
            continue
        scene = po.Scene(po.load(file), LIGHT)
        for map_size in MAP_SIZES:
            for channels in CHANNELS:
                times, slices = ratio(scene, channels, map_size, options.device)
                verdict = "" if times <= GOAL else f", above {GOAL}"
                print(
                    f"| {name} | {map_size}^2 | {channels} | {slices:.1f} | {times:.2f}{verdict} |",
                    flush=True,
                )


if __name__ == "__main__":
    main()
