"""Scenes that hold every kind of caster and of light at once: what is skipped, and both devices."""

from collections.abc import Callable

import numpy as np
import pytest

import pyopacity as po
from scenes import CASTING, random_shapes

pytestmark = pytest.mark.gl


def every_kind() -> po.Scene:
    lights = [
        po.DirectionalLight((0.4, 0.3, -0.8)),
        po.PointLight((0.2, 0.1, 0.3), intensity=0.5),  # inside: the faces of a cube
        po.SpotLight((0.0, -4.0, 3.0), (0.0, 0.8, -0.6), 60.0, map_size=100),
        po.AreaLight((1.0, 1.0, 5.0), (0.5, 0.0, 0.0), (0.0, 0.5, 0.0), 2),
    ]
    return po.Scene(random_shapes(12), lights)


def test_skipped_equals_forced(same: Callable[..., bool]) -> None:
    scene = every_kind()
    hair, veils, _, dust, smoke, mask, _, balls = scene.shapes
    directional, point, spot, area = scene.lights
    turned = np.diag([1.2, 0.8, 1.0, 1.0])
    changes: list[Callable[[], object]] = [
        lambda: setattr(spot, "angle_deg", 70.0),
        lambda: setattr(dust, "profile", "metaball"),
        lambda: setattr(point, "position", (0.1, 0.3, 0.2)),
        lambda: setattr(smoke, "extinction", 0.5 * smoke.extinction),
        lambda: setattr(mask, "alpha_cutoff", 0.3),
        lambda: setattr(directional, "direction", (0.1, 0.5, -0.7)),
        lambda: setattr(balls, "radius", 0.3),
        lambda: setattr(area, "color", (1.0, 0.2, 0.1)),
        lambda: setattr(veils, "opacity", 0.4),
        lambda: setattr(hair, "transform", turned),
        lambda: scene.remove(area),
        lambda: setattr(dust, "casts", False),
    ]
    with po.Renderer(scene, size=(40, 30), map_size=48, antialiasing=1) as renderer:
        renderer.render()
        for i, change in enumerate(changes):
            change()
            skipped = renderer.render()
            renderer.invalidate()
            assert same(skipped, renderer.render()), i


@pytest.mark.parametrize("technique", CASTING)
def test_shaders_and_cpp_agree(technique: str) -> None:
    scene = every_kind()
    places = [np.random.default_rng(1).uniform(-2, 2, (1500, 3)), *scene.shapes]
    parameters = {"split": "linear"} if technique == "bounding_opacity_maps" else {}
    found: list[list[np.ndarray]] = []
    for device in ("cpu", "gpu"):
        own = po.technique(technique, **parameters)
        with po.Renderer(scene, technique=own, device=device, map_size=128) as renderer:
            found.append([renderer.transmittance(at, light) for light in range(4) for at in places])
    # Where a triangle's edge passes through a texel's middle, one of them may cover it.
    apart = [np.abs(cpu - gpu) > 1e-3 for cpu, gpu in zip(*found, strict=True)]
    assert np.mean(np.concatenate(apart)) < 0.005
    assert min(T.min() for T in found[0]) < 0.1
