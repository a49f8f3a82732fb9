"""Several lights: pictures add up, each light has maps of its own, and moves alone."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

import pyopacity as po

pytestmark = pytest.mark.gl

MAPS = "bounding_opacity_maps"


def ran(renderer: po.Renderer) -> set[str]:
    return {row.name for row in renderer.report if row.status == "ran"}


@pytest.fixture
def two_lights(renderer: po.Renderer) -> Iterator[po.Renderer]:
    renderer.scene.add(po.DirectionalLight((-0.6, 0.1, -0.5), (0.2, 0.5, 1.0), 0.7))
    yield renderer


@pytest.mark.parametrize("compositing", ["opaque", "subsets", "sorted", "exact", "maps"])
@pytest.mark.parametrize("antialiasing", [1, 2])
def test_pictures_of_single_lights_add_up(
    two_lights: po.Renderer, compositing: str, antialiasing: int
) -> None:
    two_lights.compositing, two_lights.antialiasing = compositing, antialiasing
    two_lights.ambient = 0.0
    scene = two_lights.scene
    first, second = scene.lights
    both = two_lights.render()
    alone = []
    for other in (first, second):
        scene.remove(other)
        alone.append(two_lights.render())
        scene.add(other)
    assert np.abs(both[..., :3] - (alone[0] + alone[1])[..., :3]).max() < 1e-5
    assert np.array_equal(both[..., 3], alone[0][..., 3])


def test_ambient_light_and_the_background_count_once(two_lights: po.Renderer) -> None:
    two_lights.background = (0.2, 0.4, 0.6)
    for light in two_lights.scene.lights:
        light.intensity = 0.0
    several = two_lights.render()
    two_lights.scene.remove(two_lights.scene.lights)
    assert np.abs(several - two_lights.render()).max() < 1e-6


def test_a_light_moves_only_its_own_passes(two_lights: po.Renderer) -> None:
    two_lights.render()
    two_lights.scene.lights[1].direction = (-0.5, 0.2, -0.5)
    two_lights.render()
    again = ran(two_lights)
    assert {f"light1/{MAPS}/opacity", "light1/lighting", "composition"} <= again
    assert all(name.startswith("light1/") or name == "composition" for name in again)


@pytest.mark.parametrize("compositing", ["sorted", "exact", "maps"])
def test_what_is_translucent_knows_the_lights_apart_too(
    two_lights: po.Renderer, compositing: str
) -> None:
    two_lights.compositing = compositing
    two_lights.render()
    two_lights.scene.lights[1].direction = (-0.5, 0.2, -0.5)
    two_lights.render()
    shared = {"sort_samples", "composition"}
    assert all(name.startswith("light1/") or name in shared for name in ran(two_lights))


def test_a_lights_colour_moves_its_own_shading_alone(two_lights: po.Renderer) -> None:
    two_lights.render()
    two_lights.scene.lights[0].color = (1, 0, 0)
    two_lights.render()
    assert ran(two_lights) == {"lighting", "composition"}


def test_skipped_equals_forced_with_several_lights(
    two_lights: po.Renderer, same: Callable[..., bool]
) -> None:
    third = po.DirectionalLight((0.1, 0.7, -0.5))
    two_lights.render()
    changes: list[Callable[[], object]] = [
        lambda: two_lights.scene.add(third),
        lambda: setattr(third, "map_size", 33),
        lambda: setattr(third, "technique", po.technique("exact")),
        lambda: two_lights.scene.remove(two_lights.scene.lights[0]),
        lambda: setattr(two_lights, "antialiasing", 2),
        lambda: setattr(two_lights, "ambient", 0.5),
    ]
    for change in changes:
        change()
        skipped = two_lights.render()
        two_lights.invalidate()
        assert same(skipped, two_lights.render())


@pytest.mark.parametrize("device", ["gpu", "cpu"])
def test_each_light_has_its_own_transmittance(
    two_lights: po.Renderer, device: Any, small: dict[str, Any]
) -> None:
    scene = two_lights.scene
    points = scene.shapes[0].points
    with po.Renderer(scene, device=device, map_size=64) as both:
        several = [both.transmittance(points, light) for light in range(2)]
    assert np.abs(several[0] - several[1]).max() > 0.1
    for light, there in zip(scene.lights, several, strict=True):
        with po.Renderer(po.Scene(scene.shapes, light), device=device, map_size=64) as alone:
            assert np.array_equal(alone.transmittance(points), there)


def test_a_light_has_its_own_technique_and_map_size(two_lights: po.Renderer) -> None:
    light = two_lights.scene.lights[1]
    light.technique, light.map_size = po.technique("exact"), 32
    two_lights.render()
    assert two_lights.read("light1/exact/count").shape == (32, 32)
    assert two_lights.read(f"{MAPS}/start").shape == (64, 64)


@pytest.mark.parametrize("light", [-1, 2])
def test_a_light_that_is_not_there(two_lights: po.Renderer, light: int) -> None:
    with pytest.raises(po.ParameterError, match=f"light = {light} of 2"):
        two_lights.transmittance(np.zeros((1, 3)), light)
