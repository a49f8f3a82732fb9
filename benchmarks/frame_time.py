"""Time of a frame by technique, as ratios to the same frame without shadows.

    python benchmarks/frame_time.py [--segments 150000] [--map-size 512] [--frames 9] > table.md

Prints the tables of docs/performance.md: everything moving (every pass runs anew), only the camera
moving, and the casters' own light maps alone. Techniques take turns, so that what slows the machine
down slows all of them; figures are medians. Pictures are opaque, 1024 x 768, so that the shadow is
all that differs.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable
from typing import Any

import pyopacity as po

SIZE, LIGHT = (1024, 768), (0.5, 0.3, -0.8)
UNSHADOWED = "`unshadowed`"
WAYS: dict[str, tuple[str, dict[str, Any]]] = {
    UNSHADOWED: ("unshadowed", {}),
    "`shadow_map`, `splits` 1": ("shadow_map", {"splits": 1}),
    "`deep_opacity_maps`, 3 layers": ("deep_opacity_maps", {"layers": 3}),
    "`deep_opacity_maps`": ("deep_opacity_maps", {}),
    "`opacity_shadow_maps`": ("opacity_shadow_maps", {}),
    "`bounding_opacity_maps`, as published": (
        "bounding_opacity_maps",
        {"split": "hybrid", "interpolation": "linear"},
    ),
    "`bounding_opacity_maps`": ("bounding_opacity_maps", {}),
    "the same, 8 layers": ("bounding_opacity_maps", {"layers": 8}),
    "`adaptive_opacity_maps`": ("adaptive_opacity_maps", {}),
    "`deep_shadow_maps`": ("deep_shadow_maps", {}),
    "`exact`": ("exact", {}),
}
TURN = 0.002  # of the camera's place, from frame to frame


def scene_of(segments: int) -> po.Scene:
    shapes = po.load(f"demo:hair?segments={segments}")
    return po.Scene(shapes, po.DirectionalLight(LIGHT))


def camera_at(frame: int, scene: po.Scene) -> po.Camera:
    low, high = (getattr(scene.bounds, end) for end in ("min", "max"))
    middle = [0.5 * (a + b) for a, b in zip(low, high, strict=True)]
    reach = max(b - a for a, b in zip(low, high, strict=True))
    x, y, z = middle
    eye = (x + (0.3 + TURN * frame) * reach, y - 1.6 * reach, z + 0.4 * reach)
    return po.Camera.look_at(eye, (x, y, z))


def milliseconds(work: Callable[[], object]) -> float:
    begin = time.perf_counter()
    work()
    return 1e3 * (time.perf_counter() - begin)


def measured(scene: po.Scene, map_size: int, frames: int) -> dict[str, dict[str, float]]:
    """Medians of milliseconds, by way and by what moves."""
    camera = camera_at(0, scene)
    renderers = {
        name: po.Renderer(
            scene,
            camera,
            technique=po.technique(technique, **parameters),
            size=SIZE,
            map_size=map_size,
            compositing="opaque",
        )
        for name, (technique, parameters) in WAYS.items()
    }
    times: dict[str, dict[str, list[float]]] = {name: {} for name in WAYS}
    for frame in range(-2, frames):  # the first two warm up
        for name, renderer in renderers.items():
            renderer.invalidate()
            found = {"everything": milliseconds(renderer.render)}
            found["maps"] = sum(row.ms for row in renderer.report if row.name != "lighting")
            renderer.camera = camera_at(frame, scene)
            found["camera"] = milliseconds(renderer.render)
            found["nothing"] = milliseconds(renderer.render)
            for what, ms in found.items():
                times[name].setdefault(what, []).append(ms)
    device = next(iter(renderers.values())).context.renderer
    print(f"{device}, map {map_size}^2, {frames} frames\n")
    for renderer in renderers.values():
        renderer.close()
    return {
        name: {what: statistics.median(ms[2:]) for what, ms in row.items()}
        for name, row in times.items()
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--segments", type=int, action="append", help="again for more scenes")
    parser.add_argument("--map-size", type=int, default=512)
    parser.add_argument("--frames", type=int, default=9)
    arguments = parser.parse_args()
    for segments in arguments.segments or [150_000]:
        table = measured(scene_of(segments), arguments.map_size, arguments.frames)
        bare = table[UNSHADOWED]
        print(
            f"| {segments:,} segments | everything | camera | nothing, ms | maps, ms | frame, ms |"
        )
        print("|---|---|---|---|---|---|")
        for name, row in table.items():
            ratios = [f"{row[what] / bare[what]:.2f}" for what in ("everything", "camera")]
            times = [f"{row[what]:.2f}" for what in ("nothing", "maps", "everything")]
            print("|", " | ".join([name, *ratios, *times]), "|", flush=True)
        print()


if __name__ == "__main__":
    main()
