"""Figure 7: a hairy teapot; a shadow map for the teapot, a deep opacity map for its hair.

demo:teapot on its ground, three layers. Whether each casts on the others is told by T with and
without it.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import numpy as np
from common import Claim, Run, main
from common.pictures import picture, sheet
from common.scenes import camera, lit, published, renderer

import pyopacity as po

DIRECTION = (0.6, 0.35, -0.6)
SHADED = 0.9  # T below this


def shade(used: po.Renderer, casting: list[po.Shape]) -> dict[int, np.ndarray]:
    """T of the picture's points by the index of what is seen there, where these cast alone."""
    shapes = used.scene.shapes
    for shape in shapes:
        shape.casts = any(shape is one for one in casting)
    ids = used.image("object_id")
    receivers = used.receivers()
    T = {}
    for i in range(len(shapes)):
        here = receivers.mask & (ids == i)
        T[i] = used.transmittance(receivers.points[here]) if here.any() else np.ones(0)
    return T


def part_shaded(T: np.ndarray) -> float:
    return float(np.mean(T < SHADED)) if T.size else 0.0


def claims(run: Run) -> list[Claim]:
    scene = lit(f"demo:teapot?segments={run.pick(300_000, 100_000, 5_000)}", DIRECTION)
    view = camera(scene, (0.3, 1.0, -0.4))
    hair, pot, *_, ground = scene.shapes
    options = {"technique": published("deep_opacity_maps", layers=3, packing="4n-1")}
    size, map_size = run.pick((480, 360), (480, 360), (60, 45)), run.pick(512, 512, 64)
    with renderer(scene, view, size, map_size, **options) as used:
        image = used.render()
        by_hair, by_pot = shade(used, [hair]), shade(used, [pot])
    run.save(sheet([("deep opacity map and shadow map", picture(image))], 1))
    at = {
        name: scene.shapes.index(shape)
        for name, shape in (("hair", hair), ("teapot", pot), ("ground", ground))
    }
    parts = {
        "teapot on hair": part_shaded(by_pot[at["hair"]]),
        "teapot on ground": part_shaded(by_pot[at["ground"]]),
        "hair on hair": part_shaded(by_hair[at["hair"]]),
        "hair on teapot": part_shaded(by_hair[at["teapot"]]),
        "hair on ground": part_shaded(by_hair[at["ground"]]),
    }
    return [
        Claim(
            "hair and teapot cast on each other and on the ground",
            "both do",
            f"parts of what is seen with T < {SHADED}: "
            + ", ".join(f"{name} {100 * part:.1f} %" for name, part in parts.items()),
            all(part > 0.0 for part in parts.values()),
        )
    ]


if __name__ == "__main__":
    main(__file__, claims)
