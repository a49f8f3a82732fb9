"""Figure 5: opacity maps 1, 6, 14, 26, 40, 52 and 60 of 60, and the depth map of what is opaque.

demo:hair on its bust, slices evenly spaced, 512 x 512 texels; white is opaque. The last picture is
the opaque depth map, near is bright.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import numpy as np
from common import Claim, Run, main, rises
from common.pictures import as_shown, sheet
from common.scenes import lit, published

import pyopacity as po

EQUAL = 1e-6  # behind all hair maps are the same
MAPS, SHOWN = 60, (1, 6, 14, 26, 40, 52, 60)


def read_maps(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Opacity of each map (60, H, W), and the depth of what is opaque (H, W)."""
    scene = lit(f"demo:hair?segments={run.pick(340_000, 100_000, 10_000)}")
    technique = published("opacity_shadow_maps", layers=MAPS)
    with po.Renderer(scene, technique=technique, map_size=run.pick(512, 256, 64)) as renderer:
        renderer.transmittance(np.zeros((1, 3)))
        planes = renderer.read("opacity_shadow_maps/opacity")  # (targets, H, W, 4)
        depth = renderer.read("opaque_depth")
    optical_depth = np.moveaxis(planes, -1, 1).reshape(-1, *planes.shape[1:3])[:MAPS]
    return -np.expm1(-optical_depth.astype(np.float64)), depth


def claims(run: Run) -> list[Claim]:
    maps, depth = read_maps(run)
    step = max(1, depth.shape[0] // 192)
    shown = [(f"i = {i}", as_shown(maps[i - 1, ::step, ::step])) for i in SHOWN]
    shown.append(("opaque depth", as_shown(1.0 - depth[::step, ::step])))
    run.save(sheet(shown, 4))
    covered = maps[-1] > 0.0
    means = [float(maps[i - 1][covered].mean()) for i in SHOWN]
    falls = int(np.count_nonzero(np.diff(maps, axis=0) < 0.0))
    return [
        Claim(
            "maps fill up from the light on",
            "the first nearly empty, the last full",
            "mean opacity " + ", ".join(f"{mean:.2f}" for mean in means),
            rises(means, EQUAL),
        ),
        Claim(
            "a map holds all that lies before it",
            "sums, in any order",
            f"{falls} texels of {maps.size:,} fall from a map to the next",
            falls == 0,
        ),
    ]


if __name__ == "__main__":
    main(__file__, claims)
