"""Scenes, lights, cameras."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pyopacity as po


def test_a_scene_gives_back_what_was_added(
    tuft: Callable[..., po.Strands], ball: Callable[..., po.Mesh]
) -> None:
    hair, head, light = tuft(), ball(), po.DirectionalLight()
    scene = po.Scene()
    scene.add([hair, head])
    scene.add(light)
    assert scene.shapes == (hair, head) and scene.lights == (light,)
    scene.remove(hair)
    assert scene.shapes == (head,)
    assert np.allclose(scene.bounds.min, head.bounds.min)


def test_what_was_made_in_the_call_is_kept() -> None:
    points = np.array([[0.0, 0, 0], [0, 0, 1]])
    scene = po.Scene(po.Strands(points, np.array([0, 2])), po.DirectionalLight())
    scene.shapes[0].opacity = 0.25
    assert scene.shapes[0].opacity == 0.25


def test_an_empty_scene_has_empty_bounds() -> None:
    assert po.Scene().bounds.empty


@pytest.mark.parametrize("item", [None, "demo:hair", 3, [None], {"a": 1}])
def test_a_scene_holds_shapes_and_lights_only(item: Any, tuft: Callable[..., po.Strands]) -> None:
    scene = po.Scene(tuft())
    with pytest.raises(po.ParameterError, match="scene"):
        scene.add(item)
    assert len(scene.shapes) == 1


def test_nothing_is_added_of_a_list_that_is_partly_wrong(tuft: Callable[..., po.Strands]) -> None:
    scene = po.Scene()
    with pytest.raises(po.ParameterError, match="item 1"):
        scene.add([tuft(), "hair"])
    assert scene.shapes == ()


def test_all_is_added_or_removed_or_nothing(tuft: Callable[..., po.Strands]) -> None:
    hair, other, light = tuft(), tuft(), po.DirectionalLight()
    scene = po.Scene()
    with pytest.raises(po.ParameterError, match="item 2, .* already"):
        scene.add([hair, light, hair])
    assert (scene.shapes, scene.lights) == ((), ())
    scene.add([hair, light])
    with pytest.raises(po.ParameterError, match="item 1, .* already"):
        scene.add([other, light])
    for several in ([hair, other], [light, light]):
        with pytest.raises(po.ParameterError, match="item 1, .* not in the scene"):
            scene.remove(several)
    assert (scene.shapes, scene.lights) == ((hair,), (light,))
    scene.remove([light, hair])
    assert (scene.shapes, scene.lights) == ((), ())


def test_once_is_enough(tuft: Callable[..., po.Strands]) -> None:
    hair = tuft()
    scene = po.Scene(hair)
    with pytest.raises(po.ParameterError, match="already"):
        scene.add(hair)
    scene.remove(hair)
    with pytest.raises(po.ParameterError, match="not in the scene"):
        scene.remove(hair)


def test_light_is_settable() -> None:
    light = po.DirectionalLight(direction=(0, 0, -2), color=(0.1, 0.2, 0.3), intensity=2)
    assert light.direction == (0.0, 0.0, -1.0)
    assert (light.color, light.intensity) == ((0.1, 0.2, 0.3), 2.0)
    light.direction, light.color, light.intensity = np.array([1.0, 0, 0]), [1, 1, 0], 0.5
    assert light.direction == (1.0, 0.0, 0.0)
    assert (light.color, light.intensity) == ((1.0, 1.0, 0.0), 0.5)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("direction", (0, 0, 0)),
        ("direction", (0, 0, np.nan)),
        ("direction", (0, 1)),
        ("direction", "down"),
        ("color", (-1, 0, 0)),
        ("color", (1, 1, 1, 1)),
        ("color", (1, 1e30, 1)),
        ("intensity", -1),
        ("intensity", 1e30),
        ("intensity", np.inf),
        ("intensity", 10**400),
        ("intensity", None),
        ("colour", (1, 1, 1)),
    ],
)
def test_bad_lights(name: str, value: Any) -> None:
    light = po.DirectionalLight()
    before = (light.direction, light.color, light.intensity)
    with pytest.raises(po.ParameterError, match=name):
        setattr(light, name, value)
    assert (light.direction, light.color, light.intensity) == before


def test_camera_looks_where_it_is_told() -> None:
    camera = po.Camera.look_at(eye=(0, -5, 0), target=(0, 0, 0), up=(0, 0, 1), fov_deg=40)
    assert (camera.eye, camera.target, camera.fov_deg) == ((0, -5, 0), (0, 0, 0), 40)
    target = camera.view_from_world @ (0, 0, 0, 1)
    assert np.allclose(target, (0, 0, -5, 1))
    assert camera == po.Camera.look_at((0, -5, 0), (0, 0, 0), fov_deg=40)
    assert camera != po.Camera.look_at((0, -6, 0), (0, 0, 0), fov_deg=40)


def test_fit_sees_every_corner(scene: po.Scene) -> None:
    camera = po.Camera.fit(scene, direction=(0.2, 1, -0.4), fov_deg=50)
    low, high = scene.bounds
    for x in (low[0], high[0]):
        for y in (low[1], high[1]):
            for z in (low[2], high[2]):
                vx, vy, vz, _ = camera.view_from_world @ (x, y, z, 1)
                assert max(abs(vx), abs(vy)) <= -vz * np.tan(np.radians(25))


def test_fit_takes_shapes_and_nothing(scene: po.Scene) -> None:
    near, far = po.Camera.fit(scene.shapes[:2]), po.Camera.fit(scene)
    assert np.linalg.norm(np.subtract(near.eye, near.target)) < np.linalg.norm(
        np.subtract(far.eye, far.target)
    )
    assert po.Camera.fit(scene.shapes[0]) == po.Camera.fit(scene.shapes[:1])
    assert po.Camera.fit(po.Scene()) == po.Camera.fit([])


@pytest.mark.parametrize(
    "arguments",
    [
        {"eye": (0, 0, 0), "target": (0, 0, 0)},
        {"eye": (0, 0, 5), "target": (0, 0, 0), "up": (0, 0, 1)},
        {"eye": (0, 0, np.nan), "target": (0, 0, 0)},
        {"eye": (0, 1, 0), "target": (0, 0, 0), "fov_deg": 0},
        {"eye": (0, 1, 0), "target": (0, 0, 0), "fov_deg": 180},
        {"eye": (0, 1, 0), "target": (0, 0, 0), "fov_deg": "35"},
        {"eye": "here", "target": (0, 0, 0)},
    ],
)
def test_bad_cameras(arguments: dict[str, Any]) -> None:
    with pytest.raises(po.ParameterError):
        po.Camera.look_at(**arguments)


def test_a_camera_does_not_change() -> None:
    camera = po.Camera.look_at((0, 1, 0), (0, 0, 0))
    with pytest.raises(po.ParameterError, match="make another Camera"):
        camera.eye = (0, 2, 0)
