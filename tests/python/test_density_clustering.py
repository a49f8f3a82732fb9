"""Density clustering: where its clusters lie, what they hold, and what the papers say of it."""

from typing import Any

import numpy as np
import pytest

import pyopacity as po
from layer_errors import Errors, hair, rmse
from scenes import random_shapes

NAME = "density_clustering"
DOWN = po.DirectionalLight((0.0, 0.0, -1.0))
DEVICES = pytest.mark.parametrize("device", ["gpu", "cpu"])
# Even means; the defaults; more than one pass has targets for.
COUNTS = [(1, 0), (4, 1), (16, 2)]
RAMP = np.sqrt(3.0)


def asked(
    scene: po.Scene, points: Any, device: str = "cpu", name: str = NAME, **parameters: Any
) -> np.ndarray:
    technique = po.technique(name, **parameters)
    with po.Renderer(scene, technique=technique, map_size=32, device=device) as renderer:
        return renderer.transmittance(points)


def sheets(heights: list[float], tau: float = 0.4) -> po.Scene:
    """Squares across the light, as tall as the list says."""
    square = np.array([(-4.0, -4, 0), (4, -4, 0), (4, 4, 0), (-4, 4, 0)])
    corners = np.concatenate([square + (0, 0, z) for z in heights])
    first = 4 * np.arange(len(heights))[:, None, None]
    triangles = (first + [[0, 1, 2], [0, 2, 3]]).reshape(-1, 3)
    return po.Scene(po.Mesh(corners, triangles, opacity=float(-np.expm1(-tau))), DOWN)


def slabs(*between: tuple[float, float], sigma: float = 0.5) -> po.Scene:
    """Even media from height to height."""
    scene = po.Scene(DOWN)
    for low, high in between:
        voxels = np.full((4, 2, 2), sigma, np.float32)
        size = (high - low) / 4.0
        scene.add(po.Volume(voxels, (-1.0, -1.0, low + size / 2), (2.0, 2.0, size)))
    return scene


def under_the_middle(heights: Any) -> np.ndarray:
    heights = np.asarray(heights, float)
    return np.stack([np.full_like(heights, 0.1), np.full_like(heights, 0.2), heights], axis=1)


def clusters_of(scene: po.Scene, device: str, **parameters: Any) -> np.ndarray:
    """Mean height, standard deviation and optical depth of the middle texel's: (clusters, 3)."""
    technique = po.technique(NAME, **parameters)
    with po.Renderer(scene, technique=technique, map_size=32, device=device) as renderer:
        renderer.transmittance(np.zeros((1, 3)))
        limits = renderer.read(f"{NAME}/limits").reshape(-1, 3, 32, 32, 4)[:, :, 16, 16]
        to_light = renderer.light_from_world[2]
    mean, reach, optical_depth = limits.transpose(1, 0, 2).reshape(3, -1)[:, : technique.clusters]
    heights = (mean - to_light[3]) / to_light[2]
    return np.stack([heights, reach / RAMP / -to_light[2], optical_depth], axis=1)


@DEVICES
@pytest.mark.parametrize("iterations", [0, 3])
def test_clusters_of_sheets_are_their_mean_and_deviation(device: str, iterations: int) -> None:
    near, far = [4.0, 3.7, 3.1], [-5.0, -5.5]
    found = clusters_of(sheets(near + far), device, clusters=2, iterations=iterations)
    expected = [[np.mean(z), np.std(z), 0.4 * len(z)] for z in (near, far)]
    assert found == pytest.approx(np.array(expected), abs=1e-5)


@DEVICES
def test_clusters_of_media_are_their_middle_and_their_length_over_root_12(device: str) -> None:
    found = clusters_of(slabs((2.0, 3.0), (-4.0, -2.0)), device, clusters=2)
    expected = [[2.5, 1.0 / np.sqrt(12.0), 0.5], [-3.0, 2.0 / np.sqrt(12.0), 1.0]]
    assert found == pytest.approx(np.array(expected), abs=1e-4)


@DEVICES
@pytest.mark.parametrize(("clusters", "iterations"), COUNTS)
def test_an_even_medium_lets_exp_sigma_d_through_at_every_depth(
    device: str, clusters: int, iterations: int
) -> None:
    """Whatever shares the clusters get: each is an even medium, too."""
    heights = np.linspace(1.2, -3.2, 45)
    given: dict[str, Any] = {"clusters": clusters, "iterations": iterations, "bias": 0.0}
    T = asked(slabs((-3.0, 1.0)), under_the_middle(heights), device, **given)
    assert pytest.approx(np.exp(-0.5 * np.clip(1.0 - heights, 0.0, 4.0)), abs=2e-4) == T


@DEVICES
@pytest.mark.parametrize(("clusters", "iterations"), COUNTS)
def test_behind_everything_it_is_exact(device: str, clusters: int, iterations: int) -> None:
    scene = po.Scene(random_shapes(3), DOWN)
    points = np.random.default_rng(4).uniform(-2.5, 2.5, (2000, 3)) - (0.0, 0.0, 30.0)
    exact = asked(scene, points, device, "exact")
    T = asked(scene, points, device, clusters=clusters, iterations=iterations)
    assert np.abs(T - exact).max() < 1e-5 and exact.min() < 0.3


@DEVICES
def test_the_first_layer_may_begin_before_the_first_caster(device: str) -> None:
    """So that the first surface is not lit fully, as behind the first caster alone it always is
    (Yuksel and Keyser 2008, section 2)."""
    scene = sheets([2.0, 1.9, 1.8, 0.0])
    aside = np.array([(-4.0, -4, 5), (-3, -4, 5), (-4, -3, 5)])  # the map begins before the sheets
    scene.add(po.Mesh(aside, np.array([[0, 1, 2]]), opacity=0.5))
    mean, deviation, _ = clusters_of(scene, device, clusters=1)[0]
    assert mean + RAMP * deviation > 2.1
    just_before = under_the_middle([2.01])
    assert asked(scene, just_before, device, clusters=1, bias=0.0)[0] < 0.95
    assert asked(scene, just_before, device, "deep_opacity_maps", layers=1, bias=0.0)[0] == 1.0


def test_k_means_finds_clusters_that_even_cells_cut() -> None:
    """A stray caster moves the border of even cells into the second of two clusters."""
    near = list(np.linspace(0.0, -1.0, 6))
    far = list(np.linspace(-4.5, -5.5, 6))
    scene = sheets([*near, *far, -10.0], tau=0.2)
    points = under_the_middle(np.linspace(0.5, -6.0, 91) + 0.003)
    exact = asked(scene, points, name="exact", bias=0.0)
    errors = [
        rmse(asked(scene, points, clusters=2, iterations=n, bias=0.0) - exact) for n in (0, 2)
    ]
    assert errors[1] < 0.5 * errors[0]


@DEVICES
@pytest.mark.parametrize(("clusters", "iterations"), COUNTS)
def test_equal_depths_are_one_step(device: str, clusters: int, iterations: int) -> None:
    given: dict[str, Any] = {"clusters": clusters, "iterations": iterations, "bias": 0.0}
    for scene, tau in ((sheets([1.0]), 0.4), (sheets([1.0] * 5), 2.0)):
        T = asked(scene, under_the_middle([1.5, 1.0, 0.999, -1.0]), device, **given)
        assert pytest.approx([1.0, 1.0, np.exp(-tau), np.exp(-tau)], abs=1e-5) == T


@DEVICES
@pytest.mark.parametrize(("clusters", "iterations"), COUNTS)
def test_nothing_is_not_a_number(device: str, clusters: int, iterations: int) -> None:
    scene = po.Scene(random_shapes(7), po.DirectionalLight((0.5, 0.3, -0.8)))
    faint = po.Particles(np.zeros((3, 3)), 0.5, np.array([0.0, 1e-30, 1e-38]))
    scene.add(faint)
    places = np.random.default_rng(1).uniform(-3, 3, (5000, 3))
    for where in (places, *scene.shapes[:2]):
        T = asked(scene, where, device, clusters=clusters, iterations=iterations)
        assert np.isfinite(T).all() and T.min() >= 0.0 and T.max() <= 1.0


def test_a_caster_takes_none_of_its_own_light() -> None:
    """Its cluster's mean and deviation are those of the others."""
    scene = sheets([1.0, -1.0, -1.5])
    square = np.array([(-4.0, -4, -0.1), (4, -4, -0.1), (4, 4, -0.1), (-4, 4, -0.1), (0, 0, -0.1)])
    fan = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    others = asked(scene, square[4:], clusters=1, bias=0.0)[0]
    mine = po.Mesh(square, fan, opacity=scene.shapes[0].opacity)
    scene.add(mine)
    assert asked(scene, mine, clusters=1, bias=0.0)[4] == pytest.approx(others, abs=1e-5)
    assert asked(scene, mine, clusters=1, bias=0.0, own_correction=False)[4] < others - 0.02


def test_more_clusters_and_one_iteration_err_less_on_hair() -> None:
    errors = Errors(*hair())
    by_clusters = [rmse(errors.of(NAME, clusters=n)) for n in (1, 2, 4, 8)]
    assert np.all(np.diff(by_clusters) < 0)
    assert by_clusters[2] < rmse(errors.of(NAME, clusters=4, iterations=0))
    assert by_clusters[2] < rmse(errors.of("opacity_shadow_maps", layers=16))
