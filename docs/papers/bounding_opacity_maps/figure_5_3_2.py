"""Figure 5.3.2: a tree whose trunk and branches do not cast shadows, and do.

demo:tree, eight bounding layers. Told is T at points of the leaves and of the ground.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from bounding_opacity_maps._scenes import thesis_scene
from common import Claim, Run, main
from common.pictures import picture, sheet
from common.scenes import camera, published, renderer

LOOK, LIGHT = (0.4, -1.0, -0.45), (-0.7, -0.45, -0.7)


def claims(run: Run) -> list[Claim]:
    scene = thesis_scene(run, "tree", LIGHT)
    leaves, wood, ground = scene.shapes
    size, map_size = run.pick((340, 340), (340, 340), (40, 40)), run.pick(512, 256, 64)
    view, shown, mean = camera(scene, LOOK, 1.1), [], {}
    with renderer(scene, view, size, map_size) as used:
        used.technique = published("bounding_opacity_maps", layers=8)
        ids = used.image("object_id")
        on_ground = ids == scene.shapes.index(ground)
        for casts, label in ((False, "opaque objects do not cast"), (True, "they cast")):
            wood.casts = casts
            shown.append((label, picture(used.render())))
            T = used.image("transmittance")
            mean[casts] = float(used.transmittance(leaves).mean()), float(T[on_ground].mean())
    run.save(sheet(shown, 2))
    return [
        Claim(
            "opaque objects cast through the same maps",
            "(b) has the shadows of trunk and branches",
            f"mean T of the leaves {mean[True][0]:.3f} of {mean[False][0]:.3f} before, of the "
            f"ground that is seen {mean[True][1]:.3f} of {mean[False][1]:.3f}",
            mean[True][0] < mean[False][0] and mean[True][1] < mean[False][1],
        )
    ]


if __name__ == "__main__":
    main(__file__, claims)
