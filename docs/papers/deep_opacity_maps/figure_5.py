"""Figure 5: curly hair of over 1.5 million segments: slices, density clustering, deep layers.

demo:hair, curly, of as many segments as in the paper. Layers have the sizes 1, 2, 3 of a third of
the hair's height.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from common import Claim, Run, main
from common.scenes import lit, strands
from deep_opacity_maps._comparison import CLUSTERS, DEEP, NONE, compared, slices

import pyopacity as po

FPS = {NONE: 104, slices(8): 65, slices(256): 0.5, CLUSTERS: 37, DEEP: 50}
COLOR = (0.45, 0.27, 0.12)


def claims(run: Run) -> list[Claim]:
    scene = lit(f"demo:hair?style=curly&segments={run.pick(1_500_000, 60_000, 3_000)}")
    strands(scene).color = COLOR
    return compared(run, scene, po.Camera.fit(strands(scene)), FPS, 8, 256)


if __name__ == "__main__":
    main(__file__, claims)
