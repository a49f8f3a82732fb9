"""Surfaces as receivers: each follows its own plane, and none of it shadows the rest."""

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import pyopacity as po
from conftest import ball

Array = npt.NDArray[np.float64]
LIGHTS = {
    "directional": po.DirectionalLight((0.5, 0.3, -0.8)),
    "point": po.PointLight((-4.0, -2.5, 6.0)),
}


def tilted(offset: Array, angle_deg: float, opacity: float, **options: Any) -> po.Mesh:
    """A square of side 2 about a point, turned about the y axis; its triangles wound both ways."""
    angle = np.radians(angle_deg)
    u = np.array([np.cos(angle), 0.0, np.sin(angle)])
    corners = [x * u + (0.0, y, 0.0) + offset for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    triangles = np.array([[0, 1, 2], [0, 3, 2]])
    return po.Mesh(np.array(corners), triangles, opacity=opacity, **options)


@pytest.mark.parametrize("light", LIGHTS)
@pytest.mark.parametrize("angle_deg", [-75.0, -40.0, 0.0, 20.0, 60.0, 80.0])
@pytest.mark.parametrize("opacity", [0.5, 1.0])
@pytest.mark.parametrize("technique", ["exact", "bounding_opacity_maps"])
def test_a_lone_sheet_does_not_shadow_itself(
    light: str, angle_deg: float, opacity: float, technique: str
) -> None:
    sheet = tilted(np.zeros(3), angle_deg, opacity)
    T = po.transmittance(po.Scene(sheet, LIGHTS[light]), sheet, technique, map_size=128)
    assert T.min() > 0.999


@pytest.mark.parametrize("angle_deg", [0.0, 45.0, 70.0])
@pytest.mark.parametrize("texels", [1.0, 2.0])
def test_a_steep_sheet_shadows_what_lies_close_behind_it(angle_deg: float, texels: float) -> None:
    """However much its own depth changes from texel to texel."""
    above = tilted(np.zeros(3), angle_deg, 0.5)
    texel = 2.9 / 256
    middle = np.array([[0.0, 0.0, -texels * texel]])
    below = po.Mesh(tilted(middle[0], angle_deg, 0.5).points * 0.5 + 0.5 * middle, above.triangles)
    scene = po.Scene(above, below, po.DirectionalLight((0.0, 0.0, -1.0)))
    T = po.transmittance(scene, below, "exact", map_size=256)
    assert np.allclose(T, 0.5, atol=1e-3)


@pytest.mark.parametrize("light", LIGHTS)
def test_a_ball_is_lit_up_to_where_it_turns_away(light: str) -> None:
    """Also a coarse one, at whose vertices some faces do; and dark where all of them do."""
    round_one = ball((0.0, 0.0, 0.0), 1.0)
    scene = po.Scene(round_one, LIGHTS[light])
    points = np.asarray(round_one.points, np.float64)
    to_light = -np.array([0.5, 0.3, -0.8])
    if light == "point":
        to_light = np.array([-4.0, -2.5, 6.0]) - points
    to_light = to_light / np.linalg.norm(to_light, axis=-1, keepdims=True)
    cosine = (points * to_light).sum(axis=1)
    T = po.transmittance(scene, round_one, "exact", map_size=256)
    assert T[cosine > 0.08].min() > 0.999
    assert T[cosine < -0.45].max() < 1e-3


def test_points_that_belong_to_no_shape_are_lit_on_an_opaque_slope() -> None:
    """The map moves the surface back for them, since they do not know its plane."""
    slope = tilted(np.zeros(3), 40.0, 1.0)
    scene = po.Scene(slope, po.DirectionalLight((0.0, 0.0, -1.0)))
    random = np.random.default_rng(0)
    corners = np.asarray(slope.points, np.float64)
    a, b = random.uniform(0.05, 0.95, (2, 500, 1))
    points = corners[0] + a * (corners[1] - corners[0]) + b * (corners[3] - corners[0])
    assert po.transmittance(scene, points, "exact", map_size=128).min() == 1.0
