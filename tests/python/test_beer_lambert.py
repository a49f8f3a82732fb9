"""Uniform slabs of every kind of caster: in one and behind it, T is exp(-sigma d) at every angle.

Of casters strewn at random, sigma is their number in a unit of volume times the area that each
takes away from the light; the mean of T is then exp(-sigma d), whatever a texel is the mean of.
"""

import math
from collections.abc import Callable

import numpy as np
import pytest

import pyopacity as po

# Long enough for light at 80 degrees to the normal, which tilts along x.
LOW, HIGH = np.array([[-8.0, -1.5, 0.0], [8.0, 1.5, 1.0]])
ANGLES_DEG = [-80, -70, -55, -40, -25, -10, 0, 15, 30, 50, 65, 80]
Slab = tuple[po.Shape, float]  # and its sigma


def strewn(count: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).uniform(LOW, HIGH, (count, 3))


def in_a_unit(count: int) -> float:
    return count / float(np.prod(HIGH - LOW))


def voxels() -> Slab:
    size = np.array([7, 6, 5])
    spacing = (HIGH - LOW) / size
    extinction = np.full(size[::-1], 0.5, np.float32)
    return po.Volume(extinction, tuple(LOW + spacing / 2), tuple(spacing)), 0.5


def particles(profile: str, radius: float) -> Slab:
    count, opacity = 20_000, 0.3
    c = (np.arange(10_000) + 0.5) / 10_000  # half chords, on the area 2 pi c dc
    depth = -math.log1p(-opacity) * (c**5 if profile == "metaball" else c)
    area = 2.0 * math.pi * radius**2 * float(np.mean(-np.expm1(-depth) * c))
    slab = po.Particles(strewn(count, 1), radius, opacity, profile=profile)
    return slab, in_a_unit(count) * area


def spheres() -> Slab:
    return particles("sphere", 0.045)


def metaballs() -> Slab:
    return particles("metaball", 0.07)


def sheets() -> Slab:
    """Triangles of every attitude, of which the light sees half of the area in the mean."""
    count, opacity, side = 20_000, 0.3, 0.14
    frames = np.linalg.qr(np.random.default_rng(2).normal(size=(count, 3, 3)))[0]
    corners = np.array([[0.0, 1.0], [-math.sqrt(0.75), -0.5], [math.sqrt(0.75), -0.5]])
    points = strewn(count, 3)[:, None] + side / math.sqrt(3.0) * corners @ frames[:, :2]
    slab = po.Mesh(points.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3), opacity=opacity)
    return slab, in_a_unit(count) * opacity * 0.5 * math.sqrt(3.0) / 4.0 * side**2


def strands() -> Slab:
    """Sticks of every direction, of which the light sees pi / 4 of the length in the mean."""
    count, opacity, length, width = 20_000, 0.3, 0.2, 0.025
    along = np.random.default_rng(4).normal(size=(count, 3))
    along *= 0.5 * length / np.linalg.norm(along, axis=1, keepdims=True)
    middle = strewn(count, 5)
    points = np.stack([middle - along, middle + along], axis=1).reshape(-1, 3)
    slab = po.Strands(points, np.arange(0, 2 * count + 1, 2), width=width, opacity=opacity)
    return slab, in_a_unit(count) * opacity * length * width * math.pi / 4.0


def light_at(angle_deg: float) -> po.DirectionalLight:
    angle = math.radians(angle_deg)
    return po.DirectionalLight((math.sin(angle), 0.0, -math.cos(angle)))


def in_and_below(angle_deg: float) -> np.ndarray:
    """Places to which light comes through the upper side of the slab alone."""
    reach = 1.3 * math.tan(math.radians(angle_deg))
    low = LOW + (0.3 + max(reach, 0.0), 0.3, -1.0)
    high = HIGH - (0.3 + max(-reach, 0.0), 0.3, 0.0)
    at = np.random.default_rng(6).uniform(low, high, (2000, 3))
    at[:, 2] = np.maximum(at[:, 2], -0.2)
    return at


# The kinds, and how far the mean of T may be from that of exp(-sigma d): by the noise of 20,000
# places.
SLABS: dict[Callable[[], Slab], float] = {
    voxels: 1e-3,
    spheres: 0.015,
    metaballs: 0.015,
    sheets: 0.025,
    strands: 0.025,
}


@pytest.mark.parametrize("kind", SLABS, ids=lambda kind: kind.__name__)
def test_a_uniform_slab_lets_exp_sigma_d_through(kind: Callable[[], Slab]) -> None:
    slab, sigma = kind()
    for angle_deg in ANGLES_DEG:
        scene = po.Scene(slab, light_at(angle_deg))
        at = in_and_below(angle_deg)
        way = (1.0 - np.maximum(at[:, 2], 0.0)) / math.cos(math.radians(angle_deg))
        expected = np.exp(-sigma * way)
        technique = po.technique("bounding_opacity_maps", split="linear", bias=0.0)
        T = po.transmittance(scene, at, technique, map_size=256)
        for part in (at[:, 2] < 0.0, at[:, 2] >= 0.0):
            error = np.mean(T[part], dtype=np.float64) - np.mean(expected[part])
            assert abs(error) < SLABS[kind], angle_deg


@pytest.mark.parametrize("angle_deg", ANGLES_DEG)
def test_parallel_sheets_let_the_same_through_at_every_angle(angle_deg: float) -> None:
    """The opacity of a surface is that of a crossing, whatever the angle."""
    square = np.array([(-1.0, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]) * 15.0
    corners = np.concatenate([square + (0, 0, z) for z in np.linspace(0.0, 1.0, 7)])
    first = 4 * np.arange(7)[:, None, None]
    stack = po.Mesh(corners, (first + [[0, 1, 2], [0, 2, 3]]).reshape(-1, 3), opacity=0.2)
    scene = po.Scene(stack, light_at(angle_deg))
    behind = np.array([[0.3, 0.2, -0.5]])
    assert po.transmittance(scene, behind, map_size=512)[0] == pytest.approx(0.8**7, rel=1e-5)
    assert po.trace_transmittance(scene, behind)[0] == pytest.approx(0.8**7, rel=1e-5)
