"""Figure 3: dark hair of over a million segments: slices, density clustering, deep layers.

demo:hair, wavy, of as many segments as in the paper. Layers have the sizes 1, 2, 3 of a third of
the hair's height.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from common import Claim, Run, main
from deep_opacity_maps._comparison import CLUSTERS, DEEP, NONE, hair, slices

FPS = {NONE: 140, slices(8): 88, slices(256): 0.6, CLUSTERS: 47, DEEP: 74}


def claims(run: Run) -> list[Claim]:
    return hair(run, "wavy", 1_050_000, (0.1, 0.055, 0.03), FPS)


if __name__ == "__main__":
    main(__file__, claims)
