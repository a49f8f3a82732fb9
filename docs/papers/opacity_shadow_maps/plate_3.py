"""Plate 3: fur of 6 and of 500 maps; artefacts show in bright regions, and with few maps only.

demo:fur under one light from the left. Crops are of the brightest and of the darkest square
full of fur (blue and yellow in the whole picture). Errors are of T where the picture looks it up,
against the exact lists of the same map: bright is where these say more than .5, dark where less
than .1.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import numpy as np
from common import Claim, Run, main
from common.pictures import framed, picture, sheet
from common.scenes import camera, lit, published, renderer
from PIL import Image

import pyopacity as po

FEW, MANY, EXACT = 6, 500, 0
FROM_THE_LEFT = (0.85, 0.35, -0.45)
BRIGHT, DARK = 0.5, 0.1
COLORS = {"bright": "#3060ff", "dark": "#e6c300"}
PARTS, STEPS = 5, 8  # of the picture's side a crop is one; of a crop's side a step is one
FILLED = 0.75  # of the most that any square has of fur; skin shows between hairs
Box = tuple[int, int, int, int]
Pictures, Values = dict[int, Image.Image], dict[int, np.ndarray]


def measured(run: Run) -> tuple[Pictures, Values]:
    """Pictures, and T (H, W) of the fur that they see, NaN elsewhere; by number of maps."""
    scene = lit(f"demo:fur?segments={run.pick(300_000, 100_000, 8_000)}", FROM_THE_LEFT)
    size, map_size = run.pick((800, 800), (800, 800), (60, 60)), run.pick(512, 256, 64)
    ways = {n: published("opacity_shadow_maps", layers=n, filter_radius=1.5) for n in (MANY, FEW)}
    ways[EXACT] = po.technique("exact", filter_radius=1.5)
    images, T = {}, {}
    with renderer(scene, camera(scene, zoom=1.1), size, map_size, antialiasing=1) as used:
        fur = used.image("object_id") == 0
        for maps, technique in ways.items():
            used.technique = technique
            images[maps] = picture(used.render())
            T[maps] = np.where(fur, used.image("transmittance"), np.nan)
    return images, T


def regions(T: np.ndarray) -> dict[str, Box]:
    """The squares full of fur where most light arrives, and least."""
    side = len(T) // PARTS
    places = range(0, len(T) - side, max(1, side // STEPS))
    squares = [(x, y, x + side, y + side) for y in places for x in places]
    within = {box: T[box[1] : box[3], box[0] : box[2]] for box in squares}
    filled = {box: np.isfinite(values).mean() for box, values in within.items()}
    enough = FILLED * max(filled.values())
    mean = {box: float(np.nanmean(within[box])) for box in squares if filled[box] >= enough}
    return {"bright": max(mean, key=mean.__getitem__), "dark": min(mean, key=mean.__getitem__)}


def save_pictures(run: Run, images: Pictures, boxes: dict[str, Box]) -> None:
    """The whole at half its size, and its parts."""
    whole, size = images[MANY], images[MANY].size
    for part, box in boxes.items():
        whole = framed(whole, box, COLORS[part])
    run.save(whole.resize((size[0] // 2, size[1] // 2)), "whole")
    crops = [
        (f"{part}, {maps} maps", images[maps].crop(boxes[part]))
        for part in boxes
        for maps in (MANY, FEW)
    ]
    run.save(sheet(crops, 2), "crops")


def claims(run: Run) -> list[Claim]:
    images, T = measured(run)
    save_pictures(run, images, regions(T[EXACT]))
    where = {"bright": T[EXACT] > BRIGHT, "dark": T[EXACT] < DARK}
    error = {
        (part, maps): po.metrics.rmse(T[maps][mask], T[EXACT][mask])
        for part, mask in where.items()
        for maps in (FEW, MANY)
    }
    told = {
        part: f"{error[part, FEW]:.3f} of {FEW} maps, {error[part, MANY]:.3f} of {MANY}"
        for part in where
    }
    loss = {part: error[part, FEW] - error[part, MANY] for part in where}
    return [
        Claim(
            "few maps show in bright regions",
            "artefacts visible with 6 maps, not with 500",
            f"RMSE of T where bright {told['bright']}",
            error["bright", FEW] > 2.0 * error["bright", MANY],
        ),
        Claim(
            "and less in dark ones",
            "none visible",
            f"RMSE of T where dark {told['dark']}",
            loss["dark"] < 0.5 * loss["bright"],
        ),
    ]


if __name__ == "__main__":
    main(__file__, claims)
