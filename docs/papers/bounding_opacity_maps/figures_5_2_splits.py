"""Figures 5.2.3, 5.2.3.7: linear and logarithmic splits; more linear layers begin like few others.

Where the planes lie is read off a map: a thousand equal sheets fill the depths, so that the optical
depth before a plane, over that of all, is its place. Drawn are the closed form and the table that
the thesis uploads (paper_lut), whose last logarithmic layer holds half of the depths.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import numpy as np
from common import Claim, Run, main
from common.chart import chart
from common.pictures import sheet
from common.scenes import published, sheets

import pyopacity as po

SHEETS, FEW = 1000, 8


def places(split: str, layers: int, **parameters: bool) -> np.ndarray:
    """Of the planes behind each layer, in 0 .. 1 of the depths."""
    casting = sheets((np.arange(SHEETS) + 0.5) / SHEETS, np.full(SHEETS, 0.001))
    scene = po.Scene(casting, po.DirectionalLight((0, 0, -1)))
    technique = published("bounding_opacity_maps", layers=layers, split=split, **parameters)
    with po.Renderer(scene, technique=technique, device="cpu", map_size=16) as used:
        used.transmittance(np.zeros((1, 3)))
        planes = used.read("bounding_opacity_maps/opacity")[:, 8, 8, :].reshape(-1)[:layers]
    return planes / planes[-1]


def claims(run: Run) -> list[Claim]:
    numbers = np.arange(1, 33)
    lines = {
        "linear": (numbers, places("linear", 32)),
        "logarithmic": (numbers, places("logarithmic", 32)),
        "logarithmic, table of the thesis": (numbers, places("logarithmic", 32, paper_lut=True)),
    }
    curves = chart(lines, "layer of 32", "where it ends", (0.0, 1.0), dots=False)
    counts = (FEW, 16, 32, 64)
    first = {n: float(places("linear", n)[0]) for n in counts}
    logarithmic = places("logarithmic", FEW)
    begin = {f"linear, {n}": (np.arange(1, 5), places("linear", n)[:4]) for n in counts[1:]}
    begin[f"logarithmic, {FEW}"] = (np.arange(1, 5), logarithmic[:4])
    run.save(sheet([("5.2.3", curves), ("5.2.3.7", chart(begin, "layer", "where it ends"))], 2))
    denser = bool(np.all(places("logarithmic", FEW)[:-1] < places("linear", FEW)[:-1]))
    away = [abs(first[n] - logarithmic[0]) for n in counts]
    told = ", ".join(f"{value:.4f} of {n}" for n, value in first.items())
    return [
        Claim(
            "logarithmic layers lie denser at the beginning",
            "higher density of layers there",
            f"the first of {FEW} ends at {logarithmic[0]:.4f}, linear {first[FEW]:.4f}",
            denser,
        ),
        Claim(
            "linear splits of more layers begin like a logarithmic one of fewer",
            "the first planes are similar",
            f"the first linear layer ends at {told}; the first of {FEW} logarithmic ones at "
            f"{logarithmic[0]:.4f}",
            all(after < before for before, after in zip(away[:-1], away[1:], strict=True)),
        ),
    ]


if __name__ == "__main__":
    main(__file__, claims)
