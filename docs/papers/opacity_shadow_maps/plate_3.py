"""Plate 3: fur of 6 and of 500 maps; artefacts show in bright regions, and with few maps only.

demo:fur under one light from the left. Crops are of a bright and of a dark region (blue and yellow
in the whole picture). Errors are of T where the picture looks it up, against the exact lists of the
same map: bright is where these say more than .5, dark where less than .1.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from common import Claim, Run, main
from common.pictures import framed, picture, sheet
from common.scenes import camera, lit, published, renderer, seen

import pyopacity as po

FEW, MANY = 6, 500
FROM_THE_LEFT = (0.85, 0.35, -0.45)
BRIGHT, DARK = 0.5, 0.1
# Of the picture: left, top, right, bottom.
CROPS = {"bright": (0.1, 0.36, 0.35, 0.61), "dark": (0.6, 0.44, 0.85, 0.69)}
COLORS = {"bright": "#3060ff", "dark": "#e6c300"}


def box(part: str, size: tuple[int, int]) -> tuple[int, int, int, int]:
    left, top, right, bottom = CROPS[part]
    width, height = size
    return int(left * width), int(top * height), int(right * width), int(bottom * height)


def measured(run: Run) -> tuple[dict, dict]:
    """Pictures, and T where they look it up, by number of maps and of exact lists."""
    scene = lit(f"demo:fur?segments={run.pick(300_000, 100_000, 8_000)}", FROM_THE_LEFT)
    size, map_size = run.pick((800, 800), (800, 800), (60, 60)), run.pick(512, 256, 64)
    ways = {n: published("opacity_shadow_maps", layers=n, filter_radius=1.5) for n in (MANY, FEW)}
    images, T = {}, {}
    with renderer(scene, camera(scene, zoom=1.1), size, map_size, antialiasing=1) as used:
        points = seen(used)
        for name, technique in {**ways, "exact": po.technique("exact", filter_radius=1.5)}.items():
            used.technique = technique
            images[name] = picture(used.render())
            T[name] = used.transmittance(points)
    return images, T


def save_pictures(run: Run, images: dict) -> None:
    """The whole at half its size, and its parts."""
    whole, size = images[MANY], images[MANY].size
    for part, color in COLORS.items():
        whole = framed(whole, box(part, size), color)
    run.save(whole.resize((size[0] // 2, size[1] // 2)), "whole")
    crops = [
        (f"{part}, {maps} maps", images[maps].crop(box(part, size)))
        for part in CROPS
        for maps in (MANY, FEW)
    ]
    run.save(sheet(crops, 2), "crops")


def claims(run: Run) -> list[Claim]:
    images, T = measured(run)
    save_pictures(run, images)
    where = {"bright": T["exact"] > BRIGHT, "dark": T["exact"] < DARK}
    error = {
        (part, maps): po.metrics.rmse(T[maps][mask], T["exact"][mask])
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
