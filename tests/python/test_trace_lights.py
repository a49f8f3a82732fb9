"""Truth by rays toward lights at a place, and toward several."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pyopacity as po
import ray_reference
import scenes

BACKENDS = po.trace_backends()
backends = pytest.mark.parametrize("backend", BACKENDS)
Sheet = Callable[..., po.Mesh]


@pytest.fixture(name="random_shapes")
def shapes_of_each_kind() -> list[po.Shape]:
    return scenes.random_shapes(11)


def points(*xyz: tuple[float, float, float]) -> np.ndarray:
    return np.array(xyz, np.float64).reshape(-1, 3)


def trace(scene: po.Scene, at: Any, **settings: Any) -> np.ndarray:
    return po.trace_transmittance(scene, at, **{"bias": 0.0, **settings})


@backends
def test_only_what_lies_before_the_light_counts(backend: str, sheet: Sheet) -> None:
    scene = po.Scene([sheet(1.0, opacity=0.5), sheet(3.0, opacity=0.5)], po.PointLight((0, 0, 2)))
    at = points((0.1, 0.2, 0), (0.1, 0.2, 1.5), (0.1, 0.2, 2.5), (0.1, 0.2, 4), (0.1, 0.2, 1))
    assert trace(scene, at, backend=backend).tolist() == [0.5, 1.0, 1.0, 0.5, 1.0]
    ceiling = po.Scene(sheet(3.0), po.PointLight((0, 0, 2)))  # opaque, behind the light
    assert trace(ceiling, points((0.3, 0, 0), (0.3, 0, 4))).tolist() == [1.0, 0.0]


@backends
def test_rays_to_a_point_spread(backend: str, sheet: Sheet) -> None:
    """A square of half side 1 at half the way to the light has a shadow of half side 2."""
    scene = po.Scene(sheet(1.0, half_size=1.0, opacity=0.75), po.PointLight((0.5, 0, 2)))
    # The light's foot is at .5: the edge -1 is cast to -2.5, the edge 1 to 1.5.
    at = points((-2.49, 0, 0), (-2.51, 0, 0), (1.49, 0.3, 0), (1.51, 0.3, 0), (0, 1.99, 0))
    assert trace(scene, at, backend=backend).tolist() == [0.25, 1.0, 0.25, 1.0, 0.25]


def test_a_strand_faces_each_ray() -> None:
    """A strand half way to the light has a shadow of twice its width, straight below or aslant."""
    strand = po.Strands(points((-9, 0, 1), (9, 0, 1)), np.array([0, 2]), 0.2, 0.5)
    for x_light in (0.0, 3.0):
        scene = po.Scene(strand, po.PointLight((x_light, 0.0, 2.0)))
        at = points((0, 0.199, 0), (0, 0.203, 0), (0, -0.199, 0), (0, -0.203, 0))
        # Half of .2, seen across a ray that leans by .1 to the side, is .1005 along the ground.
        assert trace(scene, at).tolist() == [0.5, 1.0, 0.5, 1.0]


def test_a_cone_does_not_change_t(sheet: Sheet) -> None:
    shapes = [sheet(1.0, opacity=0.5)]
    at = points((0, 0, 0), (1.5, 0, 0), (50, 0, 0))
    spot = po.SpotLight((0, 0, 2), (0, 0, -1), 20.0)
    point = po.PointLight((0, 0, 2), attenuation=(0, 0, 1))
    assert trace(po.Scene(shapes, spot), at).tolist() == trace(po.Scene(shapes, point), at).tolist()


def test_an_area_light_is_the_mean_of_its_points(random_shapes: list[po.Shape]) -> None:
    area = po.AreaLight((0.5, 1.0, 3.0), (1.5, 0.0, 0.5), (0.0, 1.0, 0.0), samples=3)
    at = np.random.default_rng(3).uniform(-1.5, 1.5, (400, 3))
    steps = (-1 / 3, 0.0, 1 / 3)
    u, v, middle = np.array(area.edge_u), np.array(area.edge_v), np.array(area.position)
    alone = [
        trace(po.Scene(random_shapes, po.PointLight(tuple(middle + a * u + b * v))), at)
        for a in steps
        for b in steps
    ]
    T = trace(po.Scene(random_shapes, area), at)
    np.testing.assert_allclose(T, np.mean(alone, axis=0, dtype=np.float64), atol=1e-6)
    assert 0.2 < T.mean() < 0.9


def test_each_light_is_asked_about_alone(sheet: Sheet) -> None:
    lights = [po.DirectionalLight((0, 0, -1)), po.PointLight((9, 0, 0.5)), po.PointLight((0, 0, 2))]
    scene = po.Scene(sheet(1.0, opacity=0.5), lights)
    T = [trace(scene, points((0, 0.1, 0)), light=i)[0] for i in range(3)]
    assert T == [0.5, 1.0, 0.5]
    with pytest.raises(po.ParameterError, match="light = 3 of 3"):
        trace(scene, points((0, 0, 0)), light=3)


def test_a_light_far_away_is_a_directional_one(random_shapes: list[po.Shape]) -> None:
    direction = np.array((0.36, 0.48, -0.8))
    at = np.random.default_rng(4).uniform(-1.5, 1.5, (500, 3))
    near = trace(po.Scene(random_shapes, po.PointLight(tuple(-1e7 * direction))), at)
    far = trace(po.Scene(random_shapes, po.DirectionalLight(tuple(direction))), at)
    assert np.mean(np.abs(near - far) > 1e-4) < 0.01


# ---- footprints ----


def test_a_footprint_lies_across_the_ray(sheet: Sheet) -> None:
    """Half of it sees the light past the edge of a sheet, wherever the light is."""
    for light in ((0.0, 0.0, 4.0), (3.0, 0.0, 2.5)):
        half = sheet(1.0, half_size=10.0, opacity=0.8)
        half.transform = np.array([[1, 0, 0, 10], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])
        foot = -light[0] / (light[2] - 1.0)  # where the ray through the edge meets the ground
        scene = po.Scene(half, po.PointLight(light))
        T = trace(scene, points((foot, 0, 0)), footprint=0.2, samples=4096)
        assert T[0] == pytest.approx(0.6, abs=0.02)


def test_each_point_may_have_a_footprint_of_its_own(sheet: Sheet) -> None:
    half = sheet(1.0, half_size=10.0, opacity=0.8)
    half.transform = np.array([[1, 0, 0, 10.2], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])
    scene = po.Scene(half, po.DirectionalLight((0, 0, -1)))
    at = points((0, 0, 0), (0, 0, 0), (0, 0, 0))
    T = trace(scene, at, footprint=np.array([0.0, 0.3, 0.8]), samples=64)
    assert T[:2].tolist() == [1.0, 1.0] and T[2] == pytest.approx(1.0 - 0.8 * 0.25, abs=1e-6)
    with pytest.raises(po.ParameterError, match="footprint has 2 entries for 3 points"):
        trace(scene, at, footprint=np.array([0.1, 0.2]))
    with pytest.raises(po.ParameterError, match=r"footprint\[1\]"):
        trace(scene, at, footprint=np.array([0.1, -0.2, 0.3]))


# ---- against the brute force, and one another ----


@pytest.mark.parametrize("kind", ["directional", "point", "spot", "area"])
def test_equals_the_brute_force(kind: str, random_shapes: list[po.Shape]) -> None:
    light = {
        "directional": po.DirectionalLight((0.5, 0.3, -0.8)),
        "point": po.PointLight((0.3, -0.2, 0.4)),  # between the casters
        "spot": po.SpotLight((2.0, 2.0, 1.0), (-1, -1, -0.3)),
        "area": po.AreaLight((0.0, 2.0, 2.0), (1.0, 0.3, 0.0), (0.0, 0.0, 1.0), samples=2),
    }[kind]
    scene = po.Scene(random_shapes, light)
    at = np.random.default_rng(5).uniform(-2.0, 2.0, (60, 3))
    for bias in (0.0, 0.4):
        expected, margin = ray_reference.transmittance(scene, at, bias)
        sure = margin > 1e-9
        assert sure.mean() > 0.95 and np.mean(expected < 1.0) > 0.3
        for backend in BACKENDS:
            T = trace(scene, at, bias=bias, backend=backend)
            np.testing.assert_allclose(T[sure], expected[sure], atol=1e-6)


@pytest.mark.skipif(len(BACKENDS) < 2, reason="one backend is built in")
def test_backends_give_the_same_bits(
    random_shapes: list[po.Shape], same: Callable[..., bool]
) -> None:
    light = po.AreaLight((0.0, 2.0, 2.0), (1.0, 0.3, 0.0), (0.0, 0.0, 1.0), samples=2)
    scene = po.Scene(random_shapes, light)
    at = np.random.default_rng(6).uniform(-2.0, 2.0, (500, 3))
    first, second = (
        trace(scene, at, footprint=0.2, samples=16, backend=backend) for backend in BACKENDS
    )
    assert same(first, second) and 0.0 < first.mean() < 1.0


# ---- a light at any place ----


@backends
def test_a_light_in_an_awkward_place_gives_no_nan(
    backend: str, random_shapes: list[po.Shape]
) -> None:
    at = np.random.default_rng(7).uniform(-1.0, 1.0, (60, 3))
    mesh, *_ = (shape for shape in random_shapes if isinstance(shape, po.Mesh))
    world = mesh.points[0] @ mesh.transform[:3, :3].T + mesh.transform[:3, 3]
    smoke, *_ = (shape for shape in random_shapes if isinstance(shape, po.Volume))
    inside = smoke.transform[:3, 3]
    far = (1e18, -1e18, 1e18)
    for position in (tuple(at[0]), tuple(world), tuple(inside), far, (0.0, 0.0, 0.0)):
        lights = [po.PointLight(position), po.AreaLight(position, (0, 0, 0), (0, 0, 0), 2)]
        scene = po.Scene(random_shapes, lights)
        for light in (0, 1):
            for settings in ({}, {"footprint": 0.5, "samples": 4}, {"bias": 1e18}):
                T = trace(scene, at, light=light, backend=backend, **settings)
                assert np.isfinite(T).all() and T.min() >= 0.0 and T.max() <= 1.0
    here = po.Scene(random_shapes, po.PointLight(tuple(at[0])))
    assert trace(here, at[:1], backend=backend).tolist() == [1.0]
