"""Where a picture looks light up: positions in closed form, and what the picture makes of them."""

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import pyopacity as po
from scenes import flat_to_the_light, impersonal

pytestmark = pytest.mark.gl

Array = npt.NDArray[np.float64]
LIGHT = (0.5, 0.3, -0.8)


def rays(camera: po.Camera, width: int, height: int) -> tuple[Array, Array]:
    """The eye, and for each pixel the direction through its centre."""
    world_from_view = np.linalg.inv(camera.view_from_world)
    up = np.tan(np.radians(camera.fov_deg) / 2.0)
    x = (np.arange(width) + 0.5) / width * 2.0 - 1.0
    y = 1.0 - (np.arange(height) + 0.5) / height * 2.0  # from the top
    right, down = np.meshgrid(x * up * width / height, y * up)
    directions = np.stack([right, down, np.full_like(right, -1.0)], axis=-1)
    return world_from_view[:3, 3], directions @ world_from_view[:3, :3].T


@pytest.mark.parametrize("origin", [(0.0, 0.0, 0.0), (1e6, -2e6, 3e5)])
def test_points_lie_where_the_ray_of_the_pixel_meets_a_surface(
    sheet: Callable[..., po.Mesh],
    tuft: Callable[..., po.Strands],
    small: dict[str, Any],
    origin: tuple[float, float, float],
) -> None:
    ground, caster = sheet(half_size=3.0), tuft()
    moved = np.eye(4)
    moved[:3, 3] = origin
    for shape in (ground, caster):
        shape.transform = moved
    camera = po.Camera.look_at(np.add(origin, (2, -3, 4)), np.add(origin, (0.5, 1.5, 0.0)))
    scene = po.Scene(ground, caster, po.DirectionalLight(LIGHT))
    with po.Renderer(scene, camera, **small) as renderer:
        seen = renderer.receivers()
    assert seen.points.shape == (32, 48, 3) and seen.points.dtype == np.float64
    assert seen.bias.dtype == np.float32 and seen.mask.dtype == np.bool_

    eye, directions = rays(camera, 48, 32)
    reach = (origin[2] - eye[2]) / directions[..., 2]
    expected = eye + reach[..., None] * directions
    inside = (np.abs(expected - origin)[..., :2] < 2.9).all(axis=-1) & (reach > 0)
    on_ground = inside & (seen.bias < 0.01)  # the tuft is 0.05 wide
    assert on_ground.sum() > 300 and seen.mask[inside].all()
    assert np.abs(seen.points - expected)[on_ground].max() < 1e-4


def test_on_a_strand_it_is_the_centre_line_with_the_strands_width(small: dict[str, Any]) -> None:
    line = np.array([[-1.0, 0.0, 0.0], [0.5, 0.0, 0.5], [1.0, 0.0, 0.5]])
    scene = po.Scene(po.Strands(line, np.array([0, 3]), width=0.3), po.DirectionalLight(LIGHT))
    camera = po.Camera.look_at((0.0, -4.0, 0.5), (0.0, 0.0, 0.25))
    with po.Renderer(scene, camera, **small) as renderer:
        seen = renderer.receivers()
        covered = renderer.render()[..., 3] > 0.0
    assert np.array_equal(seen.mask, covered) and 20 < covered.sum() < covered.size
    x, y, z = seen.points[covered].T
    assert np.abs(y).max() < 1e-6
    assert np.abs(z - np.interp(x, line[:, 0], line[:, 2])).max() < 1e-5
    assert np.allclose(seen.bias[covered], 0.3)
    assert (seen.points[~covered] == 0.0).all() and (seen.bias[~covered] == 0.0).all()


def test_a_surface_has_the_least_bias(
    sheet: Callable[..., po.Mesh], tuft: Callable[..., po.Strands], small: dict[str, Any]
) -> None:
    strands = tuft()
    scene = po.Scene(sheet(half_size=3.0, opacity=0.0), strands, po.DirectionalLight(LIGHT))
    camera = po.Camera.look_at((0.0, 0.1, 4.0), (0.0, 0.0, 0.0))
    with po.Renderer(scene, camera, **small) as renderer:
        seen = renderer.receivers()
    radius = np.linalg.norm(strands.bounds.max - strands.bounds.min) / 2.0
    found = np.unique(seen.bias[seen.mask])
    assert np.allclose(found, [1e-4 * radius, 0.05], rtol=1e-5)


def test_what_does_not_receive_hides_what_does(
    sheet: Callable[..., po.Mesh], small: dict[str, Any]
) -> None:
    ground, board = sheet(half_size=3.0), sheet(height=1.0, half_size=0.5)
    board.receives = False
    scene = po.Scene(ground, board, po.DirectionalLight(LIGHT))
    camera = po.Camera.look_at((0.0, 0.1, 4.0), (0.0, 0.0, 0.0))
    with po.Renderer(scene, camera, **small) as renderer:
        seen = renderer.receivers()
        board.receives = True
        assert renderer.receivers().mask.all()
    on_board = ~seen.mask
    assert 50 < on_board.sum() < on_board.size
    assert np.abs(seen.points[on_board, 2] - 1.0).max() < 1e-5
    assert np.abs(seen.points[seen.mask, 2]).max() < 1e-5


def test_it_runs_only_when_asked_and_changes_no_picture(
    renderer: po.Renderer, same: Callable[..., bool]
) -> None:
    before = renderer.render()
    rows = {row.name: row.status for row in renderer.report}
    assert rows["receivers"] == "culled"
    renderer.receivers()
    rows = {row.name: row.status for row in renderer.report}
    assert rows["receivers"] == "ran" and rows["lighting"] == "culled"
    assert same(renderer.render(), before)
    renderer.receivers()
    assert renderer.report[-1].status == "cached"


def test_an_empty_scene_has_none(small: dict[str, Any]) -> None:
    with po.Renderer(po.Scene(), **small) as renderer:
        seen = renderer.receivers()
    assert not seen.mask.any() and (seen.points == 0.0).all()


@pytest.mark.parametrize("technique", list(po.techniques()))
def test_shading_is_linear_in_what_is_looked_up_there(
    scene: po.Scene, small: dict[str, Any], technique: str
) -> None:
    """With the technique's own T at the receivers, dark and lit add up to the technique's picture.

    One bias for all, and no own correction: points know no strand of their own. T of each sample,
    not between places along its strand.
    """
    camera = po.Camera.fit(scene.shapes[:2])
    shadows = impersonal(technique, bias=0.05)
    flat_to_the_light(scene)
    T = np.ones((32, 48))
    look_up = {"strand_look_up": "per_sample"}
    with po.Renderer(scene, camera, technique=shadows, **look_up, **small) as renderer:
        picture = renderer.render()
        seen = renderer.receivers()
        T[seen.mask] = renderer.transmittance(seen.points[seen.mask])
        renderer.technique = "unshadowed"
        lit = renderer.render()
    with po.Renderer(po.Scene(scene.shapes), camera, **small) as renderer:
        dark = renderer.render()
    assert T.min() < 0.7 or technique == "unshadowed"
    assert np.abs(dark + T[..., None] * (lit - dark) - picture).max() < 1e-4


def test_a_closed_renderer_is_a_typed_error(renderer: po.Renderer) -> None:
    renderer.close()
    with pytest.raises(po.ContextError, match="closed"):
        renderer.receivers()
