"""Truth by rays: closed forms, an independent brute force, and what must not change T."""

import os
import signal
import threading
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pyopacity as po
import ray_reference
from scenes import random_shapes

DOWN = po.DirectionalLight((0.0, 0.0, -1.0))
BACKENDS = po.trace_backends()

backends = pytest.mark.parametrize("backend", BACKENDS)
Sheet = Callable[..., po.Mesh]


def points(*xyz: tuple[float, float, float]) -> np.ndarray:
    return np.array(xyz, np.float64).reshape(-1, 3)


def strand(*xyz: tuple[float, float, float], width: Any = 0.2, opacity: Any = 0.5) -> po.Strands:
    return po.Strands(points(*xyz), np.array([0, len(xyz)]), width, opacity)


def trace(*shapes: po.Shape, at: Any, **settings: Any) -> np.ndarray:
    return po.trace_transmittance(po.Scene(shapes, DOWN), at, **{"bias": 0.0, **settings})


def crossings(shape: po.Strands, at: np.ndarray, **settings: Any) -> np.ndarray:
    """How often rays cross a shape of opacity .5."""
    return -np.log2(trace(shape, at=at, **settings))


def grid(half: float, count: int, height: float = 0.0) -> tuple[np.ndarray, float]:
    """The middles of count x count cells, and the area of one."""
    x = (np.arange(count) + 0.5) / count * 2.0 * half - half
    at = np.stack([*np.meshgrid(x, x), np.full((count, count), height)], axis=-1)
    return at.reshape(-1, 3), (2.0 * half / count) ** 2


# ---- closed forms ----


@backends
def test_a_ribbon_has_its_width_and_flat_ends(backend: str) -> None:
    ribbon = strand((-1, 0, 1), (1, 0, 1))
    inside = points((0, 0, 0), (0.9999, 0.0999, 0), (-0.9999, -0.0999, 0))
    outside = points((0, 0.1001, 0), (1.0001, 0, 0), (-1.0001, 0, 0), (0, 0, 2), (0, 0, 1))
    assert trace(ribbon, at=inside, backend=backend).tolist() == [0.5] * 3
    assert trace(ribbon, at=outside, backend=backend).tolist() == [1.0] * 5


def test_width_and_opacity_are_interpolated() -> None:
    ribbon = strand((0, 0, 1), (4, 0, 1), width=np.array([0.0, 0.4]), opacity=np.array([0.0, 0.8]))
    at = points((1, 0.0499, 0), (1, 0.0501, 0), (3, 0.1499, 0), (3, 0.1501, 0))
    np.testing.assert_allclose(trace(ribbon, at=at), [0.8, 1.0, 0.4, 1.0], atol=1e-7)


@backends
def test_sheets_multiply_and_opacity_is_that_of_the_place(backend: str, sheet: Sheet) -> None:
    sheets = [sheet(1.0 + i, opacity=0.2) for i in range(7)]
    at = points(*[(0.1, 0.2, 0.5 + i) for i in range(8)])
    np.testing.assert_allclose(
        trace(*sheets, at=at, backend=backend), 0.8 ** np.arange(7, -1, -1), rtol=1e-6
    )
    ramp = sheet(1.0, opacity=np.array([0.0, 1.0, 1.0, 0.0], np.float32))  # along x, -2 .. 2
    x = np.array([-1.9, -0.5, 0.0, 1.2, 1.99])
    at = np.stack([x, 0.3 * x, 0.0 * x], axis=1)
    np.testing.assert_allclose(trace(ramp, at=at, backend=backend), (2.0 - x) / 4.0, atol=1e-7)


@backends
def test_opaque_blocks_and_opacity_1_elsewhere_nearly_does(
    backend: str, sheet: Sheet, ball: Callable[..., po.Mesh]
) -> None:
    at = points((0, 0, -1), (0.25, 0.01, -1), (0.31, 0.01, -1), (0, 0, 0.5), (0, 0, 1))
    T = trace(ball(), sheet(2.0, opacity=0.5), at=at, backend=backend)
    assert T.tolist() == [0.0, 0.0, 0.5, 0.0, 0.5]
    T = trace(strand((-1, 0, 1), (1, 0, 1), opacity=1.0), at=points((0, 0, 0)), backend=backend)
    assert T[0] == np.float32(2.0**-24)


def test_a_ray_through_a_shared_edge_or_corner_counts_once(sheet: Sheet) -> None:
    on_the_diagonal = points((0, 0, 0), (1, 1, 0), (-1.5, -1.5, 0))
    assert trace(sheet(1.0, opacity=0.5), at=on_the_diagonal).tolist() == [0.5] * 3
    rim = [(np.cos(a), np.sin(a), 1.0) for a in np.arange(7)]  # about the origin, at any angles
    fan = [[0, 1 + i, 1 + (i + 1) % 7] for i in range(7)]
    corner = po.Mesh(points((0, 0, 1), *rim), np.array(fan), opacity=0.5)
    turned = po.Mesh(points((0, 0, 1), *rim), np.array(fan)[:, ::-1].copy(), opacity=0.5)
    apart = po.Mesh(corner.points[np.ravel(fan)], np.arange(21).reshape(7, 3), opacity=0.5)
    edges = [(0.3 * x, 0.3 * y, 0.0) for x, y, _ in rim]
    for mesh in (corner, turned, apart):
        assert trace(mesh, at=points((0, 0, 0), *edges)).tolist() == [0.5] * 8


def test_a_half_covered_footprint_gives_the_mean_of_t(sheet: Sheet) -> None:
    half = sheet(1.0, half_size=10.0, opacity=0.8)
    half.transform = np.array([[1, 0, 0, 10], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])
    at = points((0, 0, 0), (5, 0, 0), (-5, 0, 0))
    T = trace(half, at=at, footprint=1.0, samples=64)
    np.testing.assert_allclose(T, [0.6, 0.2, 1.0], atol=1e-6)  # not exp of the mean, .45
    assert trace(half, at=at[1:], footprint=0.0, samples=1).tolist() == T[1:].tolist()


@pytest.mark.parametrize("samples", [1, 7, 64, 100])
def test_a_footprint_is_unbiased_and_stratified(samples: int, sheet: Sheet) -> None:
    ramp = sheet(1.0, opacity=np.array([0.0, 1.0, 1.0, 0.0], np.float32))
    at = np.tile(points((0, 0, 0)), (4000, 1))
    error = trace(ramp, at=at, footprint=2.0, samples=samples).astype(np.float64) - 0.5
    alone = 0.5 / np.sqrt(12.0)  # of one ray: T runs over .25 .. .75
    assert abs(error.mean()) < 4.0 * alone / np.sqrt(samples * len(at))
    assert error.std() < 1.1 * alone / (np.sqrt(samples) * (1.0 if samples < 9 else 3.0))
    assert len(np.unique(error)) > 3900  # no two points use the same places


# ---- one strand, one crossing ----


def bend(angle_deg: float, width: float = 0.2) -> po.Strands:
    angle = np.radians(angle_deg)
    return strand((-1, 0, 1), (0, 0, 1), (np.cos(angle), np.sin(angle), 1), width=width)


@pytest.mark.parametrize("angle_deg", [0.0, 1e-7, 5.0, 40.0, 90.0, 150.0, 180.0])
def test_a_joint_keeps_the_area_of_the_ribbon(angle_deg: float) -> None:
    at, cell = grid(1.2, 1200)
    area = crossings(bend(angle_deg), at).sum() * cell
    assert area == pytest.approx(0.2 * 2.0, rel=2e-3)


@backends
def test_a_bend_is_crossed_once_along_the_joint_and_beside_it(backend: str) -> None:
    angle = np.radians(40.0)
    r = np.linspace(-0.0999, 0.0999, 41)
    for direction in (np.pi / 2.0, np.pi / 2.0 + angle, (np.pi + angle) / 2.0, 0.3, angle):
        at = np.stack([r * np.cos(direction), r * np.sin(direction), 0.0 * r], axis=1)
        np.testing.assert_allclose(crossings(bend(40.0), at, backend=backend), 1.0, atol=1e-6)


def test_a_fold_is_crossed_twice_except_at_its_tip() -> None:
    fold = strand((0, 0, 1), (2, 0, 1), (0, 0, 2))
    at = points((1, 0.05, 0), (1.85, 0.05, 0), (1.95, 0.05, 0), (2.05, 0.05, 0), (2.11, 0, 0))
    np.testing.assert_allclose(crossings(fold, at), [2, 2, 1, 1, 0], atol=1e-6)


def test_a_strand_along_the_light_neither_counts_often_nor_darkens_itself() -> None:
    z = np.linspace(0.0, 10.0, 200)
    wave = np.stack([0.02 * np.cos(3 * z), 0.02 * np.sin(3 * z), z], axis=1)
    along = po.Strands(wave, np.array([0, 200]), 0.2, 0.5)
    T = po.trace_transmittance(po.Scene(along, DOWN), along)
    assert T.min() == 1.0
    at = np.concatenate([wave[20:180, :2] + 0.01, np.full((160, 1), -1.0)], axis=1)
    assert crossings(along, at).max() <= 1.0 + 1e-6


def test_cutting_segments_and_points_twice_change_nothing(tuft: Callable[..., po.Strands]) -> None:
    whole = tuft(3)
    xyz = whole.points.reshape(12, 6, 3)
    cut = np.empty((12, 16, 3))
    for k in range(3):
        cut[:, k:15:3] = xyz[:, :-1] + k / 3.0 * np.diff(xyz, axis=1)
    cut[:, 15] = xyz[:, -1]
    twice = np.repeat(xyz, 2, axis=1)
    at = np.random.default_rng(1).uniform((-0.5, -0.5, 0), (0.5, 0.5, 0.8), (4000, 3))
    expected = trace(whole, at=at)
    assert np.mean(expected < 1.0) > 0.05
    for other in (cut, twice):
        count = other.shape[1]
        offsets = np.arange(0, 12 * count + 1, count)
        same = po.Strands(other.reshape(-1, 3), offsets, width=0.05, opacity=0.4)
        # A cut adds joints, where stretches may join: at a bend's inner side only.
        assert np.mean(np.abs(trace(same, at=at) - expected) > 1e-6) < 5e-3
    np.testing.assert_allclose(trace(same, at=at), expected, atol=1e-6)


# ---- against the brute force, and one another ----


def random_scene(seed: int) -> po.Scene:
    """A caster of each kind under a light from anywhere."""
    direction = np.random.default_rng(seed + 1000).normal(size=3)
    return po.Scene(random_shapes(seed), po.DirectionalLight(tuple(direction)))


@pytest.mark.parametrize("seed", range(4))
def test_equals_the_brute_force(seed: int) -> None:
    scene = random_scene(seed)
    at = np.random.default_rng(seed + 100).uniform(-2.5, 2.5, (120, 3))
    for bias in (0.0, 0.7):
        expected, margin = ray_reference.transmittance(scene, at, bias)
        sure = margin > 1e-9
        assert sure.mean() > 0.99 and np.mean(expected < 1.0) > 0.1
        for backend in BACKENDS:
            T = po.trace_transmittance(scene, at, bias=bias, backend=backend)
            np.testing.assert_allclose(T[sure], expected[sure], atol=1e-6)


@pytest.mark.skipif(len(BACKENDS) < 2, reason="one backend is built in")
def test_backends_give_the_same_bits(same: Callable[..., bool]) -> None:
    hair = po.load("demo:hair?segments=3000")
    scene = po.Scene(hair, po.DirectionalLight((0.5, 0.3, -0.8)))
    settings: dict[str, Any] = {"footprint": 1.0, "samples": 16}
    first, second = (
        po.trace_transmittance(scene, hair[0], backend=backend, **settings) for backend in BACKENDS
    )
    assert same(first, second) and 0.0 < first.mean() < 1.0


@backends
def test_a_scene_far_from_the_origin_is_the_same(backend: str) -> None:
    at = np.random.default_rng(7).uniform(-2.5, 2.5, (500, 3))
    here = random_scene(7)
    expected = po.trace_transmittance(here, at, footprint=0.1, bias=0.01, backend=backend)
    for shape in here.shapes:
        matrix = shape.transform.copy()
        matrix[:3, 3] += 1e6
        shape.transform = matrix
    settings: dict[str, Any] = {"footprint": 0.1, "bias": 0.01, "backend": backend}
    moved = po.trace_transmittance(here, at + 1e6, **settings)
    # 1e6 holds world points to 1e-10; a ray in a million may meet an edge within that.
    np.testing.assert_allclose(moved, expected, atol=1e-4)


def test_the_union_of_scenes_multiplies_t() -> None:
    scene, at = random_scene(8), np.random.default_rng(8).uniform(-2.5, 2.5, (1000, 3))
    shapes, light = scene.shapes, scene.lights[0]
    both = po.trace_transmittance(scene, at, bias=0.1)
    alone = [po.trace_transmittance(po.Scene(s, light), at, bias=0.1) for s in shapes]
    np.testing.assert_allclose(both, np.prod(alone, axis=0, dtype=np.float64), atol=1e-6)


@pytest.mark.parametrize("scale", [1e-12, 1e-3, 1e6])
def test_units_do_not_matter(scale: float) -> None:
    at = np.random.default_rng(9).uniform(-2.5, 2.5, (500, 3))
    scene = random_scene(9)
    expected = po.trace_transmittance(scene, at, bias=0.1)
    for shape in scene.shapes:
        matrix = shape.transform.copy()
        matrix[:3] *= scale
        shape.transform = matrix
    T = po.trace_transmittance(scene, at * scale, bias=0.1 * scale)
    assert np.mean(np.abs(T - expected) > 1e-5) < 5e-3


# ---- bias, what casts, what is asked ----


def test_the_automatic_bias(sheet: Sheet) -> None:
    wide = strand((-1, 0, 0), (1, 0, 0), width=0.5)
    veil = strand((-1, 0, 0.4), (1, 0, 0.4), width=0.1)
    scene = po.Scene(wide, veil, DOWN)
    middle = points((0, 0, 0))
    # Mean width .3: the veil counts. For the wide strand's own points it lies within the bias.
    assert po.trace_transmittance(scene, middle).tolist() == [0.5]
    asked = strand((-0.5, 0, 0), (0.5, 0, 0), width=0.5)
    assert po.trace_transmittance(scene, asked).tolist() == [1.0, 1.0]
    assert po.trace_transmittance(scene, asked, bias=0.3).tolist() == [0.5, 0.5]
    each = np.array([0.41, 0.39])
    assert po.trace_transmittance(scene, asked, bias=each).tolist() == [1.0, 0.5]
    # Surfaces have no width: 1e-4 of the radius, here 2.8.
    sheets = po.Scene(sheet(opacity=0.5), DOWN)
    at = points((0.1, 0, -2.7e-4), (0.1, 0, -3e-4))
    assert po.trace_transmittance(sheets, at).tolist() == [1.0, 0.5]


def test_only_casters_cast_and_shapes_are_asked_where_they_are(sheet: Sheet) -> None:
    ghost, clear = sheet(1.0, opacity=0.5), sheet(1.0, opacity=0.0)
    ghost.casts = False
    at = points((0, 0, 0))
    assert trace(ghost, clear, at=at).tolist() == [1.0]
    moved = sheet(0.0, opacity=0.5)
    moved.transform = np.diag([1.0, 1.0, 1.0, 1.0]) + np.eye(4, k=3) * 1.5
    lower = sheet(-1.0, half_size=1.0, opacity=0.5)
    assert trace(moved, lower, at=lower).tolist() == [1.0, 0.5, 0.5, 1.0]
    lower.transform = np.diag([1.0, 1.0, -1.0, 1.0])  # above
    assert trace(moved, lower, at=lower).tolist() == [1.0] * 4


def test_nothing_to_trace() -> None:
    at = points((0, 0, 0), (1, 2, 3))
    assert po.trace_transmittance(po.Scene(), at).tolist() == [1.0, 1.0]
    assert po.trace_transmittance(po.Scene(DOWN), at, footprint=1.0).tolist() == [1.0, 1.0]
    dark = po.Scene(strand((-1, 0, 1), (1, 0, 1)))
    assert po.trace_transmittance(dark, at).tolist() == [1.0, 1.0]
    lit = po.Scene(dark.shapes, DOWN)
    T = po.trace_transmittance(lit, np.empty((0, 3), np.float32), bias=np.empty(0))
    assert T.shape == (0,) and T.dtype == np.float32
    lights = po.Scene(dark.shapes, DOWN, po.DirectionalLight((1.0, 0.0, 0.0)))
    assert [po.trace_transmittance(lights, at, light)[0] for light in (0, 1)] == [0.5, 1.0]


@backends
@pytest.mark.parametrize("scale", [1e-100, 1e-30, 1.0, 1e12])
def test_absurd_numbers_give_no_nan(scale: float, backend: str) -> None:
    small = strand((-scale, 0, scale), (scale, 0, scale), (scale, 0, scale), width=scale)
    far = np.array([[x, y, z] for x in (-1e18, 0, 1e18) for y in (0, 1e18) for z in (-1e18, 1e18)])
    for settings in ({}, {"footprint": 1e18, "samples": 3}, {"bias": 1e18}, {"bias": 0.0}):
        T = trace(small, at=far, backend=backend, **{"bias": "auto", **settings})
        assert np.isfinite(T).all() and T.min() >= 0.0 and T.max() <= 1.0
    assert trace(small, at=far[4:5], backend=backend)[0] == 0.5  # (0, 0, -1e18)


@pytest.mark.parametrize(
    ("settings", "named"),
    [
        ({"points": points((0, 0, 0), (0, np.nan, 0))}, "points[1]"),
        ({"points": points((np.inf, 0, 0))}, "points[0]"),
        ({"points": np.zeros((2, 2))}, "shape (N, 3)"),
        ({"points": np.zeros((2, 3), int)}, "float32"),
        ({"points": [[0.0, 0.0, 0.0]]}, "list"),
        ({"light": 1}, "light = 1 of 1"),
        ({"light": -1}, "light = -1"),
        ({"footprint": -1.0}, "footprint = -1"),
        ({"footprint": np.nan}, "footprint"),
        ({"samples": 0}, "samples = 0"),
        ({"samples": 65537}, "1..65536"),
        ({"samples": 2.5}, "samples"),
        ({"bias": -0.1}, "bias = -0.1"),
        ({"bias": np.array([0.1, np.nan])}, "bias[1]"),
        ({"bias": np.zeros(3)}, "bias has 3 entries for 2 points"),
        ({"bias": np.zeros(0)}, "bias is empty"),
        ({"bias": "none"}, "bias"),
        ({"backend": "optix"}, '"optix"'),
        ({"backend": 3}, "backend"),
        ({"progress": 3}, "progress"),
        ({"scene": None}, "scene"),
    ],
)
def test_bad_input_is_named(settings: dict[str, Any], named: str) -> None:
    scene = po.Scene(strand((-1, 0, 1), (1, 0, 1)), DOWN)
    call: dict[str, Any] = {"scene": scene, "points": np.zeros((2, 3)), **settings}
    with pytest.raises(po.ParameterError) as caught:
        po.trace_transmittance(**call)
    assert named in caught.value.what + caught.value.fix


# ---- a long call ----


def long_scene() -> tuple[po.Scene, po.Shape]:
    hair = po.load("demo:hair?segments=20000")
    return po.Scene(hair, po.DirectionalLight((0.5, 0.3, -0.8))), hair[0]


def test_progress_rises_to_1_on_the_calling_thread() -> None:
    scene, hair = long_scene()
    told: list[tuple[float, int]] = []
    T = po.trace_transmittance(
        scene,
        hair,
        footprint=1.0,
        samples=4,
        progress=lambda f: told.append((f, threading.get_ident())),
    )
    fractions = [fraction for fraction, _ in told]
    assert fractions == sorted(fractions) and fractions[0] >= 0.0 and fractions[-1] == 1.0
    assert {thread for _, thread in told} == {threading.get_ident()} and len(T) > 0


def test_an_error_in_progress_stops_it() -> None:
    scene, hair = long_scene()

    def refuse(fraction: float) -> None:
        raise RuntimeError("enough")

    start = time.perf_counter()
    with pytest.raises(RuntimeError, match="enough"):
        po.trace_transmittance(scene, hair, footprint=1.0, samples=60000, progress=refuse)
    assert time.perf_counter() - start < 5.0


@pytest.mark.skipif(os.name != "posix", reason="sends a signal to itself")
def test_ctrl_c_stops_it() -> None:
    scene, hair = long_scene()
    threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
    start = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        po.trace_transmittance(scene, hair, footprint=1.0, samples=60000)
    assert time.perf_counter() - start < 5.0
    assert len(po.trace_transmittance(scene, hair, footprint=0.0)) == len(hair.points)
