"""Figure 4.3: opacity shadow maps with 64 layers show bands that 16 deep opacity maps do not.

demo:grass under a low light. Errors are of T where the picture looks it up and nothing shades: the
exact lists say more than .95.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from bounding_opacity_maps._scenes import thesis_scene
from common import Claim, Run, main
from common.pictures import picture, sheet
from common.scenes import LEFT, camera, published, renderer, seen

import pyopacity as po

LIT = 0.95


def claims(run: Run) -> list[Claim]:
    scene = thesis_scene(run, "grass")
    size, map_size = run.pick((360, 270), (360, 270), (48, 36)), run.pick(512, 256, 64)
    ways = {
        "opacity shadow maps, 64 layers": published("opacity_shadow_maps", layers=64),
        "deep opacity maps, 16 layers": published("deep_opacity_maps", layers=16),
        "opacity shadow maps, 16 layers": published("opacity_shadow_maps", layers=16),
        "exact lists": po.technique("exact"),
    }
    shown, T = [], {}
    with renderer(scene, camera(scene, LEFT, 1.8), size, map_size) as used:
        points = seen(used)
        for name, technique in ways.items():
            used.technique = technique
            shown.append((name, picture(used.render())))
            T[name] = used.transmittance(points)
    run.save(sheet(shown, 2))
    lit = T["exact lists"] > LIT
    error = {name: po.metrics.rmse(T[name][lit], T["exact lists"][lit]) for name in ways}
    slices, deep, few, _ = ways
    return [
        Claim(
            "16 deep layers are free of what 64 slices show",
            "layering artefacts with 64 slices, none with 16 deep layers",
            f"RMSE of T where nothing shades: {error[slices]:.3f} of 64 slices, {error[deep]:.3f} "
            f"of 16 deep layers ({error[few]:.3f} of 16 slices)",
            error[deep] < error[slices],
        )
    ]


if __name__ == "__main__":
    main(__file__, claims)
