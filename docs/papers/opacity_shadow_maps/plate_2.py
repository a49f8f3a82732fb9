"""Plate 2: hair lit by three lights, another view, the opaque head and torso, and backlighting.

As in the paper 80 maps for each light, and about 500,000 lines: demo:hair on its bust, which casts
and receives through a depth map of its own. For the third picture the hair is taken off.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import numpy as np
from common import Claim, Run, main
from common.pictures import picture, sheet
from common.scenes import FRONT, LIGHT, camera, lit, published, renderer, strands

import pyopacity as po

MAPS = 80
THREE = (LIGHT, (-0.8, 0.4, -0.4), (0.1, 0.9, 0.15))
FROM_BEHIND, ANOTHER_VIEW = (0.05, -1.0, -0.3), (0.75, 0.9, -0.3)
PARTS_OF_A_RIM = 50  # of the picture's width


def rendered(run: Run, scene: po.Scene, view: po.Camera) -> tuple[np.ndarray, np.ndarray]:
    """The picture, and where the scene's first shape is seen."""
    size, map_size = run.pick((300, 300), (300, 300), (60, 60)), run.pick(512, 256, 64)
    technique = published("opacity_shadow_maps", layers=MAPS, filter_radius=1.5)
    with renderer(scene, view, size, map_size, technique=technique) as used:
        image = used.render()
        return image, used.image("object_id") == 0


def rim_over_inside(image: np.ndarray, hair: np.ndarray) -> float:
    """Mean colour of hair near the edge of all hair, over that further in."""
    inside, rim = hair.copy(), max(1, len(hair) // PARTS_OF_A_RIM)
    for axis in (0, 1):
        for step in (-rim, rim):
            inside &= np.roll(hair, step, axis)
    color = image[..., :3].mean(axis=2)
    return float(color[hair & ~inside].mean() / color[inside].mean())


def head_on_hair(run: Run, scene: po.Scene) -> tuple[float, float]:
    """Mean T of all vertices of the hair, with and without what is opaque."""
    hair, found = strands(scene), []
    technique = published("opacity_shadow_maps", layers=MAPS)
    with po.Renderer(scene, technique=technique, map_size=run.pick(512, 256, 64)) as used:
        for alone in (False, True):
            for shape in scene.shapes[1:-1]:
                shape.casts = not alone
            found.append(float(used.transmittance(hair).mean()))
    return found[0], found[1]


def claims(run: Run) -> list[Claim]:
    file = f"demo:hair?segments={run.pick(500_000, 100_000, 3_000)}"
    three, one, front = lit(file, *THREE, intensity=2.2), lit(file), lit(file, FRONT)
    behind = lit(file, FROM_BEHIND, intensity=2.0)
    view = camera(one)
    from_behind, hair = rendered(run, behind, view)
    shown = [
        (f"three lights, N = {MAPS}", rendered(run, three, view)[0]),
        ("another view", rendered(run, one, camera(one, ANOTHER_VIEW))[0]),
    ]
    one.remove(strands(one))
    shown += [("head and torso", rendered(run, one, view)[0]), ("backlighting", from_behind)]
    run.save(sheet([(label, picture(image)) for label, image in shown], 2))
    rims = rim_over_inside(from_behind, hair), rim_over_inside(*rendered(run, front, view))
    with_head, without_head = head_on_hair(run, front)
    return [
        Claim(
            "backlighting: the rim glows",
            "seen",
            f"rim over inside {rims[0]:.2f} lit from behind, {rims[1]:.2f} from the front",
            rims[0] > max(rims[1], 1.0),
        ),
        Claim(
            "the opaque head casts on the hair",
            "a depth map beside the opacity maps",
            f"mean T of the hair {with_head:.3f} with the head, {without_head:.3f} without",
            with_head < without_head,
        ),
    ]


if __name__ == "__main__":
    main(__file__, claims)
