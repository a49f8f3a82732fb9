"""The comparison on everything that a scene can hold, on the maps of the CPU."""

from typing import Any

import numpy as np
import pytest

import pyopacity as po
from pyopacity.comparison import Plan, Result, compare, sample_receivers
from scenes import random_shapes

SMALL: dict[str, Any] = {"device": "cpu", "receivers": 300, "samples": 16, "repeats": 1}


def results_of(scene: po.Scene, **plan: Any) -> list[Result]:
    camera = po.Camera.look_at((0, -8, 0), (0, 0, 0))
    return list(compare(scene, camera, Plan(**{**SMALL, **plan})))


def test_receivers_are_vertices_and_centres() -> None:
    shapes = random_shapes(3)
    scene = po.Scene(shapes, po.DirectionalLight())
    found = sample_receivers(scene, 10**6, seed=0)
    counts = {type(shape): len(indices) for shape, indices in found.chosen[:5]}
    assert counts == {po.Strands: 56, po.Mesh: 9, po.Particles: 10, po.Volume: 60}
    first = 56 + 36 + 9  # of the particles, after strands, veils and stone
    dust, smoke = shapes[3], shapes[4]
    assert isinstance(dust, po.Particles) and isinstance(smoke, po.Volume)
    world = dust.points @ dust.transform[:3, :3].T + dust.transform[:3, 3]
    np.testing.assert_allclose(found.points[first : first + 10], world)
    corner = np.array(smoke.origin) + np.array(smoke.spacing) * (1, 0, 0)
    world = smoke.transform[:3, :3] @ corner + smoke.transform[:3, 3]
    np.testing.assert_allclose(found.points[first + 11], world)
    on_surfaces = found.normals.any(axis=1)
    assert on_surfaces.sum() == 36 + 9 + 2 * 12


@pytest.mark.parametrize("footprint", [0.0, 0.1])
def test_each_light_is_compared(footprint: float) -> None:
    """What casts no shadow tells what it is measured against: T by rays, light after light."""
    dust = random_shapes(4)[3]
    lights = [
        po.DirectionalLight(),
        po.PointLight((0, 0, 3)),
        po.AreaLight((3, 0, 3), (1, 0, 0), (0, 1, 0), 2),
    ]
    scene = po.Scene(dust, lights)
    (row,) = results_of(scene, techniques=("unshadowed",), footprint=footprint)
    T = [
        po.trace_transmittance(scene, dust, light, footprint, 16, indices=np.arange(10))
        for light in range(3)
    ]
    assert row.receivers == 30 and row.footprint == footprint
    assert row.total == po.metrics.errors(np.ones(30), np.concatenate(T))
    assert row.total.rmse > 0.1


def test_a_footprint_grows_with_the_distance_from_the_light() -> None:
    """Two texels of a map that sees a cone are twice as wide at twice the distance."""
    points = np.array([[0, 0, 0], [0, 0, -2], [0.1, 0, -6]], np.float64)
    scene = po.Scene(
        po.Particles(points, 0.05), [po.SpotLight((0, 0, 2), (0, 0, -1), 30), po.DirectionalLight()]
    )
    found = sample_receivers(scene, 10, seed=0)
    with po.Renderer(scene, device="cpu", technique="unshadowed", map_size=64) as renderer:
        found.transmittance(renderer)
        spot, directional = found.texel_sides(renderer)
        texel = 1.0 / np.linalg.norm(renderer._engine.light_from_world(1)[0, :3])
    np.testing.assert_allclose(spot / spot[0], [1.0, 2.0, 4.0], rtol=1e-6)
    np.testing.assert_allclose(directional, texel, rtol=1e-6)
    # The cone's whole opening lies on the map, as far as something casts there.
    assert spot[0] < 2.0 * 2.0 * np.tan(np.radians(15)) / 60


@pytest.mark.parametrize("kind", ["directional", "point", "area"])
def test_surfaces_do_not_darken_their_own_footprint(kind: str) -> None:
    """A leaning ground under a sheet: its rays start in its own plane, toward any light."""
    s = 3.0
    corners = np.array([(-s, -s, -s), (s, -s, s), (s, s, s), (-s, s, -s), (0, 0, 0)], np.float64)
    fan = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    ground = po.Mesh(corners, fan, opacity=0.5)
    light = {
        "directional": po.DirectionalLight((0.0, 0.0, -1.0)),
        "point": po.PointLight((0.0, 0.0, 9.0)),
        "area": po.AreaLight((0.0, 0.0, 9.0), (0.5, 0, 0), (0, 0.5, 0), 2),
    }[kind]
    (row,) = results_of(po.Scene(ground, light), techniques=("unshadowed",), footprint=0.2)
    assert row.total.maximum == 0.0
