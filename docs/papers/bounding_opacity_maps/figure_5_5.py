"""Figure 5.5: 16 layers: deep ones give strands behind the last layer false shadow, bounding none.

demo:dense_grass, evenly split. Deep layers end at a fifth of the depths, so that some strands lie
behind the last one. Errors are of T where the picture looks it up, against exact lists.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import numpy as np
from bounding_opacity_maps._ends import (
    BOUNDING,
    DEEP,
    place_in_layers,
    range_of_depths,
    techniques,
)
from bounding_opacity_maps._scenes import thesis_scene
from common import Claim, Run, main
from common.pictures import picture, sheet
from common.scenes import LEFT, camera, renderer, seen

import pyopacity as po

END = 0.2


def claims(run: Run) -> list[Claim]:
    scene = thesis_scene(run, "dense grass")
    size, map_size = run.pick((300, 270), (300, 270), (48, 36)), run.pick(512, 256, 64)
    shown, T, behind = [], {}, np.zeros(0)
    with renderer(scene, camera(scene, LEFT, 1.8), size, map_size, technique="exact") as used:
        points = seen(used)
        exact, right = used.transmittance(points), used.render()
        extent = END * range_of_depths(used)
        for name, technique in techniques(extent).items():
            used.technique = technique
            shown.append((name, picture(used.render())))
            T[name] = used.transmittance(points)
            if name == DEEP:
                behind = place_in_layers(used, points, extent) > 1.0
    run.save(sheet([*shown, ("exact lists", picture(right))], 3))

    def rmse(name: str, where: np.ndarray) -> float:
        return po.metrics.rmse(T[name][where], exact[where]) if where.any() else 0.0

    told = {name: (rmse(name, behind), rmse(name, ~behind)) for name in (DEEP, BOUNDING)}
    return [
        Claim(
            "what lies behind the last deep layer has false shadow",
            "some strands",
            f"{100 * behind.mean():.1f} % of the picture lies there; RMSE of T there: deep "
            f"{told[DEEP][0]:.3f}, bounding {told[BOUNDING][0]:.3f}; elsewhere "
            f"{told[DEEP][1]:.3f}, {told[BOUNDING][1]:.3f}",
            bool(behind.any()) and told[DEEP][0] > 2.0 * told[BOUNDING][0],
        )
    ]


if __name__ == "__main__":
    main(__file__, claims)
