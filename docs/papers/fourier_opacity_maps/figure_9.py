"""Figure 9: hair of 20, 40 and 60 % opacity: 5 Fourier coefficients beside 32 slices.

As in the paper maps are 512 x 512 and averaged over 33 x 33 texels: Fourier's once and for all, and
those of the slices in the look-up, as density too. The hair is demo:hair, and casts alone. Errors
are of T at some points that the picture sees, against exact lists with the same average.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import numpy as np
from common import Claim, Run, main, rises
from common.pictures import picture, sheet
from common.scenes import camera, lit, published, renderer, seen, strands
from fourier_opacity_maps._pairs import FOM, OSM

import pyopacity as po

OPACITIES = (0.2, 0.4, 0.6)
COEFFICIENTS, SLICES = 5, 32
POINTS = 4000


def techniques(radius: float) -> dict[str, po.Technique]:
    average = {"filter": "box", "filter_radius": radius, "filter_domain": "density"}
    return {
        FOM: published(
            "fourier_opacity_maps",
            coefficients=COEFFICIENTS,
            prefilter="box",
            prefilter_radius=int(radius),
        ),
        OSM: published("opacity_shadow_maps", layers=SLICES, **average),
        "exact": po.technique("exact", **average),
    }


def claims(run: Run) -> list[Claim]:
    scene = lit(f"demo:hair?segments={run.pick(150_000, 60_000, 3_000)}")
    for shape in scene.shapes[1:]:
        shape.casts = False
    map_size, radius = run.pick(512, 256, 64), run.pick(16.5, 8.5, 2.5)
    size = run.pick((220, 240), (220, 240), (40, 40))
    shown, error = [], {}
    with renderer(scene, camera(scene), size, map_size, antialiasing=1) as used:
        points = seen(used)
        points = np.ascontiguousarray(points[:: max(1, len(points) // POINTS)])
        for opacity in OPACITIES:
            strands(scene).opacity = opacity
            T = {}
            for name, technique in techniques(radius).items():
                used.technique = technique
                T[name] = used.transmittance(points)
                if name != "exact":
                    shown.append((f"{name}, {100 * opacity:.0f} %", picture(used.render())))
            for name in (FOM, OSM):
                error[name, opacity] = po.metrics.errors(T[name], T["exact"])
    run.save(sheet(shown, 2))
    fom = [error[FOM, opacity].p99 for opacity in OPACITIES]
    osm = [error[OSM, opacity].p99 for opacity in OPACITIES]
    told = (", ".join(f"{value:.3f}" for value in values) for values in (fom, osm))
    return [
        Claim(
            "what Fourier loses grows with opacity",
            "most applicable to low opacity",
            "99th percentile of the error of T at 20, 40, 60 %: FOM {}; OSM {}".format(*told),
            rises(fom),
        )
    ]


if __name__ == "__main__":
    main(__file__, claims)
