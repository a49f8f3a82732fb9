"""Leaves with alpha: light passes beside them, and as much of it at every size of the map."""

import numpy as np
import pytest

import pyopacity as po
from scenes import CASTING, TRANSLUCENT

DOWN = (0.0, 0.0, -1.0)
CORNERS = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


def sheet(alpha, mode="mask", opacity=1.0, repeats=1.0, **attributes):
    points = np.c_[2.0 * CORNERS - 1.0, np.zeros(4)]
    return po.Mesh(
        points,
        np.array([[0, 1, 2], [0, 2, 3]]),
        uvs=repeats * CORNERS,
        alpha_map=np.asarray(alpha, np.float32),
        alpha_mode=mode,
        opacity=opacity,
        **attributes,
    )


def behind(shapes, points, name="exact", map_size=64, device="gpu", **parameters):
    scene = po.Scene(shapes, po.DirectionalLight(DOWN))
    technique = po.technique(name, bias=0.0, **parameters)
    with po.Renderer(
        scene, size=(8, 8), technique=technique, map_size=map_size, device=device
    ) as r:
        return r.transmittance(points)


def grid(count, z=-1.0, reach=0.9):
    at = np.linspace(-reach, reach, count)
    return np.stack([*np.meshgrid(at, at), np.full((count, count), z)], -1).reshape(-1, 3)


@pytest.mark.parametrize("name", TRANSLUCENT)
@pytest.mark.parametrize("device", ["gpu", "cpu"])
def test_a_half_opaque_leaf_lets_half_of_the_light_through(needs_gl, name, device):
    for leaf in (sheet(np.full((5, 7), 0.5), "blend"), sheet(np.ones((3, 3)), opacity=0.5)):
        assert np.allclose(behind(leaf, grid(9), name, 50, device), 0.5, atol=1e-5)
        assert np.allclose(behind(leaf, grid(9, z=0.5), name, 50, device), 1.0)


def test_a_mask_is_a_hole_where_it_is_below_the_cutoff(needs_gl):
    alpha = np.array([[0.9, 0.1], [0.49, 0.5]])  # the top row is v = 0, y = -1
    for device in ("gpu", "cpu"):
        t = behind(sheet(alpha, opacity=0.8), grid(2, reach=0.5), map_size=200, device=device)
        assert np.allclose(t, [0.2, 1.0, 1.0, 0.2], atol=1e-5)


@pytest.mark.parametrize("mode", ["mask", "blend"])
@pytest.mark.parametrize("device", ["gpu", "cpu"])
def test_a_far_leaf_neither_thins_nor_thickens(needs_gl, mode, device):
    rng = np.random.default_rng(1)
    alpha = rng.uniform(0, 1, (45, 77)) ** 2  # no power of two
    covered = np.mean(alpha >= 0.5) if mode == "mask" else np.mean(alpha)
    leaf = sheet(alpha, mode, opacity=0.9, repeats=3.0)
    points = grid(150, reach=1.0 - 1.0 / 150)
    means = [
        np.mean(behind(leaf, points, map_size=size, device=device, filter="none"))
        for size in (6, 18, 50, 130, 300)
    ]
    assert np.allclose(means, 1.0 - 0.9 * covered, atol=0.01)


@pytest.mark.parametrize("name", CASTING)
def test_the_cpu_agrees(needs_gl, name):
    rng = np.random.default_rng(2)
    leaf = sheet(rng.uniform(0, 1, (37, 50)), opacity=0.8, repeats=3.0)
    turn = np.array(
        [[0.8, 0.1, 0.6, 0.2], [-0.3, 0.9, 0.1, 0.1], [-0.5, -0.2, 0.8, 0.0], [0, 0, 0, 1]]
    )
    leaf.transform = turn
    points = rng.uniform(-1, 1, (3000, 3))
    parameters = {"split": "linear"} if name == "bounding_opacity_maps" else {}
    for size in (30, 170):
        gpu, cpu = (
            behind(leaf, points, name, size, device, **parameters) for device in ("gpu", "cpu")
        )
        # A texel on an edge within 1/256 texel may be covered in one and not in the other. Moments
        # are solved in float32 and in float64.
        bound = 1e-3 if name == "moment_opacity_maps" else 1e-4
        assert np.mean(np.abs(gpu - cpu) > bound) < 2e-3


@pytest.mark.parametrize("device", ["gpu", "cpu"])
def test_a_far_leaf_half_of_whose_texels_are_cut_lets_half_through(needs_gl, device):
    """At every single point, as its texels are far smaller than the map's."""
    y, x = np.indices((256, 256))
    leaf = sheet((x + y) % 2)
    for size in (8, 20, 33):
        assert np.allclose(
            behind(leaf, grid(9, reach=0.7), map_size=size, device=device), 0.5, atol=0.01
        )


def test_sheets_multiply(needs_gl):
    leaves = [sheet(np.full((2, 2), 0.3), "blend") for _ in range(5)]
    for n, leaf in enumerate(leaves):
        leaf.transform = np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0.1 * n], [0, 0, 0, 1.0]])
    assert np.allclose(behind(leaves, grid(5)), 0.7**5, atol=1e-5)
