"""Figure 5: curly hair of over 1.5 million segments: slices, density clustering, deep layers.

demo:hair, curly, of as many segments as in the paper. Layers have the sizes 1, 2, 3 of a third of
the hair's height.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from common import Claim, Run, main
from deep_opacity_maps._comparison import CLUSTERS, DEEP, NONE, hair, slices

FPS = {NONE: 104, slices(8): 65, slices(256): 0.5, CLUSTERS: 37, DEEP: 50}


def claims(run: Run) -> list[Claim]:
    return hair(run, "curly", 1_500_000, (0.45, 0.27, 0.12), FPS)


if __name__ == "__main__":
    main(__file__, claims)
