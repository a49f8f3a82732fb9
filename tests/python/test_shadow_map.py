"""Binary shadows: opaque scenes are right, and hair is as dark as the papers say."""

import numpy as np
import pytest

import pyopacity as po
from scenes import hair_over_ball, random_shapes, tangle

LIGHT = (0.5, 0.3, -0.8)
DEVICES = pytest.mark.parametrize("device", ["gpu", "cpu"])

pytestmark = pytest.mark.usefixtures("needs_gl")


def answered(
    scene: po.Scene, points: np.ndarray | po.Shape, name: str, device: str = "cpu", **parameters
) -> np.ndarray:
    technique = po.technique(name, **parameters)
    with po.Renderer(scene, technique=technique, map_size=64, device=device) as renderer:
        return renderer.transmittance(points)


def points_in(reach: float) -> np.ndarray:
    return np.random.default_rng(2).uniform(-reach, reach, (5000, 3))


@DEVICES
def test_a_texel_is_dark_behind_the_first_caster_that_takes_any_light(device: str) -> None:
    for scene, reach in (
        (po.Scene(random_shapes(3), po.DirectionalLight(LIGHT)), 2.5),
        (hair_over_ball(), 8.0),
    ):
        points = points_in(reach)
        exact = answered(scene, points, "exact", device, filter="none")
        binary = answered(scene, points, "shadow_map", device, filter="none")
        assert set(binary) == {0.0, 1.0}
        noticed = (exact == 1.0) | (exact < 1.0 - 1e-6)  # what float32 tells from 1
        assert np.mean(noticed) > 0.99
        assert (binary == (exact == 1.0))[noticed].mean() > 0.999


@DEVICES
@pytest.mark.parametrize("filter", ["none", "box", "pcf", "gaussian"])
def test_opaque_scenes_are_those_of_exact(device: str, filter: str) -> None:
    scene = po.Scene(hair_over_ball().shapes[1], po.DirectionalLight(LIGHT))
    points = points_in(4.0)
    binary = answered(scene, points, "shadow_map", device, filter=filter)
    assert np.array_equal(binary, answered(scene, points, "exact", device, filter=filter))
    assert binary.min() == 0.0 and binary.max() == 1.0
    assert ((binary > 0.0) & (binary < 1.0)).any() == (filter != "none")


@DEVICES
def test_a_caster_casts_as_opaque_unless_it_is_invisible(device: str) -> None:
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    sheet = po.Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]), opacity=0.01)
    scene = po.Scene(sheet, po.DirectionalLight((0, 0, -1)))
    points = np.array([[0.1, 0.2, 1.0], [0.1, 0.2, 0.0], [0.1, 0.2, -1.0]])
    assert answered(scene, points, "shadow_map", device).tolist() == [1.0, 1.0, 0.0]
    sheet.opacity = 0.0
    assert answered(scene, points, "shadow_map", device).tolist() == [1.0, 1.0, 1.0]


@DEVICES
def test_the_last_caster_of_all_casts_and_nothing_beyond_it(device: str) -> None:
    """Strands across the light at both ends of its depths: one at 0, one at 1."""
    points = np.array([[-9.0, -4, 5], [9, -4, 5], [-9, 4, -5], [9, 4, -5]])
    strands = po.Strands(points, np.array([0, 2, 4]), width=2.0, opacity=0.5)
    scene = po.Scene(strands, po.DirectionalLight((0, 0, -1)))
    below = np.array([[0.0, -4, -6], [0, 4, -6], [0, 0, -6], [0, 0, -600]])
    T = answered(scene, below, "shadow_map", device, bias=0.0)
    assert T.tolist() == [0.0, 0.0, 1.0, 1.0]


def test_hair_is_far_too_dark() -> None:
    points, offsets = tangle(3, strands=400, step=0.5)
    hair = po.Strands(points, offsets, width=0.05, opacity=0.5)
    scene = po.Scene(hair, po.DirectionalLight(LIGHT))
    truth = answered(scene, hair, "exact")
    binary, layers = (
        answered(scene, hair, "shadow_map"),
        answered(scene, hair, "bounding_opacity_maps"),
    )
    assert np.mean(binary - truth) < -0.2
    assert po.metrics.rmse(binary, truth) > 10.0 * po.metrics.rmse(layers, truth)
