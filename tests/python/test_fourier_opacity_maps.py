"""Jansen and Bavoil 2010: what the paper claims, and what the options do."""

from typing import Any

import numpy as np
import pytest

import pyopacity as po
from layer_errors import LIGHT, Errors, hair, rmse
from pyopacity.stress.series import BASES, between_0_and_10, depths, functions, inset_of
from scenes import random_shapes

FOM, OSM = "fourier_opacity_maps", "opacity_shadow_maps"
DOM, BOM = "deep_opacity_maps", "bounding_opacity_maps"
DOWN = po.DirectionalLight((0.0, 0.0, -1.0))
DEVICES = pytest.mark.parametrize("device", ["cpu", "gpu"])


@pytest.fixture(scope="module")
def errors() -> Errors:
    return Errors(*hair())


def renderer(scene: po.Scene, device: str = "cpu", name: str = FOM, **parameters: Any):
    technique = po.technique(name, **parameters)
    return po.Renderer(scene, technique=technique, map_size=32, device=device)


def asked(scene: po.Scene, points: Any, device: str = "cpu", name: str = FOM, **parameters: Any):
    with renderer(scene, device, name, **parameters) as r:
        return r.transmittance(points)


def square(height: float, optical_depth: float, middle: float = 0.0, half: float = 4.0) -> po.Mesh:
    """Across the light."""
    corners = np.array([(-1.0, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]) * half
    triangles = np.array([[0, 1, 2], [0, 2, 3]])
    opacity = float(-np.expm1(-optical_depth))
    return po.Mesh(corners + (middle, 0.0, height), triangles, opacity=opacity)


def under_the_middle(heights: Any) -> np.ndarray:
    heights = np.asarray(heights, float)
    return np.stack([np.full_like(heights, 0.3), np.full_like(heights, 0.2), heights], axis=1)


@DEVICES
@pytest.mark.parametrize("basis", BASES)
def test_intervals_are_integrated(device: str, basis: str, request: pytest.FixtureRequest) -> None:
    """Of an even medium, and of one as thin as float32 can tell."""
    if device == "gpu":
        request.getfixturevalue("needs_gl")
    count = 21
    for bottom, length in ((2.0, 4.0), (5.0, 0.01), (7.5, 1e-5)):
        voxels = np.full((1, 2, 2), 0.8 / length, np.float32)
        medium = po.Volume(voxels, (-1.0, -1.0, bottom + length / 2), (2.0, 2.0, length))
        with renderer(between_0_and_10(medium), device, coefficients=count, basis=basis) as r:
            r.transmittance(np.zeros((1, 3)))
            to_light = r.light_from_world
            x, y = (to_light[:2, :3] @ [0.3, 0.2, 5.0] + to_light[:2, 3]).astype(int)
            found = r.read(f"{FOM}/coefficients")[:, y, x].ravel()[:count]
            steps = (np.arange(20000) + 0.5) / 20000
            z = depths(r.light_from_world, bottom + length * steps)
        inset = inset_of(basis, count)
        expected = 0.8 * functions(basis, count, inset + (1 - 2 * inset) * z).mean(axis=1)
        assert found == pytest.approx(expected, abs=3e-4 if length > 1e-3 else 3e-3)


@DEVICES
@pytest.mark.parametrize("count", [3, 16, 63])
def test_the_piecewise_constant_basis_is_opacity_shadow_maps(
    device: str, count: int, request: pytest.FixtureRequest
) -> None:
    """Section 5.1: the same slices, with lines between them, on every kind of caster."""
    if device == "gpu":
        request.getfixturevalue("needs_gl")
    scene = po.Scene(random_shapes(3), po.DirectionalLight(LIGHT))
    points = np.random.default_rng(1).uniform(-4, 4, (1000, 3))
    for corrects in (False, True):
        apart = []
        for where in (points, *scene.shapes):
            slices = asked(scene, where, device, OSM, layers=count, own_correction=corrects)
            given = {"basis": "piecewise_constant", "own_correction": corrects}
            apart.append(np.abs(asked(scene, where, device, coefficients=count, **given) - slices))
        # Where a texel holds less than what a receiver takes for its own, slices tell which part.
        assert np.sum(np.concatenate(apart) > 1e-5) <= (2 if corrects else 0)


@DEVICES
@pytest.mark.parametrize("basis", BASES)
def test_before_and_behind_everything_it_is_exact(
    device: str, basis: str, request: pytest.FixtureRequest
) -> None:
    """Section 3.1: T(0) = 1, and T(1) is that of all casters."""
    if device == "gpu":
        request.getfixturevalue("needs_gl")
    scene = po.Scene(random_shapes(3), DOWN)
    points = np.random.default_rng(4).uniform(-2.5, 2.5, (500, 3))
    for bounds in ("global", "per_texel"):
        behind = asked(scene, points - (0, 0, 30.0), device, basis=basis, bounds=bounds)
        exact = asked(scene, points - (0, 0, 30.0), device, "exact")
        assert np.abs(behind - exact).max() < 1e-5 and exact.min() < 0.3
        assert (asked(scene, points + (0, 0, 30.0), device, basis=basis, bounds=bounds) == 1).all()


@pytest.mark.parametrize("basis", BASES)
def test_nothing_is_not_a_number(basis: str) -> None:
    scene = po.Scene(random_shapes(7), po.DirectionalLight(LIGHT))
    scene.add(po.Particles(np.zeros((5, 3)), 0.5, np.array([0, 1e-30, 1e-8, 0.01, 1 - 2**-24])))
    places = np.random.default_rng(1).uniform(-3, 3, (2000, 3))
    for parameters in ({"coefficients": 63}, {"bounds": "per_texel"}, {"window": "lanczos"}):
        for where in (places, *scene.shapes[:4]):
            T = asked(scene, where, basis=basis, **parameters)
            assert np.isfinite(T).all() and T.min() >= 0.0 and T.max() <= 1.0


# ---- what the paper says of it ----


@pytest.mark.gl
def test_passes_grow_as_those_of_slices_do() -> None:
    blended = {"deposit": "blend"}
    for count, passes in ((3, 1), (32, 1), (33, 2), (63, 2)):
        found = []
        for name, parameters in (
            (FOM, {"coefficients": count}),
            (OSM, {"layers": count} | blended),
        ):
            with renderer(between_0_and_10(), "gpu", name, **parameters) as r:
                r.transmittance(np.zeros((1, 3)))
                rows = [row.name for row in r.report if row.status == "ran"]
                found.append([row for row in rows if row.startswith(name)])
                texture = "coefficients" if name == FOM else "opacity"
                assert r.read(f"{name}/{texture}").shape[0] == -(-count // 4)
        assert [len(rows) for rows in found] == [passes, passes]


def change(scene: po.Scene, other: po.Scene, shape: po.Shape, name: str, **parameters: Any):
    """RMSE between T of one shape in two scenes."""
    return rmse(
        asked(scene, shape, name=name, **parameters) - asked(other, shape, name=name, **parameters)
    )


@pytest.mark.parametrize(
    "ends",
    [(0.05, 0.05), (0.1, 0.0), (0.03, -0.0), (0.0, 0.1)],
    ids=["wider", "nearer light", "moved", "deeper"],
)
def test_other_depth_bounds_change_less_than_they_do_slices(ends: tuple[float, float]) -> None:
    """Figures 5 and 6: bounds inflated by 10 %, and casters that move within them."""
    smoke = po.load("demo:smoke?voxels=20000")[0]
    low, high = po.Scene(smoke).bounds
    size = high[2] - low[2]
    scenes = []
    for before, behind in ((0.0, 0.0), ends):
        heights = (high[2] + before * size, low[2] - behind * size)
        aside = [square(h, 1e-6, middle=high[0] + 0.5 * size, half=0.01 * size) for h in heights]
        scenes.append(po.Scene([smoke, *aside], DOWN))
    fourier = change(*scenes, smoke, FOM)
    assert 0.0 < fourier < 0.6 * change(*scenes, smoke, OSM, layers=7)


def test_an_outlier_leaves_the_rest_alone() -> None:
    """Figure 7: one faint caster before the others moves all layers behind the first caster."""
    sheets = [square(height, 0.15) for height in np.linspace(4.0, 1.0, 12)]
    outlier = square(9.0, 0.02)
    alone, with_it = between_0_and_10(*sheets), between_0_and_10(*sheets, outlier)
    points = under_the_middle(np.linspace(4.5, 0.5, 80) + 0.01)

    def effect(name: str, **parameters: Any) -> float:
        first, second = (asked(s, points, name=name, **parameters) for s in (alone, with_it))
        return rmse(second - first * np.exp(-0.02).astype(np.float32))

    fourier = effect(FOM, coefficients=7)
    assert fourier < 0.25 * effect(DOM, layers=7, layer_extent=4.0)
    assert fourier < 0.25 * effect(BOM, layers=7, interpolation="linear", split="linear")


def ripple(optical_depth: float, **parameters: Any) -> float:
    """How far off T is well before a feature, and well behind it."""
    thickness = 2.0
    voxels = np.full((1, 2, 2), optical_depth / thickness, np.float32)
    feature = po.Volume(voxels, (-1.0, -1.0, 5.0), (2.0, 2.0, thickness))
    heights = np.concatenate([np.linspace(9.5, 8.0, 60), np.linspace(2.0, 0.0, 60)])
    scene = between_0_and_10(feature)
    T = asked(scene, under_the_middle(heights), **parameters)
    exact = asked(scene, under_the_middle(heights), name="exact")
    return float(np.abs(T - exact).max())


def test_ringing_grows_with_opacity_and_falls_with_coefficients() -> None:
    """Figure 8, and section 7.3; a window takes it away."""
    for count in (7, 15):
        by_opacity = [ripple(tau, coefficients=count) for tau in (0.1, 0.4, 1.6)]
        assert by_opacity == sorted(by_opacity) and by_opacity[2] > 3 * by_opacity[0]
    by_count = [ripple(0.4, coefficients=count) for count in (7, 15, 63)]
    assert by_count == sorted(by_count, reverse=True) and by_count[2] < 0.2 * by_count[0]
    assert ripple(0.4, coefficients=15, window="lanczos") < 0.5 * ripple(0.4, coefficients=15)


def test_ripples_are_clamped() -> None:
    """Section 7.3: never above 1; nor below what all casters let through."""
    heights = np.linspace(9.99, 0.01, 400)
    for tau in (0.1, 3.0):
        scene = between_0_and_10(square(5.0, tau))
        T = asked(scene, under_the_middle(heights))
        assert T.max() == 1.0 and T.min() >= np.exp(-tau) - 1e-6


def test_hair_errs_more_the_more_opaque_it_is() -> None:
    """Figure 9: 5 coefficients against 32 slices, at 20, 40 and 60 %, after a box of 33 x 33."""
    scene, strands = hair(6000)
    found = []
    for opacity in (0.2, 0.4, 0.6):
        strands.opacity = opacity
        of = Errors(scene, strands, 256)
        softened = {"prefilter": "box", "prefilter_radius": 16}
        T = of.ask(FOM, coefficients=5, **softened)
        truth = of.ask(FOM, coefficients=63, basis="piecewise_constant", **softened)
        found.append(rmse(T - truth))
    assert found == sorted(found) and found[0] < 0.08


def test_more_coefficients_err_less_and_less_than_as_many_slices(errors: Errors) -> None:
    found = [rmse(errors.of(FOM, coefficients=count)) for count in (3, 7, 15, 63)]
    assert found == sorted(found, reverse=True)
    for count, error in zip((7, 15, 63), found[1:], strict=True):
        assert error < rmse(errors.of(OSM, layers=count))


def test_bounds_of_each_texel_are_worth_four_times_the_coefficients(errors: Errors) -> None:
    assert rmse(errors.of(FOM, bounds="per_texel")) < rmse(errors.of(FOM, coefficients=31))


def test_a_caster_at_the_end_keeps_its_shadow() -> None:
    """Without a margin half of it falls to the other end."""
    scene = between_0_and_10(square(10.0, 1.0), square(5.0, 1e-6))
    points = under_the_middle([5.0])
    assert asked(scene, points, coefficients=15)[0] == pytest.approx(np.exp(-1.0), abs=0.08)
    assert asked(scene, points, coefficients=15, margin=0)[0] == pytest.approx(
        np.exp(-0.5), abs=0.03
    )


# ---- prefilters ----


def test_a_prefilter_averages_density_over_the_square() -> None:
    """Section 6: the optical depth of the mean, behind a half plane."""
    sheet = square(5.0, 1.0, middle=4.0)
    scene = between_0_and_10(sheet)
    x = np.linspace(-2.0, 4.0, 120)
    points = np.stack([x, 0 * x, 0 * x - 8.0], axis=1)
    for radius in (1, 4):
        with renderer(scene, prefilter="box", prefilter_radius=radius) as r:
            T = r.transmittance(points)
            texel = 1 / np.linalg.norm(r.light_from_world[0, :3])
        width = (2 * radius + 1) * texel
        in_shadow = np.clip((x + width / 2) / width, 0, 1)
        # A tent and the sheet's edge among texels lie between.
        assert np.abs(-np.log(T) - in_shadow).max() < 1.1 / (2 * radius + 1)
    sharp = asked(scene, points)
    for name, radius in (("gaussian", 4), ("mip-chain", 1)):
        T = asked(scene, points, prefilter=name, prefilter_radius=radius)
        assert np.diff(T).max() < 1e-6 and 0.0 < rmse(T - sharp) < 0.3
        assert T[-1] == pytest.approx(np.exp(-1.0), abs=0.02)


@pytest.mark.parametrize("map_size", [8, 31])
@pytest.mark.parametrize("prefilter", ["box", "gaussian", "mip-chain"])
def test_prefilters_conserve_what_is_even(needs_gl: None, prefilter: str, map_size: int) -> None:
    """A mean of equals is that, also at the map's edges, in its splits and on both devices."""
    lights = {"gpu": po.PointLight((0.0, 0.0, 6.0)), "cpu": po.PointLight((0.0, 0.0, 6.0))}
    for device, light in lights.items():
        scene = po.Scene([square(5.0, 0.7, half=40.0), square(0.0, 0.4, half=40.0)], light)
        technique = po.technique(FOM, prefilter=prefilter, prefilter_radius=16)
        points = np.random.default_rng(1).uniform(-3, 3, (50, 3)) * (1, 1, 0) - (0, 0, 60)
        with po.Renderer(scene, technique=technique, map_size=map_size, device=device) as r:
            assert r.transmittance(points) == pytest.approx(np.exp(-1.1), abs=1e-5)


def test_bounds_of_each_texel_cannot_be_averaged() -> None:
    scene, _ = hair(600)
    with pytest.raises(po.ParameterError, match="per_texel") as caught:
        asked(scene, np.zeros((1, 3)), bounds="per_texel", prefilter="box")
    assert "prefilter = none" in caught.value.fix


def test_half_floats_change_little_on_both_devices(needs_gl: None) -> None:
    scene, strands = hair(3000)
    full = asked(scene, strands)
    on_cpu = asked(scene, strands, accumulator="float16")
    on_gpu = asked(scene, strands, "gpu", accumulator="float16")
    assert 0.0 < rmse(on_gpu - full) < 0.03
    # Drivers round sums of half floats each as they like.
    assert np.quantile(np.abs(on_gpu - on_cpu), 0.99) < 1e-2
