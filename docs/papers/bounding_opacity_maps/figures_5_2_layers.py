"""Figures 5.2.2, 5.2.4, 5.2.3.2, 5.2.3.3: layers of linear and logarithmic splits, grass and tree.

Eight layers of bounding opacity maps as opacity, white is opaque: of dense grass by a linear split
(the last layers are nearly the same) and a logarithmic one (each adds), and of a scattered tree
(the other way round), by the thesis's table. Under each picture stands what it adds to the one
before, as a part of all. The first caster of a texel lies in the first layer and the last one in
the last, whatever the split; so what the first four layers have in common is told by what the
second to the fourth add.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import numpy as np
from bounding_opacity_maps._scenes import layers_of, new_information, thesis_scene
from common import Claim, Run, main
from common.pictures import as_shown, sheet
from common.scenes import published

import pyopacity as po

LAYERS, LATE = 8, 4
CASES = {  # figure: scene, split
    "5.2.2": ("dense grass", "linear"),
    "5.2.4": ("dense grass", "logarithmic"),
    "5.2.3.2": ("sparse tree", "linear"),
    "5.2.3.3": ("sparse tree", "logarithmic"),
}


def layers(run: Run, scene: po.Scene, split: str) -> np.ndarray:
    technique = published("bounding_opacity_maps", layers=LAYERS, split=split, paper_lut=True)
    with po.Renderer(scene, technique=technique, map_size=run.pick(512, 256, 64)) as used:
        used.transmittance(np.zeros((1, 3)))
        return layers_of(used)


def told(values: dict[str, float], *figures: str) -> str:
    return ", ".join(f"{CASES[f][1]} {100 * values[f]:.1f} %" for f in figures)


def of_grass(added: dict[str, list[float]]) -> list[Claim]:
    last = {figure: sum(parts[-LATE:]) for figure, parts in added.items()}
    least = {figure: min(parts) for figure, parts in added.items()}
    return [
        Claim(
            "dense grass: the last four layers of a linear split add little",
            "almost the same",
            f"the last four add {told(last, '5.2.2', '5.2.4')} of all",
            last["5.2.2"] < 0.25 and last["5.2.2"] < last["5.2.4"],
        ),
        Claim(
            "dense grass: each layer of a logarithmic split adds",
            "every layer differs",
            f"the least adds {told(least, '5.2.2', '5.2.4')}",
            least["5.2.4"] > least["5.2.2"],
            "a blade fills the thin layers right behind the first caster of its texel, the second "
            "to the fourth, as little as the last linear ones",
        ),
    ]


def of_tree(added: dict[str, list[float]]) -> list[Claim]:
    early = {figure: sum(parts[1:LATE]) for figure, parts in added.items()}
    least = {figure: min(parts) for figure, parts in added.items()}
    return [
        Claim(
            "scattered tree: the first four layers of a logarithmic split add little",
            "almost the same",
            f"layers 2 to 4 add {told(early, '5.2.3.2', '5.2.3.3')} of all",
            early["5.2.3.3"] < 0.05 and early["5.2.3.3"] < early["5.2.3.2"],
        ),
        Claim(
            "scattered tree: each layer of a linear split adds",
            "every layer differs",
            f"the least adds {told(least, '5.2.3.2', '5.2.3.3')}",
            least["5.2.3.2"] > least["5.2.3.3"],
        ),
    ]


def claims(run: Run) -> list[Claim]:
    scenes = {name: thesis_scene(run, name) for name in ("dense grass", "sparse tree")}
    shown, added = [], {}
    for figure, (scene, split) in CASES.items():
        images = layers(run, scenes[scene], split)
        added[figure] = new_information(images)
        step = max(1, images.shape[1] // 128)
        for k, image in enumerate(images):
            label = f"{k + 1}: +{100 * added[figure][k]:.0f} %"
            label = f"{split} {label}" if k == 0 else label
            shown.append((label, as_shown(image[::step, ::step])))
    run.save(sheet(shown, LAYERS))
    return [*of_grass(added), *of_tree(added)]


if __name__ == "__main__":
    main(__file__, claims)
