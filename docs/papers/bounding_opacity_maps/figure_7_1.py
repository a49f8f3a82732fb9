"""Figure 7.1: a splitting texture for each pixel and for regions, which the thesis only estimates.

demo:mixed, sparse and dense casters in one map: layers (a), the ratio of each texel (b), and of
each square of eight (c); dark is linear, bright logarithmic, what nothing covers is blue.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import numpy as np
from bounding_opacity_maps._scenes import layers_of
from common import Claim, Run, main
from common.pictures import as_shown, sheet
from common.scenes import lit, published
from PIL import Image

import pyopacity as po

LAYERS, SHOWN_LAYER = 8, 2
SPLITS = {"per_texel": "(b) pixels", "per_region": "(c) regions"}
EMPTY = (190, 205, 235)


def ratios(used: po.Renderer, split: str, covered: np.ndarray) -> np.ndarray:
    """(H, W): of every texel, also of what a region says for it."""
    used.technique.split = split
    used.transmittance(np.zeros((1, 3)))
    found = used.read("bounding_opacity_maps/split_ratios")
    found = found if found.ndim == 2 else found[..., 0]
    factor = -(-covered.shape[0] // found.shape[0])
    return np.kron(found, np.ones((factor, factor)))[: covered.shape[0], : covered.shape[1]]


def claims(run: Run) -> list[Claim]:
    scene = lit(f"demo:mixed?primitives={run.pick(100_000, 40_000, 2_000)}")
    map_size = run.pick(512, 256, 64)
    technique = published("bounding_opacity_maps", layers=LAYERS)
    error, shown, spread = {}, [], {}
    receiver = scene.shapes[0]
    with po.Renderer(scene, technique="exact", map_size=map_size) as used:
        exact = used.transmittance(receiver)
        used.technique = technique
        technique.split = "auto"
        error["one ratio"] = po.metrics.rmse(used.transmittance(receiver), exact)
        layers = layers_of(used)
        covered = layers[-1] > 0.0
        shown.append((f"(a) layer {SHOWN_LAYER}", as_shown(layers[SHOWN_LAYER - 1])))
        for split, label in SPLITS.items():
            found = ratios(used, split, covered)
            error[split] = po.metrics.rmse(used.transmittance(receiver), exact)
            image = np.asarray(as_shown(found)).copy()
            image[~covered] = EMPTY
            shown.append((label, Image.fromarray(image)))
            spread[split] = float(np.std(found[covered]))
    small = [(label, image.resize((256, 256))) for label, image in shown]
    run.save(sheet(small, 3))
    return [
        Claim(
            "rays have ratios of their own",
            "dark and bright parts, estimated",
            ", ".join(f"standard deviation {s} {v:.2f}" for s, v in spread.items()),
            min(spread.values()) > 0.05,
        ),
        Claim(
            "a ratio for each ray solves what one for all cannot",
            "future work",
            "RMSE of T: " + ", ".join(f"{name} {value:.4f}" for name, value in error.items()),
            error["per_texel"] < error["one ratio"],
        ),
    ]


if __name__ == "__main__":
    main(__file__, claims)
