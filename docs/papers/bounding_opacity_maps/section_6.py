"""Tables 6.1.1, 6.2.1, 6.3.1, figure 6.3.1: frames a second of the three techniques, by layers.

The thesis's three scenes lit from sideways, everything anew each frame, 1024 x 768 pixels, maps of
512 x 512, techniques as published without a search, in turns, medians. Frames a second are those of
this machine, in software of one core; told is their order, and how bounding maps' extra pass fades
into the rest.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from bounding_opacity_maps._scenes import thesis_scene
from common import Claim, Run, frame_cost, main, medians_in_turns, rises
from common.chart import chart
from common.pictures import sheet
from common.scenes import LEFT, camera, published, renderer

COUNTS = (4, 8, 16, 32)
NAMES = {"OSM": "opacity_shadow_maps", "DOM": "deep_opacity_maps", "BOM": "bounding_opacity_maps"}
PAPER = {  # by scene and technique: frames a second of 4, 8, 16, 32 layers
    "tree": {
        "OSM": (147.58, 124.85, 86.68, 53.80),
        "DOM": (112.10, 90.66, 63.96, 43.90),
        "BOM": (73.41, 67.53, 58.91, 41.88),
    },
    "grass": {
        "OSM": (137.53, 110.00, 73.87, 39.83),
        "DOM": (77.38, 60.56, 47.93, 29.45),
        "BOM": (61.18, 55.13, 46.96, 31.93),
    },
    "dense grass": {
        "OSM": (107.76, 79.91, 59.53, 36.58),
        "DOM": (70.53, 61.23, 41.85, 27.28),
        "BOM": (49.80, 43.61, 34.66, 26.80),
    },
}
SLACK = 0.08  # of what is timed
Rates = dict[str, tuple[float, ...]]


def measured(run: Run, name: str) -> Rates:
    """Frames a second by technique."""
    scene = thesis_scene(run, name)
    size, map_size = run.pick((1024, 768), (1024, 768), (48, 36)), run.pick(512, 512, 64)
    with renderer(scene, camera(scene, LEFT), size, map_size, antialiasing=1) as used:

        def cost(short: str, layers: int) -> dict[str, float]:
            fixed = {"layer_extent": 1.0} if short == "DOM" else {}
            used.technique = published(NAMES[short], layers=layers, **fixed)
            return frame_cost(used)

        ways = {f"{s} {n}": lambda s=s, n=n: cost(s, n) for s in NAMES for n in COUNTS}
        found = medians_in_turns(ways, run.pick(5, 2, 1))
    return {s: tuple(1e3 / found[f"{s} {n}"]["frame"] for n in COUNTS) for s in NAMES}


def table(name: str, ours: Rates) -> list[Claim]:
    def told(rates: Rates) -> str:
        return "; ".join(f"{s} " + ", ".join(f"{v:.3g}" for v in rates[s]) for s in NAMES)

    paper = PAPER[name]
    over = [[d / b for d, b in zip(r["DOM"], r["BOM"], strict=True)] for r in (paper, ours)]
    growth = [r["DOM"][0] / r["DOM"][-1] for r in (paper, ours)]
    ordered = all(
        osm * (1 + SLACK) > dom and dom * (1 + SLACK) > bom
        for osm, dom, bom in zip(*(ours[s] for s in NAMES), strict=True)
    )
    return [
        Claim(
            f"{name}: frames a second fall with the layers, and OSM, DOM, BOM in this order (to "
            f"{100 * SLACK:.0f} %)",
            told(paper),
            told(ours),
            ordered and all(rises(ours[s][::-1], SLACK) for s in NAMES),
        ),
        Claim(
            f"{name}: time of a frame, BOM over DOM, falls with layers (by {100 * SLACK:.0f} %)",
            ", ".join(f"{value:.2f}" for value in over[0]),
            ", ".join(f"{value:.2f}" for value in over[1]),
            rises(over[1][::-1], SLACK) and over[1][-1] < (1 - SLACK) * over[1][0],
            why="bounding maps' extra pass fades only as far as layers make a frame dearer: a deep "
            f"frame of 32 over one of 4 takes {growth[1]:.2f} here, {growth[0]:.2f} in the thesis",
        ),
    ]


def claims(run: Run) -> list[Claim]:
    found, charts = [], []
    for name in PAPER:
        ours = measured(run, name)
        found += table(name, ours)
        lines = {s: (COUNTS, ours[s]) for s in NAMES}
        charts.append((name, chart(lines, "layers", "frames a second", size=(300, 230))))
    run.save(sheet(charts, 3))
    return found


if __name__ == "__main__":
    main(__file__, claims)
