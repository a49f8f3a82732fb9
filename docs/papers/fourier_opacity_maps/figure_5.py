"""Figure 5: smoke when the bounds of depth grow by 10 %: baseline, inflated, differences.

demo:plume, 7 coefficients or slices. Two particles that stop no light to speak of (opacity 1e-6)
lie in front of and behind the plume, and stretch the map's depths by a tenth. Differences are of T
where the picture looks it up, eight times as bright as they are.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import numpy as np
from common import Claim, Run, main
from common.pictures import as_shown, picture, sheet
from common.scenes import LEFT, camera, lit, renderer
from fourier_opacity_maps._pairs import FOM, OSM, pair

import pyopacity as po

LIGHT = np.array((-0.7, -0.3, -0.7))
INFLATION, CHANNELS, BRIGHTER = 0.1, 7, 8.0


def inflating(scene: po.Scene) -> po.Particles:
    """Two specks on the light's axis, before and behind all that casts."""
    direction = LIGHT / np.linalg.norm(LIGHT)
    smoke = next(shape for shape in scene.shapes if isinstance(shape, po.Particles))
    along = smoke.points @ direction
    middle = smoke.points.mean(axis=0)
    low, high = (float(end) for end in (along.min(), along.max()))
    more = 0.5 * INFLATION * (high - low)
    ends = np.array([low - more, high + more]) - float(middle @ direction)
    specks = po.Particles(middle + ends[:, None] * direction, radius=0.01, opacity=1e-6)
    specks.receives = False
    return specks


def both(run: Run, scene: po.Scene, view: po.Camera) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Picture, and T of what it sees (H, W), by technique."""
    size, map_size = run.pick((200, 260), (200, 260), (30, 40)), run.pick(512, 256, 64)
    options = {"technique": "unshadowed", "antialiasing": 1, "steady": False}
    found = {}
    with renderer(scene, view, size, map_size, **options) as used:
        for name, technique in pair(CHANNELS).items():
            used.technique = technique
            found[name] = used.render(), used.image("transmittance")
    return found


def claims(run: Run) -> list[Claim]:
    scene = lit(f"demo:plume?particles={run.pick(16_000, 16_000, 1_000)}", tuple(LIGHT))
    view, specks = camera(scene, LEFT), inflating(scene)
    base = both(run, scene, view)
    scene.add(specks)
    inflated = both(run, scene, view)
    shown, change, relative = [], {}, {}
    for row, pictures in (("baseline", base), ("bounds + 10 %", inflated)):
        shown += [(f"{name}, {row}", picture(pictures[name][0])) for name in (FOM, OSM)]
    for name in (FOM, OSM):
        before, after = base[name][0][..., :3], inflated[name][0][..., :3]
        differing = np.abs(after - before).mean(axis=2)
        shown.append((f"{name}, difference x {BRIGHTER:g}", as_shown(BRIGHTER * differing)))
        seen = before.mean(axis=2)
        change[name] = float(differing.mean())
        relative[name] = float((differing / np.maximum(seen, 1e-3)).mean())
    run.save(sheet(shown, 2))
    return [
        Claim(
            "Fourier maps change less than slices",
            "smaller differences, and relative ones",
            f"mean difference of the picture FOM {change[FOM]:.5f}, OSM {change[OSM]:.5f}; "
            f"relative {relative[FOM]:.4f}, {relative[OSM]:.4f}",
            change[FOM] < change[OSM] and relative[FOM] < relative[OSM],
        )
    ]


if __name__ == "__main__":
    main(__file__, claims)
