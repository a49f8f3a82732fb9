"""Figures 5.2.5, 5.2.3.4: what the wrong split does to dense grass, and to a scattered tree.

Linear and logarithmic layers by the thesis's table, four and eight of them, and exact lists; the
picture has four layers of the grass, and eight of the tree. Errors are of T where the picture looks
it up, against the exact lists of the same map.
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

LAYERS = (4, 8)
SPLITS = ("linear", "logarithmic")
GRASS = "the two are close; in the thesis, too, splits grow linear with the layers (A.11)"
TREE = (
    "the two are close; a ray through a tree in autumn meets one to three leaves, of which either "
    "split has the first in its first layer"
)
Errors = dict[tuple[str, int], float]


def compared(run: Run, name: str, zoom: float, shown_layers: int) -> tuple[list, Errors]:
    """Labelled pictures, and RMSE of T by split and layers."""
    scene = thesis_scene(run, name)
    size, map_size = run.pick((300, 270), (300, 270), (48, 40)), run.pick(512, 256, 64)
    shown, error = [], {}
    with renderer(scene, camera(scene, LEFT, zoom), size, map_size, technique="exact") as used:
        points = seen(used)
        exact, right = used.transmittance(points), used.render()
        for split in SPLITS:
            for layers in LAYERS:
                used.technique = published(
                    "bounding_opacity_maps", layers=layers, split=split, paper_lut=True
                )
                error[split, layers] = po.metrics.rmse(used.transmittance(points), exact)
                if layers == shown_layers:
                    shown.append((f"{name}, {layers} {split}", picture(used.render())))
    return [*shown, (f"{name}, exact lists", picture(right))], error


def told(error: Errors, layers: int) -> str:
    return "RMSE of T: " + ", ".join(f"{split} {error[split, layers]:.4f}" for split in SPLITS)


def claims(run: Run) -> list[Claim]:
    grass, of_grass = compared(run, "dense grass", 1.8, 4)
    tree, of_tree = compared(run, "sparse tree", 1.5, 8)
    run.save(sheet([*grass, *tree], 3))
    scenes = (
        ("dense grass", of_grass, "logarithmic", "linear gives incorrect self-shadows", GRASS),
        ("scattered tree", of_tree, "linear", "logarithmic wrongly lights the top", TREE),
    )
    return [
        Claim(
            f"{name}, {layers} layers: {better} is better",
            paper,
            told(error, layers),
            error[better, layers] == min(error[split, layers] for split in SPLITS),
            why,
        )
        for name, error, better, paper, why in scenes
        for layers in LAYERS
    ]


if __name__ == "__main__":
    main(__file__, claims)
