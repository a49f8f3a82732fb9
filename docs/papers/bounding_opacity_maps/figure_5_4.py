"""Figure 5.4: 16 layers in false colour: deep ones do not reach the end, bounding ones do.

demo:dense_grass, evenly split: the first layer is light green, the last black. As in the thesis's
code deep layers run from the first caster over nearly all (.95) of the depths of the scene.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import numpy as np
from bounding_opacity_maps._ends import (
    BOUNDING,
    DEEP,
    LAYERS,
    place_in_layers,
    range_of_depths,
    techniques,
)
from bounding_opacity_maps._scenes import thesis_scene
from common import Claim, Run, main
from common.pictures import layer_colors, picture, sheet
from common.scenes import LEFT, SKY, camera, renderer

END = 0.95


def claims(run: Run) -> list[Claim]:
    scene = thesis_scene(run, "dense grass")
    scene.shapes[-1].receives = False  # the ground lies in no layer
    size, map_size = run.pick((360, 270), (360, 270), (48, 36)), run.pick(512, 256, 64)
    shown, last = [], {}
    with renderer(scene, camera(scene, LEFT, 1.8), size, map_size, technique="exact") as used:
        receivers = used.receivers()
        points = receivers.points[receivers.mask]
        used.transmittance(points[:1])
        extent = END * range_of_depths(used)
        for name, technique in techniques(extent).items():
            used.technique = technique
            used.transmittance(points)
            place = place_in_layers(used, points, extent)
            colors = np.tile(np.array(SKY[:3]), (*receivers.mask.shape, 1))
            colors[receivers.mask] = layer_colors(place, LAYERS)
            shown.append((name, picture(colors)))
            last[name] = float(np.mean(place >= 1.0 - 4 / LAYERS))
    run.save(sheet(shown, 2))
    return [
        Claim(
            "deep layers do not cover the whole length of what casts",
            "deep never black, bounding black at the end",
            f"parts of the picture in the last four of {LAYERS} layers: deep "
            f"{100 * last[DEEP]:.1f} %, bounding {100 * last[BOUNDING]:.1f} %",
            last[DEEP] < 0.5 * last[BOUNDING],
        )
    ]


if __name__ == "__main__":
    main(__file__, claims)
