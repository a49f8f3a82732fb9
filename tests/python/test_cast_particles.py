"""Particles in the light's maps: coverage of the disc times chord, whatever the map's size."""

import math

import numpy as np
import pytest

import pyopacity as po
from pyopacity.stress import oracle
from scenes import CASTING

DOWN = (0.0, 0.0, -1.0)


def seen(
    scene: po.Scene, technique: po.Technique, map_size: int, device: str = "gpu"
) -> po.Renderer:
    return po.Renderer(scene, size=(8, 8), technique=technique, map_size=map_size, device=device)


def covered_area(radius: float, opacity: float, profile: str = "sphere") -> float:
    """The integral of 1 - T over the disc: half chords c of 0 .. 1 on the area 2 pi r^2 c dc."""
    u = -math.log1p(-opacity)
    c = (np.arange(200_000) + 0.5) / 200_000
    depth = u * c**5 if profile == "metaball" else u * c
    return 2 * math.pi * radius**2 * float(np.mean(-np.expm1(-depth) * c))


@pytest.mark.parametrize("device", ["gpu", "cpu"])
@pytest.mark.parametrize("radius_px", [0.05, 0.2, 0.45, 0.7, 1.3, 3.0, 6.9, 8.5, 20.0])
@pytest.mark.parametrize(
    ("profile", "opacity"),
    [("sphere", 1e-6), ("sphere", 0.3), ("sphere", 0.9), ("sphere", 1.0)]
    + [("metaball", 1e-6), ("metaball", 0.5), ("metaball", 1.0)],
)
def test_the_area_is_that_of_the_discs(needs_gl, device, radius_px, profile, opacity):
    """Anywhere between the texels, from a twentieth of one to many."""
    size, side = 256, 8 if radius_px < 8 else 4
    rng = np.random.default_rng(int(100 * radius_px))
    cells = np.stack(np.meshgrid(*[np.arange(side)] * 2), -1).reshape(-1, 2)
    room = (256 / side - 2.2 * radius_px - 4) / 256
    xy = (cells + 0.5) / side + room * rng.uniform(-0.5, 0.5, (len(cells), 2))
    centers = np.c_[xy, rng.uniform(-0.1, 0.1, len(cells))]
    corners = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 0.0]])  # so that the map spans the unit square
    particles = po.Particles(centers, radius_px / 256, opacity, profile=profile)
    frame = po.Particles(corners, radius=1e-9, opacity=1e-9)
    scene = po.Scene([particles, frame], po.DirectionalLight(DOWN))
    technique = po.technique("bounding_opacity_maps", layers=4, split="linear")
    with seen(scene, technique, size, device) as r:
        r.transmittance(np.zeros((1, 3)))
        total = r.read("bounding_opacity_maps/opacity")[-1, ..., -1].astype(np.float64)
        texel = 1.0 / oracle.texels_per_unit(r.light_from_world)
    area = float(-np.expm1(-total).sum()) * texel**2
    opacity = min(float(np.float32(opacity)), 1.0 - 2.0**-24)
    expected = len(centers) * covered_area(radius_px / 256, opacity, profile)
    assert area == pytest.approx(expected, rel=1e-2)


@pytest.mark.parametrize("name", CASTING)
@pytest.mark.parametrize("radius", [0.003, 0.02, 0.4])
@pytest.mark.parametrize("profile", ["sphere", "metaball"])
def test_a_particle_alone_does_not_shadow_its_centre(needs_gl, name, radius, profile):
    rng = np.random.default_rng(2)
    centers = np.c_[np.stack(np.meshgrid(*[np.arange(5)] * 2), -1).reshape(-1, 2), np.zeros(25)]
    centers[:, :2] += rng.uniform(-0.05, 0.05, (25, 2))
    centers[:, 2] = rng.uniform(-1, 1, 25)
    particles = po.Particles(centers, radius, 0.8, profile=profile)
    scene = po.Scene(particles, po.DirectionalLight(DOWN))
    technique = po.technique(name, bias=0.0)
    # T is divided by what a particle lets through itself, and with it the error that T may have.
    compressed = getattr(technique, "error_bound", 0.0) / (1.0 - 0.8)
    for device in ("gpu", "cpu"):
        with seen(scene, technique, 60, device) as r:
            assert np.abs(r.transmittance(particles) - 1.0).max() < 2e-4 + compressed


@pytest.mark.parametrize("profile", ["sphere", "metaball"])
def test_the_maps_agree_with_rays(needs_gl, profile):
    """In front of them, inside and behind; of a few texels and of many."""
    rng = np.random.default_rng(6)
    dust = po.Particles(
        rng.uniform(-1, 1, (60, 3)), rng.uniform(0.05, 0.5, 60), 0.5, profile=profile
    )
    scene = po.Scene(dust, po.DirectionalLight((0.3, 0.2, -1.0)))
    points = rng.uniform(-1.5, 1.5, (2000, 3))
    truth = po.trace_transmittance(scene, points, bias=0.0)
    for device in ("gpu", "cpu"):
        with seen(scene, po.technique("exact", bias=0.0), 256, device) as r:
            T = r.transmittance(points)
        # Inside, a chord's depths are spread evenly, with the variance of its own.
        assert abs(np.mean(T - truth)) < 1e-3
        assert np.sqrt(np.mean((T - truth) ** 2)) < 0.006
    assert truth.min() < 0.3


def test_another_profile_is_a_change_like_any_other(needs_gl, same):
    dust = po.Particles(np.zeros((1, 3)), opacity=0.5)
    scene = po.Scene([dust, dust.instance()], po.DirectionalLight(DOWN))
    behind = np.array([[0.5, 0.0, -2.0]])
    with seen(scene, po.technique("exact"), 64) as r:
        assert r.transmittance(behind)[0] == pytest.approx(0.25**0.75**0.5, abs=0.01)
        dust.profile = "metaball"
        assert scene.shapes[1].profile == "sphere"
        changed = r.transmittance(behind)
        assert changed[0] == pytest.approx(0.5 ** (0.75**0.5 + 0.75**2.5), abs=0.01)
        r.invalidate()
        assert same(changed, r.transmittance(behind))
    with pytest.raises(po.ParameterError, match='"sphere", "metaball"'):
        dust.profile = "blob"


def test_an_instance_casts_as_a_copy_does(needs_gl):
    rng = np.random.default_rng(3)
    centers = rng.uniform(-1, 1, (200, 3))
    turn = np.array(
        [[0.0, -1.0, 0.0, 0.5], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, -1.0, 2.0], [0, 0, 0, 1]]
    )
    one = po.Particles(centers, radius=0.1, opacity=0.4)
    other = one.instance()
    other.transform = turn
    moved = po.Particles(centers @ turn[:3, :3].T + turn[:3, 3], radius=0.1, opacity=0.4)
    points = rng.uniform(-2, 2, (500, 3))
    results = []
    for shapes in ([one, other], [one, moved]):
        scene = po.Scene(shapes, po.DirectionalLight((0.2, 0.3, -1.0)))
        with seen(scene, po.technique("exact"), 64) as r:
            results.append(r.transmittance(points))
    assert np.abs(results[0] - results[1]).max() < 1e-4
    assert results[0].min() < 0.9


@pytest.mark.parametrize("direction", [(0, 0, -1), (0.5, 0.3, -0.8), (1.0, 0.1, 0.2)])
def test_a_fog_of_particles_is_as_thin_as_its_extinction_says(needs_gl, direction):
    """exp(-sigma d), where sigma is the area that each takes away times their number."""
    rng = np.random.default_rng(4)
    count, radius, opacity = 40_000, 0.02, 0.2
    box = 1.0
    centers = rng.uniform(-box, box, (count, 3))
    fog = po.Particles(centers, radius=radius, opacity=opacity)
    sigma = count / (2 * box) ** 3 * covered_area(radius, float(np.float32(opacity)))
    d = np.array(direction) / np.linalg.norm(direction)
    # Points inside, away from the walls; how far the light has come there.
    points = rng.uniform(-0.5, 0.5, (4000, 3))
    with np.errstate(divide="ignore"):
        walls = np.where(d == 0.0, np.inf, (np.sign(d) * box + points) / d)
    way = walls.min(axis=1)
    scene = po.Scene(fog, po.DirectionalLight(direction))
    with seen(scene, po.technique("exact"), 128) as r:
        got = r.transmittance(points)
    # Texels see whole particles, so the mean of T is above exp(-mean): by the spread of the number.
    assert np.mean(got) == pytest.approx(np.mean(np.exp(-sigma * way)), rel=0.05)
