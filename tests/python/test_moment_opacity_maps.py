"""Muenstermann et al. 2018: what moments tell exactly, and that they never tell nonsense."""

from typing import Any

import numpy as np
import pytest

import pyopacity as po
from layer_errors import LIGHT, Errors, hair, rmse
from scenes import random_shapes
from test_fourier_opacity_maps import (
    DEVICES,
    DOWN,
    between_0_and_10,
    depths,
    square,
    under_the_middle,
)

MOM = "moment_opacity_maps"
MOMENTS = pytest.mark.parametrize("moments", [4, 6, 8])


@pytest.fixture(scope="module")
def errors() -> Errors:
    return Errors(*hair())


def asked(scene: po.Scene, points: Any, device: str = "cpu", **parameters: Any) -> np.ndarray:
    technique = po.technique(MOM, **parameters)
    with po.Renderer(scene, technique=technique, map_size=32, device=device) as renderer:
        return renderer.transmittance(points)


@DEVICES
@pytest.mark.parametrize(
    ("moments", "heights", "tolerance"),
    [
        (4, [7.0], 1e-5),
        (4, [7.0, 3.1], 1e-4),
        (6, [8.0, 5.0, 2.0], 5e-3),
        (8, [9.0, 6.5, 3.5, 1.0], 0.08),
    ],
)
def test_half_as_many_casters_are_exact(
    device: str,
    moments: int,
    heights: list[float],
    tolerance: float,
    request: pytest.FixtureRequest,
) -> None:
    """Wherever they lie, but for the bias, which grows with the moments: asked between them."""
    if device == "gpu":
        request.getfixturevalue("needs_gl")
    optical_depths = 0.3 + 0.2 * np.arange(len(heights))
    scene = between_0_and_10(*map(square, heights, optical_depths))
    between = [9.9, *(np.array(heights[1:]) + heights[:-1]) / 2, 0.1]
    expected = np.exp(-np.concatenate([[0.0], np.cumsum(optical_depths)]))
    T = asked(scene, under_the_middle(between), device, moments=moments)
    assert pytest.approx(expected, abs=tolerance) == T


@DEVICES
@MOMENTS
def test_intervals_are_integrated(
    device: str, moments: int, request: pytest.FixtureRequest
) -> None:
    if device == "gpu":
        request.getfixturevalue("needs_gl")
    for bottom, length in ((2.0, 4.0), (7.5, 1e-2)):
        voxels = np.full((1, 2, 2), 0.8 / length, np.float32)
        medium = po.Volume(voxels, (-1.0, -1.0, bottom + length / 2), (2.0, 2.0, length))
        scene, technique = between_0_and_10(medium), po.technique(MOM, moments=moments)
        with po.Renderer(scene, technique=technique, map_size=32, device=device) as r:
            r.transmittance(np.zeros((1, 3)))
            x, y = (
                r.light_from_world[:2, :3] @ [0.3, 0.2, 5.0] + r.light_from_world[:2, 3]
            ).astype(int)
            found = r.read(f"{MOM}/coefficients")[:, y, x].ravel()[: moments + 1]
            steps = (np.arange(20000) + 0.5) / 20000
            z = 2 * depths(r.light_from_world, bottom + length * steps) - 1
        expected = [0.8 * np.mean(z**k) for k in range(moments + 1)]
        assert found == pytest.approx(expected, abs=2e-4)


@MOMENTS
def test_light_falls_along_its_way(moments: int) -> None:
    """From 1 to what all casters let through, whatever they are."""
    scene = po.Scene(random_shapes(3), DOWN)
    starts = np.random.default_rng(1).uniform(-2.5, 2.5, (150, 3)) * (1, 1, 0)
    points = starts[:, None] + np.linspace(6, -6, 120)[:, None] * (0.0, 0.0, 1.0)
    T = asked(scene, points.reshape(-1, 3), moments=moments).reshape(150, 120)
    exact = po.transmittance(scene, points[:, -1] - (0, 0, 20.0), "exact", 32)
    assert (np.diff(T, axis=1) <= 1e-6).all() and (T[:, 0] == 1.0).all()
    behind = asked(scene, points[:, -1] - (0, 0, 20.0), moments=moments)
    assert np.abs(behind - exact).max() < 1e-5 and exact.min() < 0.3


@DEVICES
@MOMENTS
def test_nothing_is_not_a_number(device: str, moments: int, request: pytest.FixtureRequest) -> None:
    """From one faint particle to strands that are all but opaque, and all in one place."""
    if device == "gpu":
        request.getfixturevalue("needs_gl")
    rng = np.random.default_rng(1)
    places = rng.uniform(-3, 3, (2000, 3))
    for opacity in (0.0, 1e-30, 1e-8, 1e-4, 0.5, 1 - 2**-24):
        centers = np.concatenate([rng.normal(0, 1, (200, 3)), np.zeros((50, 3))])
        dust = po.Particles(centers, np.full(250, 0.3), np.full(250, opacity))
        T = asked(po.Scene(dust, po.DirectionalLight(LIGHT)), places, device, moments=moments)
        own = asked(po.Scene(dust, po.DirectionalLight(LIGHT)), dust, device, moments=moments)
        for t in (T, own):
            assert np.isfinite(t).all() and t.min() >= 0.0 and t.max() <= 1.0


@pytest.mark.parametrize("own_correction", [True, False])
def test_both_devices_agree(needs_gl: None, own_correction: bool) -> None:
    """float32 and float64; where a receiver's own deposit is nearly all, little is left to tell."""
    scene, strands = hair(3000)
    points = np.asarray(strands.points) + (0.0, 0.0, 0.1)
    for where in (strands, points):
        T = [asked(scene, where, d, own_correction=own_correction) for d in ("cpu", "gpu")]
        assert np.quantile(np.abs(T[0] - T[1]), 0.99) < 1e-3


def test_it_errs_less_with_more_moments(errors: Errors) -> None:
    found = [rmse(errors.of(MOM, moments=moments)) for moments in (4, 6, 8)]
    assert found == sorted(found, reverse=True)
    assert found[0] < rmse(errors.of("opacity_shadow_maps", layers=5))


def test_leaves_err_less_than_a_series_does() -> None:
    """Few casters, and opaque ones: where a series rings."""
    scene = po.Scene(po.load("demo:tree?leaves=2000"), po.DirectionalLight(LIGHT))
    tree = Errors(scene, scene.shapes[0], 96)
    assert rmse(tree.of(MOM)) < 0.7 * rmse(tree.of("fourier_opacity_maps", coefficients=5))


@DEVICES
def test_a_caster_takes_none_of_its_own_light(device: str, request: pytest.FixtureRequest) -> None:
    if device == "gpu":
        request.getfixturevalue("needs_gl")
    corners = np.array([(-4.0, -4, 5), (4, -4, 5), (4, 4, 5), (-4, 4, 5), (0.3, 0.2, 5)])
    fan = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    mine = po.Mesh(corners, fan, opacity=0.6)
    scene = between_0_and_10(mine, square(8.0, 0.4))
    assert asked(scene, mine, device, bias=0.0)[4] == pytest.approx(np.exp(-0.4), abs=1e-3)
    uncorrected = asked(scene, mine, device, bias=0.0, own_correction=False)[4]
    assert uncorrected < np.exp(-0.4) - 0.05


def test_a_mean_of_maps_is_that_of_densities() -> None:
    """Behind all casters a prefilter gives what it gives to a series."""
    scene = between_0_and_10(square(5.0, 1.0, middle=4.0))
    points = under_the_middle([-8.0]) + np.linspace(-2, 3, 50)[:, None] * (1, 0, 0)
    given = {"prefilter": "gaussian", "prefilter_radius": 4}
    technique = po.technique("fourier_opacity_maps", **given)
    series = po.transmittance(scene, points, technique, 32)
    assert asked(scene, points, **given) == pytest.approx(series, abs=1e-5)
