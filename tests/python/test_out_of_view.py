"""Shapes that the camera cannot see are not drawn, and the picture is the same."""

import numpy as np
import pytest

import pyopacity as po

pytestmark = pytest.mark.gl

LIGHT = po.DirectionalLight((0.3, 0.2, -1.0))


def merged(meshes: list[po.Mesh]) -> po.Mesh:
    """All of them as one shape, which is in view if one of them is."""
    counts = [len(mesh.points) for mesh in meshes]
    firsts = np.cumsum([0, *counts[:-1]])
    triangles = [m.triangles + np.uint32(first) for m, first in zip(meshes, firsts, strict=True)]
    return po.Mesh(np.concatenate([m.points for m in meshes]), np.concatenate(triangles))


@pytest.mark.parametrize("seed", range(6))
def test_pictures_are_those_of_one_shape(seed: int) -> None:
    """Triangles all around the eye, some across its edges; one shape rounds otherwise."""
    random = np.random.default_rng(seed)
    middles = random.normal(size=(60, 1, 3)) * 3.0
    corners = middles + random.uniform(-1.0, 1.0, (60, 3, 3))
    meshes = [po.Mesh(one, np.array([[0, 1, 2]])) for one in corners]
    camera = po.Camera.look_at(
        random.normal(size=3).tolist(),
        random.normal(size=3).tolist(),
        fov_deg=float(random.uniform(10, 120)),
    )
    settings = {"camera": camera, "size": (64, 40), "technique": "unshadowed"}
    with po.Renderer(po.Scene(meshes, LIGHT), **settings) as r:  # type: ignore[arg-type]
        apart = r.render()
        (note,) = {row.note for row in r.report if row.name == "lighting"}
        assert 0 < int(note.split()[0]) < 60 and note.endswith("shapes out of view")
        depth = r.image("depth")
    with po.Renderer(po.Scene(merged(meshes), LIGHT), **settings) as r:  # type: ignore[arg-type]
        np.testing.assert_allclose(apart, r.render(), atol=1e-5)
        np.testing.assert_allclose(depth, r.image("depth"), rtol=1e-4)


def test_what_is_behind_the_eye_changes_no_bit() -> None:
    scene = po.Scene(po.load("demo:hair?segments=500"), LIGHT)
    camera = po.Camera.fit(scene)
    behind = po.Mesh(
        np.array(camera.eye)
        + (np.array(camera.eye) - camera.target) * np.full((3, 1), 0.5)
        + np.eye(3),
        np.array([[0, 1, 2]]),
    )
    with po.Renderer(scene, camera, (64, 48), technique="unshadowed") as r:
        alone = r.render()
        scene.add(behind)
        np.testing.assert_array_equal(alone, r.render())
        assert any("shapes out of view" in row.note for row in r.report)


def test_what_is_out_of_view_still_casts() -> None:
    """A sheet above the picture darkens the ground in it."""
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float64)
    faces = np.array([[0, 1, 2], [0, 2, 3]])
    ground = po.Mesh(square, faces)
    sheet = po.Mesh(square + [0.0, 0.0, 20.0], faces, opacity=0.5)
    scene = po.Scene(ground, sheet, po.DirectionalLight((0.0, 0.0, -1.0)))
    camera = po.Camera.look_at((0.0, -4.0, 3.0), (0.0, 0.0, 0.0), fov_deg=10.0)
    settings = {"size": (16, 12), "ambient": 0.0, "specular": 0.0}
    with po.Renderer(scene, camera, **settings) as r:  # type: ignore[arg-type]
        shadowed = r.render()
        assert {row.note for row in r.report if row.name == "lighting"} == {
            "1 of 2 shapes out of view"
        }
        scene.remove(sheet)
        lit = r.render()
    np.testing.assert_allclose(shadowed[..., :3], 0.5 * lit[..., :3], atol=1e-3)


def test_a_camera_that_turns_finds_them_again() -> None:
    """Lists follow the view: what leaves it and comes back is drawn as before."""
    left, right = (po.load("demo:hair?segments=500")[0] for _ in range(2))
    left.transform = np.array([[1, 0, 0, -300], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])
    scene = po.Scene(left, right, LIGHT)
    with po.Renderer(scene, size=(40, 30), map_size=64) as r:
        pictures = []
        for target in ((-300.0, 0.0, 20.0), (0.0, 0.0, 20.0), (-300.0, 0.0, 20.0)):
            r.camera = po.Camera.look_at((target[0], -100.0, 20.0), target)
            pictures.append(r.render())
            assert any("shapes out of view" in row.note for row in r.report)
        np.testing.assert_array_equal(pictures[0], pictures[2])
        assert pictures[0][..., 3].max() > 0.0 < pictures[1][..., 3].max()


def test_the_last_shape_may_leave() -> None:
    """Nothing in view is the background alone."""
    scene = po.Scene(po.load("demo:hair?segments=500")[0], LIGHT)
    away = po.Camera.look_at((0.0, -100.0, 20.0), (0.0, -200.0, 20.0))
    with po.Renderer(scene, away, (8, 6), background=(0.1, 0.2, 0.3)) as r:
        np.testing.assert_allclose(r.render(), np.broadcast_to([0.1, 0.2, 0.3, 1.0], (6, 8, 4)))
