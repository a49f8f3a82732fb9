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


@pytest.mark.gl
@pytest.mark.parametrize("map_size", [32, 64, 128])
@pytest.mark.parametrize("distance", [None, 30.0])
def test_a_bowl_that_light_reaches_all_over_has_no_speckles(
    distance: float | None, map_size: int
) -> None:
    """Its triangles rise before each other, at 8 degrees to the light, and none hides another."""
    angle, radius = np.meshgrid(np.linspace(0, 2 * np.pi, 49), np.linspace(0.02, 1.0, 17))
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle), 0.25 * radius**2], axis=-1)
    corner = np.arange(17 * 49).reshape(17, 49)
    a, b, c, d = corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]
    triangles = np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)
    bowl = po.Mesh(points.reshape(-1, 3), triangles)
    along = np.array([np.cos(np.radians(35.0)), 0.0, -np.sin(np.radians(35.0))])
    light = po.DirectionalLight(along) if distance is None else po.PointLight(-distance * along)
    camera = po.Camera.fit([bowl], (0.3, 0.5, -0.8))
    pictures = []
    for name in ("exact", "unshadowed"):
        with po.Renderer(
            po.Scene(bowl, light), camera, (160, 120), name, map_size=map_size, ambient=0.0
        ) as renderer:
            pictures.append(renderer.render()[..., :3])
    seen = pictures[1].max(axis=-1) > 0.0
    assert seen.mean() > 0.2
    assert (np.abs(pictures[0] - pictures[1]).max(axis=-1)[seen] > 0.002).mean() < 0.02
