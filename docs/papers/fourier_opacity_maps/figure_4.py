"""Figure 4: 3 and 15 coefficients or slices, maps of 32 x 32 and 512 x 512.

demo:plume of 16,000 particles, as in the paper. Errors are of T at the middle of each particle,
against exact lists of a 512 x 512 map.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from common import Claim, Run, main
from common.pictures import picture, sheet
from common.scenes import LEFT, camera, lit, renderer
from fourier_opacity_maps._pairs import FOM, OSM, pair

import pyopacity as po

LIGHT = (-0.7, -0.3, -0.7)
FEW, MANY, COARSE, FINE = 3, 15, 32, 512


def claims(run: Run) -> list[Claim]:
    scene = lit(f"demo:plume?particles={run.pick(16_000, 16_000, 1_000)}", LIGHT)
    smoke = next(shape for shape in scene.shapes if isinstance(shape, po.Particles))
    size, view = run.pick((230, 300), (230, 300), (30, 40)), camera(scene, LEFT)
    shown, T, fine = [], {}, run.pick(FINE, FINE, 64)
    with renderer(scene, view, size, fine, technique="exact", antialiasing=1) as used:
        exact, right = used.transmittance(smoke), used.render()
        for channels, map_size in ((FEW, fine), (MANY, fine), (MANY, COARSE)):
            used.map_size = map_size
            for name, technique in pair(channels).items():
                used.technique = technique
                label = f"{name} {channels}, {map_size}x{map_size}"
                shown.append((label, picture(used.render())))
                T[name, channels, map_size] = used.transmittance(smoke)
    run.save(sheet([*shown, ("exact lists", picture(right))], 4))

    def error(name: str, channels: int) -> float:
        return po.metrics.rmse(T[name, channels, fine], exact)

    def change(name: str, *other: int) -> float:
        return po.metrics.rmse(T[name, *other], T[name, MANY, fine])

    few, many = ([error(name, count) for name in (FOM, OSM)] for count in (FEW, MANY))
    others = (MANY, COARSE), (FEW, fine)
    coarse, fewer = ([change(name, *other) for name in (FOM, OSM)] for other in others)
    told = ["FOM {:.3f}, OSM {:.3f}".format(*values) for values in (few, many, coarse, fewer)]
    return [
        Claim(
            "15 coefficients or slices beat 3",
            "of 3 only the gross shape is right",
            f"RMSE of T: 3: {told[0]}; 15: {told[1]}",
            all(b < a for a, b in zip(few, many, strict=True)),
        ),
        Claim(
            "coarse maps are softer, and keep the shading",
            "32 x 32 softer than 512 x 512",
            f"RMS change of T from 512 x 512 to 32 x 32: {told[2]}; from 15 to 3: {told[3]}",
            all(a < b for a, b in zip(coarse, fewer, strict=True)),
        ),
    ]


if __name__ == "__main__":
    main(__file__, claims)
