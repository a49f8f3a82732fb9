"""Volumes in the light's maps: extinction integrated along the light, from voxel to voxel."""

import numpy as np
import pytest

import pyopacity as po
from pyopacity.stress import oracle
from scenes import CASTING, SUMS_ALONE, TRANSLUCENT

DIRECTIONS = [
    (0, 0, -1),
    (0, 1, 0),
    (0.5, 0.3, -0.8),
    (-0.9, 0.05, 0.1),
    (1, 1, 1),
    (1e-4, 1.0, 0.3),
]


def unit(v):
    return np.asarray(v, float) / np.linalg.norm(v)


def answered(scene, points, name="exact", map_size=64, device="gpu", **parameters):
    technique = po.technique(name, **parameters)
    with po.Renderer(
        scene, size=(8, 8), technique=technique, map_size=map_size, device=device
    ) as r:
        return r.transmittance(points), r.light_from_world


def cloud(seed=1, size=(9, 12, 15)):
    rng = np.random.default_rng(seed)
    values = rng.uniform(0, 4, size) * (rng.uniform(0, 1, size) > 0.6)
    return po.Volume(values.astype(np.float32), origin=(-1.0, -0.5, 0.3), spacing=(0.1, 0.15, 0.2))


def brute_force(volume, points, direction):
    """Optical depth in front of each point: between all the walls that its light comes through."""
    extinction = np.asarray(volume.extinction, float)
    size = np.array(extinction.shape[::-1])
    step = unit(direction) / np.array(volume.spacing)
    result = np.zeros(len(points))
    for n, p in enumerate(points):
        here = (p - np.array(volume.origin)) / np.array(volume.spacing) + 0.5
        walls = [
            (here[axis] - np.arange(size[axis] + 1)) / step[axis]
            for axis in range(3)
            if step[axis] != 0
        ]
        t = np.sort(np.concatenate([[0.0], *walls]))
        t = t[t >= 0.0]
        middle = 0.5 * (t[1:] + t[:-1])
        voxel = np.floor(here - middle[:, None] * step).astype(int)
        inside = ((voxel >= 0) & (voxel < size)).all(axis=1)
        x, y, z = voxel[inside].T
        result[n] = (extinction[z, y, x] * np.diff(t)[inside]).sum()
    return result


@pytest.mark.parametrize("device", ["gpu", "cpu"])
@pytest.mark.parametrize("direction", DIRECTIONS)
def test_a_slab_lets_exp_sigma_d_through_at_every_angle(needs_gl, device, direction):
    """Inside and behind it, whatever the technique and however many layers."""
    sigma, d = 0.7, unit(direction)
    box = po.Volume(np.full((6, 7, 8), sigma, np.float32), origin=(-7, -6, -5), spacing=(2, 2, 2))
    low, high = np.array([-8.0, -7.0, -6.0]), np.array([8.0, 7.0, 6.0])
    points = np.random.default_rng(5).uniform(-3, 3, (300, 3))
    with np.errstate(divide="ignore", invalid="ignore"):
        way = np.where(d > 0, (points - low) / d, np.where(d < 0, (points - high) / d, np.inf))
    expected = np.exp(-sigma * way.min(axis=1))
    scene = po.Scene(box, po.DirectionalLight(direction))
    for name in TRANSLUCENT:
        # Layers that end before what casts does count the rest of it at their end.
        whole = {"layer_extent": 30.0} if name == "deep_opacity_maps" else {}
        got, _ = answered(scene, points, name, 512, device, bias=0.0, **whole)
        compressed = getattr(po.technique(name), "error_bound", 0.0) + SUMS_ALONE.get(name, 0.0)
        # A texel where the way is steep.
        assert np.abs(got - expected).max() < 3e-3 + compressed, name
    if direction != (0, 0, -1):
        return
    for layers in range(1, 65):
        got, _ = answered(
            scene,
            points,
            "bounding_opacity_maps",
            16,
            device,
            layers=layers,
            split="linear",
            bias=0.0,
        )
        assert np.abs(got - expected).max() < 1e-5, layers


@pytest.mark.parametrize("direction", DIRECTIONS)
@pytest.mark.parametrize("mirrored", [False, True])
def test_exact_equals_a_brute_force_through_the_voxels(needs_gl, direction, mirrored):
    volume = cloud()
    scene = po.Scene(volume, po.DirectionalLight(direction))
    _, matrix = answered(scene, np.zeros((1, 3)), map_size=61)
    # In the middle of texels, where the map's rays run; none of them along a wall.
    rng = np.random.default_rng(6)
    p_ls = np.c_[rng.integers(4, 57, (400, 2)) + 0.5, rng.uniform(0, 1.2, 400)]
    linear = np.linalg.inv(matrix[:3, :3])
    points = (p_ls - matrix[:3, 3]) @ linear.T
    expected = np.exp(-brute_force(volume, points, direction))
    if mirrored:  # the mirrored volume in its mirror image is the same
        mirror = np.diag([1.0, 1.0, -1.0, 1.0])
        size = np.asarray(volume.extinction).shape
        top = volume.origin[2] + (size[0] - 1) * volume.spacing[2]
        turned = po.Volume(
            np.ascontiguousarray(np.asarray(volume.extinction)[::-1]),
            origin=(volume.origin[0], volume.origin[1], -top),
            spacing=volume.spacing,
        )
        turned.transform = mirror
        scene = po.Scene(turned, po.DirectionalLight(direction))
    for device in ("gpu", "cpu"):
        got, _ = answered(scene, points, map_size=61, device=device, bias=0.0)
        error = np.abs(got - expected)
        assert error[p_ls[:, 2] > 1.0].max() < 1e-4
        # Inside, one slab's voxels are spread over the slab: that is one layer of voxels.
        assert error.mean() < 2e-3 and error.max() < 0.1
    assert expected.min() < 0.5


@pytest.mark.parametrize("name", CASTING)
def test_the_cpu_agrees(needs_gl, name):
    scene = po.Scene(cloud(), po.DirectionalLight((0.5, 0.3, -0.8)))
    points = np.random.default_rng(7).uniform(-1.5, 3, (3000, 3))
    parameters = {"split": "linear"} if name == "bounding_opacity_maps" else {}
    for where in (points, scene.shapes[0]):
        gpu, _ = answered(scene, where, name, 90, **parameters)
        cpu, _ = answered(scene, where, name, 90, "cpu", **parameters)
        assert np.abs(gpu - cpu).max() < 1e-4
    assert gpu.min() < 0.7


def test_half_of_a_voxel_does_not_count_at_its_own_centre(needs_gl):
    """Of a column of voxels along the light each counts those before it, and not itself."""
    extinction = np.zeros((6, 3, 3), np.float32)
    extinction[:, 1, 1] = np.array([0.3, 0.5, 0.0, 0.9, 0.2, 0.4])
    column = po.Volume(extinction, spacing=(1, 1, 2))
    scene = po.Scene(column, po.DirectionalLight((0, 0, 1)))
    for name in TRANSLUCENT:
        for device in ("gpu", "cpu"):
            got, _ = answered(scene, column, name, 33, device)
            before = 2.0 * np.r_[0.0, np.cumsum(extinction[:-1, 1, 1])]
            here = np.asarray(got).reshape(6, 3, 3)[:, 1, 1]
            tolerance = 1e-4 if name == "exact" else 0.05 + SUMS_ALONE.get(name, 0.0)
            assert np.abs(here - np.exp(-before)).max() < tolerance, (name, device)


def test_a_scale_keeps_what_the_whole_lets_through(needs_gl):
    results = []
    for scale in (1e-3, 1.0, 1e3):
        volume = cloud()
        volume.transform = np.diag([scale, scale, scale, 1.0])
        scene = po.Scene(volume, po.DirectionalLight((0.5, 0.3, -0.8)))
        results.append(answered(scene, volume)[0])
    assert np.abs(results[0] - results[1]).max() < 1e-4
    assert np.abs(results[2] - results[1]).max() < 1e-4


def test_what_is_empty_is_not_drawn(needs_gl):
    """Bounds lie around the voxels that are not empty."""
    extinction = np.zeros((8, 8, 200), np.float32)
    extinction[3, 4, 150] = 1.0
    volume = po.Volume(extinction)
    scene = po.Scene(volume, po.DirectionalLight((1, 0, 0)))
    with po.Renderer(scene, size=(8, 8), technique="bounding_opacity_maps", map_size=34) as r:
        r.transmittance(np.zeros((1, 3)))
        start = r.read("bounding_opacity_maps/start")
        end = r.read("bounding_opacity_maps/end")
        length = oracle.depth_range(r.light_from_world)
    covered = end > 0.0
    assert covered.sum() == 16  # one voxel is 4 x 4 texels
    assert np.allclose((end - start)[covered] * length, 1.0, atol=1e-3)
