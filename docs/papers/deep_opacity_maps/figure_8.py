"""Figure 8: clustered strands under three layers, seven, and three larger ones.

Strands in wisps that hang beside and behind each other, so that a texel's casters lie far apart.
Three layers of sizes 1, 2, 3 are too few; seven, 1 to 7 of the same unit, reach all that is lit,
and so do three layers that are as deep in all. Errors are of T where the picture looks it up,
against exact lists of the same map.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import numpy as np
from common import Claim, Run, main
from common.pictures import picture, sheet
from common.scenes import published, renderer, seen

import pyopacity as po

WISPS, ALONG = 42, 24  # wisps, and points of a strand
UNIT = 0.036  # of the first layer; the wisps fill about a unit cube
SIZES = {
    "3 layers": [UNIT * k for k in (1, 2, 3)],
    "7 layers": [UNIT * k for k in range(1, 8)],
    "3 larger layers": [UNIT * k * 28 / 6 for k in (1, 2, 3)],
}


def wisps(strands: int, seed: int = 8) -> po.Strands:
    """Strands that bend together, wisp by wisp."""
    random = np.random.default_rng(seed)
    along = np.linspace(0.0, 1.0, ALONG)[None, :, None]
    wisp = random.integers(0, WISPS, strands)
    root = random.uniform((-0.5, -0.4, 0.9), (0.5, 0.4, 1.0), (WISPS, 3))[wisp]
    sway = random.normal(0.0, (0.10, 0.10, 0.0), (WISPS, 3))[wisp]
    phase, waves = random.uniform(0.0, 2 * np.pi, (2, WISPS, 1, 1))
    spread = random.normal(0.0, 0.016, (strands, 3)) * (1.0, 1.0, 0.3)
    curl = 0.03 * np.sin(phase[wisp] + (4.0 + waves[wisp]) * along) * (1.0, -0.6, 0.0)
    fall = along * (0.0, 0.0, -1.0)
    points = (root + spread)[:, None] + fall + along**2 * sway[:, None] + along * curl * 2.0
    offsets = np.arange(strands + 1) * ALONG
    return po.Strands(
        points.reshape(-1, 3), offsets, width=0.004, opacity=0.2, color=(0.55, 0.36, 0.16)
    )


def claims(run: Run) -> list[Claim]:
    scene = po.Scene(wisps(run.pick(4000, 4000, 300)))
    scene.add(po.DirectionalLight((0.5, 0.75, -0.35), intensity=1.4))
    size, map_size = run.pick((280, 320), (280, 320), (40, 40)), run.pick(512, 512, 64)
    shown, error, shaded = [], {}, {}
    view = po.Camera.fit(scene, (0.1, 1.0, -0.1))
    with renderer(scene, view, size, map_size, technique="exact", antialiasing=3) as used:
        points = seen(used)
        exact = used.transmittance(points)
        for name, sizes in SIZES.items():
            used.technique = published(
                "deep_opacity_maps",
                layers=len(sizes),
                layer_sizes=sizes,
                layer_extent=sum(sizes),
            )
            shown.append((name, picture(used.render())))
            found = po.metrics.errors(used.transmittance(points), exact)
            error[name], shaded[name] = found.rmse, found.bias
        used.technique = "exact"
        shown.append(("exact lists", picture(used.render())))
    run.save(sheet(shown, 4))
    few, many, larger = SIZES
    told = ", ".join(f"{name} {shaded[name]:+.3f}" for name in SIZES)
    return [
        Claim(
            "too few layers: dark regions behind the last",
            "dark with 3, not with 7 or 3 larger",
            f"mean error of T: {told}",
            shaded[few] < 2.0 * min(shaded[many], shaded[larger], 0.0) and shaded[few] < 0.0,
        ),
        Claim(
            "larger layers are less accurate than more of them",
            "less accurate",
            ", ".join(f"RMSE {name} {error[name]:.3f}" for name in SIZES),
            error[larger] > error[many],
        ),
    ]


if __name__ == "__main__":
    main(__file__, claims)
