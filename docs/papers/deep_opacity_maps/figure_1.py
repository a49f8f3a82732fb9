"""Figure 1: straight hair of 150,000 segments: no shadows, slices, density clustering, deep layers.

The paper's model is straight.hair, which is taken where PYOPACITY_DATA has it; else demo:hair,
straight, of as many segments. Layers have the sizes 1, 2, 3 of a third of the hair's height.
"""

import sys
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from common import Claim, Run, main
from common.scenes import LIGHT, camera, lit, real_model
from deep_opacity_maps._comparison import CLUSTERS, DEEP, NONE, compared, slices

import pyopacity as po

FPS = {NONE: 154, slices(16): 81, slices(128): 2.3, CLUSTERS: 73, DEEP: 114}


def straight(run: Run) -> tuple[str, po.Scene]:
    """The model's name, and it on a head under the light."""
    shapes = None if run.size == "smallest" else real_model("straight.hair")
    if shapes is None:
        file = f"demo:hair?style=straight&segments={run.pick(150_000, 150_000, 5_000)}"
        return file, lit(file)
    return "straight.hair", po.Scene(shapes, po.DirectionalLight(LIGHT, intensity=1.3))


def claims(run: Run) -> list[Claim]:
    name, scene = straight(run)
    first, *others = compared(run, scene, camera(scene, (0.6, 0.8, -0.3), 1.35), FPS, 16, 128)
    return [replace(first, note=f"on {name}"), *others]


if __name__ == "__main__":
    main(__file__, claims)
