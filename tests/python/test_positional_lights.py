"""Lights at a place: their maps against rays through the geometry, for every kind of caster."""

import numpy as np
import pytest

import pyopacity as po

LIGHTS = {
    "outside": po.PointLight((3.0, 2.0, 4.0)),
    "inside": po.PointLight((0.1, 0.05, 0.0)),
    "spot": po.SpotLight((0.0, 0.0, 4.0), (0.0, 0.0, -1.0), 60.0),
    "wide spot": po.SpotLight((0.0, 0.0, 1.9), (0.0, 0.0, -1.0), 170.0),
    "area": po.AreaLight((0.0, 0.0, 3.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), 2),
}


def strands(random):
    starts = random.uniform(-1, 1, (60, 1, 3))
    walk = starts + np.cumsum(random.normal(0, 0.15, (60, 8, 3)), axis=1)
    return po.Strands(walk.reshape(-1, 3), np.arange(61) * 8, width=0.05, opacity=0.4)


def leaves(random):
    corners = random.uniform(-1, 1, (40, 1, 3)) + random.normal(0, 0.3, (40, 3, 3))
    return po.Mesh(corners.reshape(-1, 3), np.arange(120).reshape(-1, 3), opacity=0.5)


def particles(random, profile="sphere"):
    return po.Particles(random.uniform(-1, 1, (100, 3)), 0.12, 0.3, profile=profile)


def metaballs(random):
    return particles(random, "metaball")


def volume(random):
    extinction = random.uniform(0, 1, (10, 12, 14)) * (random.uniform(0, 1, (10, 12, 14)) > 0.5)
    return po.Volume(extinction, origin=(-1.0, -1.0, -1.0), spacing=0.15)


# A ray through the edge of a thing decides; a map has the mean over a texel there.
KINDS = {strands: 0.1, leaves: 0.06, particles: 0.02, metaballs: 0.02, volume: 0.02}


def scene_of(kind, light):
    return po.Scene(kind(np.random.default_rng(5)), light)


def points(count=1500):
    return np.random.default_rng(2).uniform(-1.5, 1.5, (count, 3))


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
@pytest.mark.parametrize("light", LIGHTS)
def test_maps_through_faces_agree_with_rays(kind, light):
    scene = scene_of(kind, LIGHTS[light])
    technique = po.technique("exact", bias=0.05)
    T = po.transmittance(scene, points(), technique, map_size=256)
    truth = po.trace_transmittance(scene, points(), bias=0.05)
    assert truth.min() < 0.8  # there is a shadow
    assert abs(np.mean(T - truth)) < 0.01
    coarse = 2.0 if light == "wide spot" else 1.0  # its texels are wide in the middle
    assert np.sqrt(np.mean((T - truth) ** 2)) < coarse * KINDS[kind]


@pytest.mark.gl
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
@pytest.mark.parametrize("light", LIGHTS)
def test_shaders_and_cpp_see_the_same_through_faces(kind, light):
    scene = scene_of(kind, LIGHTS[light])
    # Of two ratios as good as each other, rounding may decide between devices.
    technique = po.technique("bounding_opacity_maps", split="hybrid")
    settings = {"technique": technique, "size": (32, 32), "map_size": 64}
    found = []
    for device in ("cpu", "gpu"):
        with po.Renderer(scene, device=device, **settings) as renderer:
            found.append(renderer.transmittance(points()))
    # Where a triangle's edge passes through a texel's middle, one of them may cover it.
    assert np.mean(np.abs(found[0] - found[1]) > 1e-3) < 0.005


def test_a_light_far_away_casts_the_shadow_of_a_directional_one():
    direction = np.array([0.2, 0.1, -1.0]) / np.linalg.norm([0.2, 0.1, -1.0])
    technique = po.technique("exact", bias=0.05)
    far, at_infinity = (
        po.transmittance(scene_of(strands, light), points(), technique, map_size=256)
        for light in (po.PointLight(-1e5 * direction), po.DirectionalLight(direction))
    )
    assert abs(np.mean(far - at_infinity)) < 1e-3
    assert np.sqrt(np.mean((far - at_infinity) ** 2)) < 0.05  # their texels lie elsewhere


def test_an_area_light_is_the_mean_of_its_points():
    area = LIGHTS["area"]
    corners = [(x, y, 3.0) for y in (-0.25, 0.25) for x in (-0.25, 0.25)]
    technique = po.technique("exact", bias=0.05)
    means = np.mean(
        [
            po.transmittance(scene_of(particles, po.PointLight(p)), points(), technique)
            for p in corners
        ],
        axis=0,
    )
    T = po.transmittance(scene_of(particles, area), points(), technique)
    assert np.abs(T - means).max() < 0.02
