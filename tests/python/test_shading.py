"""How surfaces and media answer to light: what comes back, on which side, and how much in all."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pyopacity as po

pytestmark = pytest.mark.gl

ABOVE = po.Camera.look_at((0, 0, 10), (0, 0, 0), up=(0, 1, 0), fov_deg=20)
OPTIONS: dict[str, Any] = {
    "size": (9, 9),
    "map_size": 64,
    "antialiasing": 1,
    "ambient": 0.0,
    "specular": 0.0,
    "technique": "unshadowed",
}


def brightness(shape: po.Shape, direction: tuple[float, float, float], **settings: Any) -> float:
    """Of a shape of colour 1 in the middle of the picture, for all that it covers of it."""
    scene = po.Scene(shape, po.DirectionalLight(direction))
    with po.Renderer(scene, ABOVE, **{**OPTIONS, **settings}) as renderer:
        pixel = renderer.render()[4, 4]
    return float(pixel[0] / pixel[3])


def smoke() -> po.Particles:
    return po.Particles(np.zeros((1, 3)), radius=2.0, opacity=0.5, color=(1, 1, 1))


def tilted(cosine: float, toward: bool = True) -> tuple[float, float, float]:
    """A light's direction whose cosine to the sheet's normal is this."""
    return (float(np.sqrt(1.0 - cosine**2)), 0.0, -cosine if toward else cosine)


@pytest.mark.parametrize("phase", [-0.8, 0.0, 0.5, 0.9])
def test_media_scatter_by_henyey_and_greenstein(phase: float) -> None:
    for cosine in (-1.0, -0.3, 0.4, 1.0):  # of the light's way and the way to the eye
        direction = (float(np.sqrt(1.0 - cosine**2)), 0.0, cosine)
        expected = (1 - phase**2) / (1 + phase**2 - 2 * phase * cosine) ** 1.5
        assert brightness(smoke(), direction, phase=phase) == pytest.approx(expected, rel=1e-3)


def test_the_phase_function_sends_all_light_on() -> None:
    cosine = np.linspace(-1.0, 1.0, 100_001)
    for phase in (-0.9, 0.0, 0.6):
        values = (1 - phase**2) / (1 + phase**2 - 2 * phase * cosine) ** 1.5
        assert np.trapezoid(values, cosine) / 2.0 == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize("wrap", [0.0, 0.5, 1.0])
def test_wrapped_light_is_as_much_as_without(sheet: Callable[..., po.Mesh], wrap: float) -> None:
    ground = sheet(color=(1, 1, 1))
    cosines = np.linspace(-0.95, 0.95, 20)
    seen = [
        brightness(ground, tilted(abs(float(c)), c > 0), wrap=wrap, compositing="opaque")
        for c in cosines
    ]
    expected = np.maximum(0.0, cosines + wrap) / (1.0 + wrap) ** 2
    assert np.abs(np.array(seen) - expected).max() < 1e-5


def test_light_comes_through_a_leaf_from_behind(sheet: Callable[..., po.Mesh]) -> None:
    leaf = sheet(opacity=0.5, color=(1, 1, 1))
    for toward in (True, False):
        assert brightness(leaf, tilted(0.8, toward)) == pytest.approx(1.0, abs=1e-5)
    assert brightness(leaf, tilted(0.8, True), backlight=0.3) == pytest.approx(0.7 * 0.8, abs=1e-5)
    assert brightness(leaf, tilted(0.8, False), backlight=0.3) == pytest.approx(0.24, abs=1e-5)


def test_a_shadow_may_be_shown_in_part(sheet: Callable[..., po.Mesh]) -> None:
    lid, ground = sheet(1.0, opacity=0.6, half_size=5.0), sheet(half_size=1.0, color=(1, 1, 1))
    scene = po.Scene([lid, ground], po.DirectionalLight((0, 0, -1)))
    below = po.Camera.look_at((0, 0.1, 0.5), (0, 0, 0), fov_deg=20)
    options = {**OPTIONS, "technique": "bounding_opacity_maps"}
    for intensity, expected in ((1.0, 0.4), (0.5, 0.7), (0.0, 1.0)):
        with po.Renderer(scene, below, shadow_intensity=intensity, **options) as renderer:
            assert renderer.render()[4, 4, 0] == pytest.approx(expected, abs=1e-4)


def test_a_spot_lights_cone_and_distance(sheet: Callable[..., po.Mesh]) -> None:
    ground = sheet(color=(1, 1, 1), half_size=8.0)
    camera = po.Camera.look_at((0, 0, 10), (0, 0, 0), up=(0, 1, 0), fov_deg=60)
    light = po.SpotLight((0, 0, 4), (0, 0, -1), angle_deg=60, intensity=1.0)
    light.attenuation = (0, 0, 1)
    options = {**OPTIONS, "size": (65, 65)}
    with po.Renderer(po.Scene(ground, light), camera, **options) as renderer:
        row = renderer.render()[32, :, 0]
        points = renderer.receivers().points[32]
    to_light = np.array([0, 0, 4]) - points
    distance = np.linalg.norm(to_light, axis=1)
    cosine = to_light[:, 2] / distance
    inside = cosine > np.cos(np.radians(30 * (1 - light.softness))) + 1e-3
    outside = cosine < np.cos(np.radians(30)) - 1e-3
    assert inside.sum() > 10 and outside.sum() > 10
    assert np.abs(row - cosine / distance**2)[inside].max() < 1e-4
    assert np.abs(row[outside]).max() == 0.0
