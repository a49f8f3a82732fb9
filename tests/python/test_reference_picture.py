"""The picture with T by rays: what it must equal, and what it refuses."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pyopacity as po
from pyopacity.reference_picture import picture_parts
from scenes import flat_to_the_light, impersonal

pytestmark = pytest.mark.gl

DOWN = (0.0, 0.0, -1.0)


def test_without_casters_it_is_the_unshadowed_picture(scene: po.Scene) -> None:
    for shape in scene.shapes:
        shape.casts = False
    camera = po.Camera.fit(scene.shapes[:2])
    options: dict[str, Any] = {"antialiasing": 3, "compositing": "opaque"}
    with po.Renderer(scene, camera, (48, 32), "unshadowed", **options) as renderer:
        expected = renderer.render()
    assert np.abs(po.traced_picture(scene, camera, (48, 32), 3) - expected).max() < 1e-6


@pytest.mark.parametrize("technique", list(po.techniques()))
def test_with_a_techniques_own_light_it_is_its_picture(scene: po.Scene, technique: str) -> None:
    camera = po.Camera.fit(scene.shapes[:2])
    flat_to_the_light(scene)
    parts = picture_parts(scene, camera, (48, 32), 2)
    shadows = impersonal(technique, bias=0.05)  # points know no strand of their own
    settings: dict[str, Any] = {"map_size": 64, "antialiasing": 2, "compositing": "opaque"}
    settings["strand_look_up"] = "per_sample"
    with po.Renderer(scene, camera, (48, 32), shadows, **settings) as renderer:
        T = renderer.transmittance(parts.points)
        assert np.abs(parts.shaded(T) - renderer.render()).max() < 1e-4


@pytest.mark.parametrize("opacities", [(0.5,), (0.5, 0.25), (1.0,)])
def test_under_sheets_light_is_the_product(
    sheet: Callable[..., po.Mesh], opacities: tuple[float, ...]
) -> None:
    """The ground in view is under all of them: dark + T (lit - dark), with T = product 1 - a."""
    ground = sheet(half_size=3.0, color=(0.5, 0.6, 0.7))
    covers = [sheet(5.0 + i, 9.0, opacity=a) for i, a in enumerate(opacities)]
    light = po.DirectionalLight(DOWN, intensity=0.8)
    camera = po.Camera.look_at((0, -1, 4), (0, 0, 0), fov_deg=30)
    scene = po.Scene(ground, light)
    settings: dict[str, Any] = {"ambient": 0.1, "specular": 0.0}
    lit = po.traced_picture(scene, camera, (16, 12), 2, **settings)
    scene.add(covers)
    shadowed = po.traced_picture(scene, camera, (16, 12), 2, **settings)
    color = np.array([0.5, 0.6, 0.7])
    assert np.allclose(lit[..., :3], color * (0.1 + 0.8), atol=1e-6)
    T = np.prod([1.0 - a for a in opacities])
    assert np.allclose(shadowed[..., :3], color * (0.1 + 0.8 * T), atol=1e-6)


def test_lights_add_up_each_with_its_own_shadow(sheet: Callable[..., po.Mesh]) -> None:
    ground, cover = sheet(half_size=3.0), sheet(5.0, 9.0, opacity=0.5)
    lights = [po.DirectionalLight(DOWN), po.PointLight((0.5, 0, 4)), po.PointLight((0, 1, 9))]
    camera = po.Camera.look_at((0, -1, 4), (0, 0, 0), fov_deg=30)
    settings: dict[str, Any] = {"size": (16, 12), "samples": 2, "specular": 0.0}
    # The sheet is above the first lamp, and below the second.
    T = (0.5, 1.0, 0.5)
    dark = po.traced_picture(po.Scene(ground), camera, **settings)
    expected = dark.astype(np.float64)
    for part, light in zip(T, lights, strict=True):
        lit = po.traced_picture(po.Scene(ground, light), camera, **settings)
        expected += part * (lit - dark)
    scene = po.Scene([ground, cover], lights)
    assert np.allclose(po.traced_picture(scene, camera, **settings), expected, atol=1e-5)


def test_without_a_light_only_ambient_is_left(scene: po.Scene) -> None:
    camera = po.Camera.fit(scene.shapes[:2])
    scene.remove(scene.lights)
    with po.Renderer(scene, camera, (24, 16), antialiasing=2, compositing="opaque") as renderer:
        expected = renderer.render()
    assert np.abs(po.traced_picture(scene, camera, (24, 16), 2) - expected).max() < 1e-6


def test_bias_and_progress_reach_the_rays(scene: po.Scene) -> None:
    camera = po.Camera.fit(scene.shapes[:2])
    told: list[float] = []
    automatic = po.traced_picture(scene, camera, (24, 16), 1, progress=told.append)
    assert told[-1] == 1.0
    far = po.traced_picture(scene, camera, (24, 16), 1, bias=100.0)
    options: dict[str, Any] = {"antialiasing": 1, "compositing": "opaque"}
    with po.Renderer(scene, camera, (24, 16), "unshadowed", **options) as renderer:
        assert np.abs(far - renderer.render()).max() < 1e-6
    assert (automatic <= far + 1e-6).all() and (automatic < far - 0.01).any()


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ({"samples": 0}, "samples"),
        ({"samples": 9}, "samples"),
        ({"samples": 2.0}, "samples"),
        ({"size": (0, 10)}, "1..16384"),
        ({"size": 10}, "size"),
        ({"antialiasing": 2}, "samples"),
        ({"bias": -1.0}, "bias"),
        ({"bias": "wide"}, "bias"),
        ({"frobnicate": 1}, "frobnicate"),
    ],
)
def test_bad_arguments_are_refused(scene: po.Scene, arguments: dict[str, Any], named: str) -> None:
    with pytest.raises(po.ParameterError, match=named):
        po.traced_picture(scene, **{"size": (8, 8), "samples": 1, **arguments})


def test_media_have_no_traced_picture(scene: po.Scene) -> None:
    scene.add(po.Particles(np.zeros((1, 3)), radius=1.0, opacity=0.5))
    with pytest.raises(po.ParameterError, match="along a view"):
        po.traced_picture(scene, size=(8, 8), samples=1)
