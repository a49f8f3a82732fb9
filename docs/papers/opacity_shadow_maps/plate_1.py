"""Plate 1: hair without self-shadows, the opacity maps as green rectangles, and with self-shadows.

demo:hair of about as many lines as in the paper, 340,000, from the side of the light. Rectangles
lie where the slices of the light's map do; every sixth of 60 is drawn.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import numpy as np
from common import Claim, Run, main
from common.pictures import picture, sheet
from common.scenes import camera, lit, published, renderer, strands

import pyopacity as po

MAPS, DRAWN_EVERY = 60, 6
GREEN, GREEN_OPACITY = (0.15, 0.8, 0.2), 0.16
VIEW = (-0.45, 1.0, -0.35)


def slices(world_from_light: np.ndarray, map_size: int) -> po.Mesh:
    """Rectangles as wide as the map, which neither cast nor receive."""
    depths = np.arange(DRAWN_EVERY, MAPS + 1, DRAWN_EVERY) / MAPS
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) * map_size
    corners = [(x, y, z, 1.0) for z in depths for x, y in square]
    world = np.array(corners) @ world_from_light.T
    quad = np.array([[0, 1, 2], [0, 2, 3]])
    faces = (4 * np.arange(len(depths))[:, None, None] + quad).reshape(-1, 3)
    mesh = po.Mesh(np.ascontiguousarray(world[:, :3]), faces, color=GREEN, opacity=GREEN_OPACITY)
    mesh.casts = mesh.receives = False
    return mesh


def claims(run: Run) -> list[Claim]:
    scene = lit(f"demo:hair?segments={run.pick(340_000, 100_000, 5_000)}")
    map_size, size = run.pick(512, 256, 64), run.pick((300, 300), (300, 300), (60, 60))
    hair = strands(scene)
    with renderer(scene, camera(scene, VIEW), size, map_size, technique="unshadowed") as used:
        bare = used.render()
        used.technique = published("opacity_shadow_maps", layers=MAPS, filter_radius=1.5)
        shadowed = used.render()
        T = float(used.transmittance(hair).mean())
        on_hair = used.image("object_id") == scene.shapes.index(hair)
        world_from_light = np.linalg.inv(used.light_from_world)
    scene.remove(scene.shapes[-1])  # the ground
    scene.add(slices(world_from_light, map_size))
    # Maps would lie far apart: the rectangles are wider than the hair.
    options = {"compositing": "exact", "antialiasing": 1, "technique": "unshadowed"}
    with renderer(scene, camera(scene, VIEW), size, map_size, **options) as used:
        mapped = used.render()
    labels = ("no self-shadows", f"every {DRAWN_EVERY}th of {MAPS} maps", "self-shadows")
    run.save(
        sheet([(n, picture(p)) for n, p in zip(labels, (bare, mapped, shadowed), strict=True)], 3)
    )
    light, dark = (float(p[on_hair][:, :3].mean()) for p in (bare, shadowed))
    return [
        Claim(
            "self-shadows darken hair",
            "seen",
            f"mean colour of hair {dark:.3f} of {light:.3f} before; mean T of all vertices {T:.3f}",
            dark < light and T < 1.0,
        )
    ]


if __name__ == "__main__":
    main(__file__, claims)
