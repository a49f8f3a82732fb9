"""Time of a frame whose camera is close: all chunks of the hair drawn, over those that it sees.

    python benchmarks/culling.py [--segments 1050000] [--frames 9] > table.md

Both take turns; figures are medians, while only the camera moves, and of a map that is cut to
a small receiver. Needs OpenGL, which may be one in software.
"""

from __future__ import annotations

import argparse
import re
import statistics
import time

import numpy as np

import pyopacity as po

LIGHT = (0.5, 0.3, -0.8)
FIELDS = (45.0, 15.0, 5.0)  # degrees, from the same place
MODES = ("opaque", "maps")


def middle_and_reach(scene: po.Scene) -> tuple[np.ndarray, float]:
    low, high = scene.bounds.min, scene.bounds.max
    return 0.5 * (low + high), float(np.max(high - low))


def camera_at(scene: po.Scene, fov_deg: float, frame: int) -> po.Camera:
    middle, reach = middle_and_reach(scene)
    eye = middle + np.array([0.3 + 0.002 * frame, -1.6, 0.4]) * reach
    return po.Camera.look_at(eye.tolist(), middle.tolist(), fov_deg=fov_deg)


def timed(
    renderers: list[po.Renderer], scene: po.Scene, fov_deg: float, frames: int
) -> list[float]:
    times: list[list[float]] = [[] for _ in renderers]
    for frame in range(-2, frames):
        for renderer, row in zip(renderers, times, strict=True):
            renderer.camera = camera_at(scene, fov_deg, frame)
            begin = time.perf_counter()
            renderer.render()
            row.append(1e3 * (time.perf_counter() - begin))
    return [statistics.median(row[2:]) for row in times]


def print_cameras(scene: po.Scene, frames: int) -> None:
    print("| field of view | compositing | chunks drawn | all, ms | those in view, ms | ratio |")
    print("|---|---|---|---|---|---|")
    for mode in MODES:
        renderers = [
            po.Renderer(scene, compositing=mode, culling=culling) for culling in (False, True)
        ]
        for fov_deg in FIELDS:
            off, on = timed(renderers, scene, fov_deg, frames)
            notes = " ".join(row.note for row in renderers[1].report if row.name in SEEN)
            hidden = re.search(r"(\d+) of (\d+) chunks", notes)
            drawn = f"{int(hidden[2]) - int(hidden[1])} of {hidden[2]}" if hidden else "all"
            print(
                f"| {fov_deg:g} | {mode} | {drawn} | {off:.0f} | {on:.0f} | {on / off:.2f} |",
                flush=True,
            )
        for renderer in renderers:
            renderer.close()


SEEN = ("lighting", "translucent")


def print_maps(scene: po.Scene, frames: int) -> None:
    """The hair shadows a small sheet alone."""
    middle, reach = middle_and_reach(scene)
    for shape in scene.shapes:
        shape.receives = False
    corners = middle + 0.05 * reach * np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0.0]])
    scene.add(po.Mesh(corners, np.array([[0, 1, 2]]), casts=False))
    times: dict[bool, list[float]] = {False: [], True: []}
    renderers = {on: po.Renderer(scene, size=(8, 8), culling=on) for on in times}
    for turn in range(frames + 1):
        for on, renderer in renderers.items():
            renderer.invalidate()
            begin = time.perf_counter()
            renderer.transmittance(corners)
            if turn:
                times[on].append(1e3 * (time.perf_counter() - begin))
    off, on = (statistics.median(times[key]) for key in (False, True))
    notes = " ".join(row.note for row in renderers[True].report if row.name.endswith("bounds"))
    print(f"\nmaps of a small receiver: {off:.0f} ms, {on:.0f} ms, {on / off:.2f}; {notes}")
    for renderer in renderers.values():
        renderer.close()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--segments", type=int, default=1_050_000)
    parser.add_argument("--frames", type=int, default=9)
    arguments = parser.parse_args()
    shapes = po.load(f"demo:hair?segments={arguments.segments}")
    scene = po.Scene(shapes, po.DirectionalLight(LIGHT))
    print_cameras(scene, arguments.frames)
    print_maps(scene, arguments.frames)


if __name__ == "__main__":
    main()
