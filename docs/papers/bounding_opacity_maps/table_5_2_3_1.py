"""Table 5.2.3.1: correlation of neighbouring layers and frames a second, for 4 to 32 layers.

The three scenes of the thesis lit from sideways, in its mode, at the ratio that its correlation
picks; frames of 1024 x 768 with maps of 512 x 512, everything anew, medians in turns.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from bounding_opacity_maps import _splits
from bounding_opacity_maps._scenes import thesis_scene
from common import Claim, Run, frame_cost, main, medians_in_turns, rises
from common.scenes import LEFT, camera, published, renderer

COUNTS = (4, 8, 16, 32)
PAPER = {
    "tree": ((0.66, 0.83, 0.92, 0.96), (98, 96, 80, 60)),
    "grass": ((0.72, 0.86, 0.93, 0.96), (65, 64, 53, 40)),
    "dense grass": ((0.72, 0.86, 0.93, 0.96), (49, 47, 43, 34)),
}
SLACK = 0.05  # of what is timed


def correlations(run: Run, name: str) -> list[float]:
    files = run.pick(_splits.SCENES, _splits.SCENES, _splits.SMALLEST)
    size = run.pick(512, 128, 32)
    (scene,) = (s for _, light, s in _splits.scenes({name: files[name]}) if light == "sideways")
    found = []
    for count in COUNTS:
        ratio = _splits.picked(scene, size, "correlation, thesis", count)
        found.append(_splits.mean_correlation(scene, size, count, ratio))
    return found


def frames_a_second(run: Run, name: str) -> list[float]:
    scene = thesis_scene(run, name)
    size, map_size = run.pick((1024, 768), (1024, 768), (48, 36)), run.pick(512, 512, 64)
    with renderer(scene, camera(scene, LEFT), size, map_size, antialiasing=1) as used:

        def cost(layers: int) -> dict[str, float]:
            used.technique = published("bounding_opacity_maps", layers=layers)
            return frame_cost(used)

        ways = {str(n): lambda n=n: cost(n) for n in COUNTS}
        measured = medians_in_turns(ways, run.pick(5, 2, 1))
    return [1e3 / measured[str(n)]["frame"] for n in COUNTS]


def claims(run: Run) -> list[Claim]:
    found = []
    for name, (correlation, fps) in PAPER.items():
        ours, ours_fps = correlations(run, name), frames_a_second(run, name)
        found += [
            Claim(
                f"{name}: correlation rises with the layers, so it cannot choose them",
                ", ".join(f"{value:.2f}" for value in correlation),
                ", ".join(f"{value:.2f}" for value in ours),
                rises(ours),
            ),
            Claim(
                f"{name}: frames a second fall (to {100 * SLACK:.0f} %)",
                ", ".join(map(str, fps)),
                ", ".join(f"{value:.3g}" for value in ours_fps),
                rises(ours_fps[::-1], SLACK),
            ),
        ]
    return found


if __name__ == "__main__":
    main(__file__, claims)
