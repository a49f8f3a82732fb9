"""Truth by rays through what has extent along them, and through foliage: closed forms."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pyopacity as po
import ray_reference

DOWN = po.DirectionalLight((0.0, 0.0, -1.0))
BACKENDS = po.trace_backends()
backends = pytest.mark.parametrize("backend", BACKENDS)


def points(*xyz: tuple[float, float, float]) -> np.ndarray:
    return np.array(xyz, np.float64).reshape(-1, 3)


def trace(*shapes: po.Shape, at: Any, light: po.Light = DOWN, **settings: Any) -> np.ndarray:
    scene = po.Scene(shapes, light)
    return po.trace_transmittance(scene, at, **{"bias": 0.0, **settings})


def directions(count: int, seed: int = 0) -> np.ndarray:
    d = np.random.default_rng(seed).normal(size=(count, 3))
    return np.concatenate([np.eye(3), -np.eye(3), d / np.linalg.norm(d, axis=1, keepdims=True)])


# ---- particles ----


@backends
def test_a_sphere_stops_light_by_its_chord(backend: str) -> None:
    sphere = po.Particles(points((0, 0, 3)), radius=0.5, opacity=0.6)
    x = np.array([0.0, 0.1, 0.3, 0.4, 0.49, 0.51])
    chord = 2.0 * np.sqrt(np.maximum(0.25 - x**2, 0.0))
    at = np.stack([x, 0.0 * x, 0.0 * x], axis=1)
    np.testing.assert_allclose(trace(sphere, at=at, backend=backend), 0.4**chord, atol=1e-7)


@backends
def test_only_what_lies_in_front_counts(backend: str) -> None:
    sphere = po.Particles(points((0, 0, 3)), radius=0.5, opacity=0.6)
    z = np.array([2.0, 2.5, 2.75, 3.0, 3.4, 3.5, 4.0])
    in_front = np.clip(3.5 - z, 0.0, 1.0)
    at = np.stack([0.0 * z, 0.0 * z, z], axis=1)
    np.testing.assert_allclose(trace(sphere, at=at, backend=backend), 0.4**in_front, atol=1e-7)
    biased = trace(sphere, at=at, backend=backend, bias=0.2)
    np.testing.assert_allclose(biased, 0.4 ** np.clip(3.3 - z, 0.0, 1.0), atol=1e-7)
    lamp = trace(sphere, at=at[:1], backend=backend, light=po.PointLight((0, 0, 2.9)))
    np.testing.assert_allclose(lamp, 0.4**0.4, atol=1e-7)  # a light within it


@backends
def test_a_metaball_stops_light_by_the_integral_of_its_density(backend: str) -> None:
    """Of (1 - r^2)^2 along the ray, in radii; through the middle it is what the opacity says."""
    ball = po.Particles(points((0, 0, 3)), radius=0.5, opacity=0.6, profile="metaball")
    x, z = np.meshgrid([0.0, 0.1, 0.3, 0.4, 0.49, 0.51], [0.0, 2.55, 2.8, 3.0, 3.3, 3.6])
    at = np.stack([x, 0.0 * x, z], axis=-1).reshape(-1, 3)
    along = (np.arange(20_000) + 0.5) / 10_000 - 1.0  # -1 .. 1

    def in_front(p: np.ndarray) -> float:
        density = np.maximum(1.0 - along**2 - (p[0] / 0.5) ** 2, 0.0) ** 2
        return float(density[along > (p[2] - 3.0) / 0.5].sum() / ((1.0 - along**2) ** 2).sum())

    expected = 0.4 ** np.array([in_front(p) for p in at])
    np.testing.assert_allclose(trace(ball, at=at, backend=backend), expected, atol=1e-5)


def test_a_particle_does_not_count_at_its_own_centre() -> None:
    """Its neighbours do, as far as they are in front; so does any other shape that is its copy."""
    dust = po.Particles(points((0, 0, 0), (0, 0, 1), (0, 0, 1.25)), radius=0.5, opacity=0.5)
    in_front = [2.0, 0.75, 0.25]  # of the spheres after, and for the last of the one before
    expected = 0.5 ** np.array(in_front)
    for settings in ({}, {"footprint": 1e-4, "samples": 4}):
        T = trace(dust, at=dust, **settings)
        np.testing.assert_allclose(T, expected, atol=1e-4)
    np.testing.assert_allclose(trace(dust, at=dust, indices=np.array([2, 0])), expected[[2, 0]])
    copy = dust.instance()
    both = 0.5 ** (np.array(in_front) * 2 + 0.5)
    np.testing.assert_allclose(trace(dust, copy, at=dust), both, atol=1e-6)
    np.testing.assert_allclose(trace(dust, at=copy), 0.5 ** (np.array(in_front) + 0.5), atol=1e-6)


def test_a_transform_scales_spheres_and_keeps_what_they_stop() -> None:
    sphere = po.Particles(points((0, 0, 3)), radius=0.5, opacity=0.6)
    sphere.transform = np.diag([2.0, 2.0, 2.0, 1.0])
    at = points((0, 0, 0), (0.8, 0, 0), (1.01, 0, 0))
    np.testing.assert_allclose(trace(sphere, at=at), [0.4, 0.4**0.6, 1.0], atol=1e-7)
    sphere.transform = np.diag([8.0, 1.0, 1.0, 1.0])  # it stays a sphere
    at = points((0, 0, 0), (0.8, 0, 0), (0, 0.8, 0), (1.01, 0, 0))
    np.testing.assert_allclose(trace(sphere, at=at), [0.4, 0.4**0.6, 0.4**0.6, 1.0], atol=1e-7)


def test_spheres_of_no_size_and_of_opacity_0_and_1() -> None:
    dust = po.Particles(
        points((0, 0, 1), (2, 0, 1), (4, 0, 1)),
        np.array([0.0, 0.5, 0.5], np.float32),
        np.array([0.5, 1.0, 0.0], np.float32),
    )
    at = points((0, 0, 0), (2, 0, 0), (4, 0, 0))
    np.testing.assert_allclose(trace(dust, at=at), [1.0, 2.0**-24, 1.0], rtol=1e-5)


def test_a_cloud_of_particles_obeys_beer_and_lambert() -> None:
    """Places at random, N of them in a box of area A and thickness far above their radius r.

    Each of them lets the mean of q(chord) through within its disc, so that the mean of T is
    exp(-N/A pi r^2 (1 - mean q)): q(s) = (1 - o)^(s / 2r), of which the mean over a disc is
    2 (1 - (1 + k) e^-k) / k^2 with k the optical depth through the centre.
    """
    random = np.random.default_rng(8)
    count, radius, opacity, side = 20_000, 0.02, 0.7, 4.0
    at = np.concatenate([random.uniform(-1.0, 1.0, (4000, 2)), np.full((4000, 1), -1.0)], axis=1)
    k = -np.log1p(-opacity)
    stopped = 1.0 - 2.0 * (1.0 - (1.0 + k) * np.exp(-k)) / k**2
    expected = np.exp(-count / side**2 * np.pi * radius**2 * stopped)
    T = []
    for _ in range(3):
        places = random.uniform((-2, -2, 0), (2, 2, 3), (count, 3))
        dust = po.Particles(places, radius, opacity)
        T.append(trace(dust, at=at).astype(np.float64).mean())
    assert np.mean(T) == pytest.approx(expected, abs=0.01)


# ---- voxels ----


@backends
def test_a_slab_of_voxels_is_an_exponential_at_every_angle(backend: str) -> None:
    """Long enough that all rays leave it through its upper side."""
    slab = po.Volume(np.full((8, 6, 6), 0.7, np.float32), (-250, -250, 0.125), (100, 100, 0.25))
    tilt = np.linspace(-1.45, 1.45, 41)
    for angle in tilt:
        light = po.DirectionalLight((np.sin(angle), 0.4 * np.sin(angle), -np.cos(angle)))
        slope = abs(light.direction[2])
        at = points((0.3, 0.2, -0.5), (1.7, -3.3, 0.0), (0, 0, 0.6), (0, 0, 2))
        expected = np.exp(-0.7 * np.array([2.0, 2.0, 1.4, 0.0]) / slope)
        T = trace(slab, at=at, light=light, backend=backend)
        np.testing.assert_allclose(T, expected, rtol=1e-5)


@pytest.mark.parametrize("size", [(1, 1, 1), (20, 9, 33)])
def test_voxels_of_one_extinction_are_one_box(size: tuple[int, int, int]) -> None:
    """Whatever the direction, along an edge or through a corner: extinction times chord."""
    box = po.Volume(
        np.full(size, 1.3, np.float32), 0.5 / np.array(size)[::-1], 1 / np.array(size)[::-1]
    )
    inside = np.random.default_rng(2).uniform(0.0, 1.0, (50, 3))
    inside[0] = 0.5
    for d in directions(20):
        with np.errstate(divide="ignore"):
            chord = np.where(d < 0, (1.0 - inside) / -d, np.where(d > 0, inside / d, np.inf))
        T = trace(box, at=inside, light=po.DirectionalLight(tuple(d)))
        np.testing.assert_allclose(T, np.exp(-1.3 * chord.min(axis=1)), atol=1e-6)


def test_empty_space_is_skipped_and_nothing_else() -> None:
    """Full voxels here and there in many bricks of 8^3, one of them alone in its brick."""
    random = np.random.default_rng(3)
    density = (random.uniform(size=(41, 23, 33)) < 0.02).astype(np.float32)
    density[:, :, 8:24] = 0.0
    density[0, 0, 0] = 2.0
    smoke = po.Volume(density, (-16, -11, -20))
    at = random.uniform(-16, 16, (60, 3))
    for direction in ((0.3, -0.5, 0.8), (-1.0, 0.02, 0.01), (0.2, 0.9, -0.1)):
        scene = po.Scene(smoke, po.DirectionalLight(direction))
        expected, _ = ray_reference.transmittance(scene, at, 0.0)
        assert np.mean(expected < 1.0) > 0.1
        np.testing.assert_allclose(po.trace_transmittance(scene, at, bias=0.0), expected, atol=1e-6)


def test_at_its_own_centre_half_of_a_voxel_does_not_count() -> None:
    density = np.random.default_rng(5).uniform(0, 1, (4, 3, 2)).astype(np.float32)
    smoke = po.Volume(density, spacing=(0.5, 0.5, 0.25))
    in_front = np.cumsum(density[::-1], axis=0)[::-1] - density
    T = trace(smoke, at=smoke).reshape(4, 3, 2)
    np.testing.assert_allclose(T, np.exp(-0.25 * in_front), atol=1e-6)
    # Aslant its own chord is longer, and may end where the neighbour above it begins.
    light = po.DirectionalLight((-1.0, 0.0, -1.0))
    alone = po.Volume(np.full((1, 1, 1), 9.0, np.float32), (1.0, 2.0, 3.0), (1.0, 4.0, 2.0))
    assert trace(alone, at=alone, light=light).tolist() == [1.0]
    pair = po.Volume(np.full((2, 1, 2), 0.8, np.float32))
    T = trace(pair, at=pair, light=light)
    np.testing.assert_allclose(T, [np.exp(-0.8 * np.sqrt(2.0)), 1.0, 1.0, 1.0], atol=1e-6)


def test_a_scale_keeps_what_a_volume_lets_through() -> None:
    """Extinction is per unit of the shape's own length, along each direction."""
    smoke = po.Volume(np.full((2, 2, 2), 0.5, np.float32))
    smoke.transform = np.diag([1.0, 1.0, 10.0, 1.0])
    T = trace(smoke, at=points((0.2, 0.3, -9), (0.2, 0.3, 5)))
    np.testing.assert_allclose(T, np.exp([-0.5 * 2.0, -0.5 * 1.0]), atol=1e-6)


# ---- foliage ----


def leaf(alpha: Any, mode: str, opacity: float = 1.0, uv: float = 1.0) -> po.Mesh:
    """A square from (0, 0) to (1, 1) at the height 1, its map's top left corner at (0, 1)."""
    corners = points((0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    uvs = np.array([[0, uv], [uv, uv], [uv, 0], [0, 0]], np.float32)
    return po.Mesh(
        corners,
        np.array([[0, 1, 2], [0, 2, 3]]),
        opacity=opacity,
        uvs=uvs,
        alpha_map=np.asarray(alpha, np.float32),
        alpha_mode=mode,
    )


@backends
def test_a_half_opaque_leaf_lets_half_through(backend: str) -> None:
    at = np.random.default_rng(1).uniform((0.01, 0.01, 0), (0.99, 0.99, 0), (50, 3))
    half = leaf([[0.5]], "blend")
    np.testing.assert_allclose(trace(half, at=at, backend=backend), 0.5, atol=1e-7)
    full = leaf([[0.5]], "mask", opacity=0.5)
    np.testing.assert_allclose(trace(full, at=at, backend=backend), 0.5, atol=1e-7)
    footprint = {"footprint": 0.01, "samples": 4}
    np.testing.assert_allclose(trace(half, at=at, backend=backend, **footprint), 0.5, atol=0.02)


def test_an_alpha_map_lies_as_pictures_do() -> None:
    """Its top row where v is 0; the middle of a texel is that texel, between two it is linear."""
    alpha = [[0.1, 0.2, 0.3, 0.4], [0.5, 0.6, 0.7, 0.8]]
    blend = leaf(alpha, "blend")
    x, y = np.meshgrid((np.arange(4) + 0.5) / 4, [0.75, 0.25])
    middles = np.stack([x, y, 0 * x], axis=-1).reshape(-1, 3)
    np.testing.assert_allclose(1 - trace(blend, at=middles), np.ravel(alpha), atol=1e-6)
    between = points((0.25, 0.75, 0), (0.5, 0.5, 0), (0.0001, 0.75, 0))
    T = trace(blend, at=between)
    np.testing.assert_allclose(1 - T, [0.15, 0.45, 0.25], atol=1e-3)  # the last: it repeats
    twice = leaf(alpha, "blend", uv=2.0)
    np.testing.assert_allclose(trace(twice, at=0.5 * middles), trace(blend, at=middles), atol=1e-6)


def test_a_mask_decides_by_texel_and_then_blends() -> None:
    alpha = [[0.49, 0.5, 1.0, 0.0]]
    mask = leaf(alpha, "mask")
    x = np.array([0.125, 0.25, 0.375, 0.5, 0.75, 0.875])
    at = np.stack([x, 0.5 + 0 * x, 0 * x], axis=1)
    expected = [0.0, 0.5, 1.0 - 2.0**-24, 1.0 - 2.0**-24, 0.5, 0.0]
    np.testing.assert_allclose(1 - trace(mask, at=at), expected, atol=1e-6)
    mask.alpha_cutoff = 0.6
    assert trace(mask, at=at)[2] == 1.0
    mask.alpha_mode = "opaque"
    assert trace(mask, at=at).tolist() == [0.0] * 6


# ---- all together ----


@backends
def test_kinds_multiply(backend: str, sheet: Callable[..., po.Mesh]) -> None:
    shapes = [
        sheet(1.0, opacity=0.5),
        po.Particles(points((0, 0, 2)), radius=0.5, opacity=0.2),
        po.Volume(np.full((1, 1, 1), 0.3, np.float32), (0, 0, 4)),
        po.Strands(points((-1, 0, 6), (1, 0, 6)), np.array([0, 2]), 0.2, 0.25),
        leaf([[0.4]], "blend"),
    ]
    expected = 0.5 * 0.8 ** (2.0 * np.sqrt(0.25 - 0.0005)) * np.exp(-0.3) * 0.75 * 0.6
    T = trace(*shapes, at=points((0.01, 0.02, 0)), backend=backend)
    np.testing.assert_allclose(T, expected, rtol=1e-6)


def test_indices_choose_among_a_shapes_points(sheet: Callable[..., po.Mesh]) -> None:
    cover = sheet(1.0, half_size=1.0, opacity=0.5)
    floor = sheet(0.0, half_size=0.5)
    floor.transform = np.eye(4) + 0.8 * np.eye(4, k=3)  # along x
    scene = po.Scene(cover, floor, DOWN)
    every = po.trace_transmittance(scene, floor)
    some = po.trace_transmittance(scene, floor, indices=np.array([3, 0, 3]))
    assert some.tolist() == every[[3, 0, 3]].tolist()
    assert len(po.trace_transmittance(scene, floor, indices=np.empty(0, int))) == 0
    with pytest.raises(po.ParameterError, match=r"indices\[1\] = 4 of 4 points"):
        po.trace_transmittance(scene, floor, indices=np.array([0, 4]))
    with pytest.raises(po.ParameterError, match="indices"):
        po.trace_transmittance(scene, points((0, 0, 0)), indices=np.array([0]))
