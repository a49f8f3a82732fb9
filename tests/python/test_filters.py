"""Look-up filters against quadrature over the kernels, on an independent deposit."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import pyopacity as po
from pyopacity.stress import oracle
from scenes import tangle

Array = npt.NDArray[np.float64]
LIGHT = (0.5, 0.3, -0.8)

# Densities on [-1, 1]; a Gaussian's radius is two standard deviations.
KERNELS: dict[str, Callable[[Array], Array]] = {
    "box": lambda u: np.ones_like(u),
    "bartlett": lambda u: 1.0 - np.abs(u),
    "gaussian": lambda u: np.exp(-2.0 * u**2),
}


def axis_weights(kernel: str, position: float, radius: float) -> dict[int, float]:
    """How much each texel counts on one axis, by the midpoint rule."""
    if kernel == "none":
        return {math.floor(position): 1.0}
    if kernel == "pcf":
        points = position + (np.arange(4) - 1.5) * 0.5 * radius
        density = np.full(4, 0.25)
    else:
        u = (np.arange(8000) + 0.5) / 4000.0 - 1.0
        points, density = position + radius * u, KERNELS[kernel](u)
    texels = np.floor(points).astype(int)
    sums = np.bincount(texels - texels.min(), density / density.sum())
    return {int(texels.min()) + i: float(weight) for i, weight in enumerate(sums) if weight > 0}


def expected(
    lists: oracle.TexelLists, p: Array, bias: float, kernel: str, radius: float, domain: str
) -> float:
    transmittance = optical_depth = 0.0
    for column, wx in axis_weights(kernel, p[0], radius).items():
        for row, wy in axis_weights(kernel, p[1], radius).items():
            fragments = lists.fragments.get((column, row), [])
            omega = sum(f.optical_depth for f in fragments if f.depth < p[2] - bias)
            transmittance += wx * wy * math.exp(-omega)
            optical_depth += wx * wy * omega
    return transmittance if domain == "transmittance" else math.exp(-optical_depth)


MAP_SIZE = 48


@dataclass
class Hair:
    scene: po.Scene
    points: Array  # some of the strands' own
    matrix: Array  # world to the light's map
    lists: oracle.TexelLists


@pytest.fixture(scope="module")
def hair() -> Hair:
    points, offsets = tangle(11, strands=60)
    strands = po.Strands(points, offsets, width=0.25, opacity=0.5)
    scene = po.Scene(strands, po.DirectionalLight(LIGHT))
    with po.Renderer(scene, map_size=MAP_SIZE, device="cpu") as renderer:
        renderer.transmittance(points)
        matrix = renderer.light_from_world
    width, opacity = np.full(len(points), 0.25), np.full(len(points), 0.5)
    lists = oracle.deposit(points, offsets, width, opacity, matrix, MAP_SIZE)
    return Hair(scene, np.ascontiguousarray(points[::8]), matrix, lists)


@pytest.mark.parametrize("domain", ["transmittance", "density"])
@pytest.mark.parametrize(
    ("kernel", "extent"),
    [
        ("none", {}),
        ("box", {}),
        ("box", {"filter_radius": 0.87}),
        ("box", {"filter_radius": 3.0}),
        ("box", {"filter_width": 1.5}),
        ("bartlett", {"filter_radius": 1.5}),
        ("gaussian", {"filter_radius": 2.0}),
        ("gaussian", {"filter_width": 2.0}),
        ("pcf", {"filter_radius": 2.0}),
    ],
)
def test_weights_are_the_kernels(
    hair: Hair, kernel: str, extent: dict[str, float], domain: str
) -> None:
    bias = 0.4
    technique = po.technique("exact", bias=bias, filter=kernel, filter_domain=domain, **extent)
    got = po.transmittance(hair.scene, hair.points, technique, MAP_SIZE)
    radius = extent.get("filter_radius", 0.5)
    if "filter_width" in extent:
        radius = 0.5 * extent["filter_width"] * oracle.texels_per_unit(hair.matrix)
    bias_ls = bias / oracle.depth_range(hair.matrix)
    wanted = [
        expected(hair.lists, p, bias_ls, kernel, radius, domain)
        for p in oracle.light_points(hair.matrix, hair.points)
    ]
    assert np.abs(got - wanted).max() < 1e-3


def half_covered(opacity: float, **parameters: Any) -> Array:
    """T on a line across the edge of a sheet, behind it; in texels of the map."""
    sheet = po.Mesh(
        np.array([[-8.0, -8, 0], [0, -8, 0], [0, 8, 0], [-8, 8, 0]]),
        np.array([[0, 1, 2], [0, 2, 3]]),
        opacity=opacity,
    )
    far = po.Mesh(np.array([[8.0, -8, 0], [8.1, -8, 0], [8, -7.9, 0]]), np.array([[0, 1, 2]]))
    scene = po.Scene([sheet, far], po.DirectionalLight((0, 0, -1)))
    technique = po.technique("exact", bias=0.0, **parameters)
    with po.Renderer(scene, technique=technique, map_size=64, device="cpu") as renderer:
        x = np.linspace(-2, 2, 401)
        return renderer.transmittance(np.stack([x, 0 * x, 0 * x - 1], 1)).astype(float)


@pytest.mark.parametrize("kernel", ["box", "bartlett", "gaussian", "pcf"])
@pytest.mark.parametrize("opacity", [0.6, 1.0])
def test_a_silhouette_is_the_mean_of_transmittance(kernel: str, opacity: float) -> None:
    t = half_covered(opacity, filter=kernel, filter_radius=1.5)
    assert t[0] == pytest.approx(1.0 - opacity, abs=1e-6) and t[-1] == 1.0
    assert (np.diff(t) >= -1e-6).all()
    # Half of the filter covered: the mean of both sides, wherever texels lie.
    area = np.trapezoid(t - t[0], dx=0.01) / (t[-1] - t[0])
    edge = 2.0 - area
    texel = 16.1 / 62
    assert abs(edge) < 0.51 * texel  # the sheet covers whole texels
    if kernel != "pcf":
        middle = np.interp(edge, np.linspace(-2, 2, 401), t)
        assert middle == pytest.approx(1.0 - 0.5 * opacity, abs=1e-2)


def test_density_over_shadows_a_silhouette_and_spares_opaque_casters() -> None:
    of_t = half_covered(0.9, filter_radius=2.0)
    of_density = half_covered(0.9, filter_radius=2.0, filter_domain="density")
    assert (of_density <= of_t + 1e-6).all() and of_density.min() == pytest.approx(0.1, abs=1e-6)
    assert (of_t - of_density).max() > 0.1  # the mean of exp(-tau) is above exp of the mean
    # An opaque caster has no optical depth: both domains give the part that it leaves lit.
    opaque = half_covered(1.0, filter_radius=2.0)
    assert half_covered(1.0, filter_radius=2.0, filter_domain="density") == pytest.approx(
        opaque, abs=1e-6
    )


def test_one_world_width_is_the_same_filter_at_every_map_size() -> None:
    """The blur behind an edge is as wide at 32 texels as at 512."""
    sheet = po.Mesh(
        np.array([[-8.0, -8, 0], [0.3, -8, 0], [0.3, 8, 0], [-8, 8, 0]]),
        np.array([[0, 1, 2], [0, 2, 3]]),
        opacity=0.8,
    )
    far = po.Mesh(np.array([[8.0, -8, 0], [8.1, -8, 0], [8, -7.9, 0]]), np.array([[0, 1, 2]]))
    scene = po.Scene([sheet, far], po.DirectionalLight((0, 0, -1)))
    x = np.linspace(-4, 4, 801)
    points = np.stack([x, 0 * x, 0 * x - 1], 1)
    for map_size in (64, 128, 512):
        technique = po.technique("exact", bias=0.0, filter_width=1.5)
        t = po.transmittance(scene, points, technique, map_size)
        texel = 16.1 / (map_size - 2)
        slope = np.gradient(t.astype(float), x)
        blurred = x[slope > 0.1 * slope.max()]
        assert blurred[-1] - blurred[0] == pytest.approx(1.5, abs=texel + 0.05)


def test_the_widest_filter_is_64_texels() -> None:
    wide = half_covered(0.6, filter_width=1e9)
    assert np.isfinite(wide).all()
    assert wide == pytest.approx(half_covered(0.6, filter_radius=32.0), abs=1e-6)


@pytest.mark.parametrize("kernel", ["box", "bartlett", "gaussian", "pcf"])
@pytest.mark.parametrize("opacity", [1.0, 0.5])
@pytest.mark.parametrize("name", ["exact", "bounding_opacity_maps"])
def test_a_leaning_plane_does_not_shadow_itself(name: str, kernel: str, opacity: float) -> None:
    u, v = (a.ravel() for a in np.meshgrid(np.linspace(-1, 1, 9), np.linspace(-1, 1, 9)))
    plane = np.stack([u, v, 0.8 * u - 0.5 * v], 1)
    corner = np.arange(81).reshape(9, 9)
    a, b, c, d = corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]
    triangles = np.stack([a, b, c, a, c, d], -1).reshape(-1, 3)
    mesh = po.Mesh(plane, triangles, opacity=opacity)
    scene = po.Scene(mesh, po.DirectionalLight((0.1, 0.2, -1.0)))
    for radius in (0.5, 0.87, 2.0, 9.5):
        technique = po.technique(name, filter=kernel, filter_radius=radius)
        assert (po.transmittance(scene, mesh, technique, 64) == 1.0).all()


def test_a_lit_ground_stays_lit_in_the_picture(needs_gl: None) -> None:
    """The same on the GPU, where the slope comes from the picture's own derivatives."""
    ground = po.Mesh(
        np.array([[-1.0, -1, 0], [1, -1, 0.7], [1, 1, 1.2], [-1, 1, 0.5]]),
        np.array([[0, 1, 2], [0, 2, 3]]),
    )
    scene = po.Scene(ground, po.DirectionalLight((0.2, 0.4, -1.0)))
    technique = po.technique("exact", filter="gaussian", filter_radius=5.0)
    with po.Renderer(scene, size=(96, 64), technique=technique, map_size=64) as renderer:
        picture = renderer.render()
        renderer.technique = "unshadowed"
        assert np.abs(picture - renderer.render()).max() < 1e-6


@pytest.mark.gl
@pytest.mark.parametrize("filter_domain", ["transmittance", "density"])
@pytest.mark.parametrize("map_size", [2, 3, 5, 64])
def test_rounding_makes_no_light(map_size: int, filter_domain: str) -> None:
    """Weights are divided by their sum: 1 where nothing casts, also where a division rounds up."""
    random = np.random.default_rng(0)
    few = po.Particles(random.normal(size=(8, 3)), radius=0.1, opacity=0.3)
    scene = po.Scene(few, po.DirectionalLight((0.3, 0.2, -1.0)))
    slices = po.technique("opacity_shadow_maps", filter_domain=filter_domain)
    with po.Renderer(scene, technique=slices, map_size=map_size) as renderer:
        assert renderer.transmittance(random.normal(size=(20_000, 3))).max() == 1.0
