"""Adaptive opacity maps: where planes lie, closed forms, what refining and tiles are worth."""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pytest

import pyopacity as po
from layer_errors import LIGHT, Errors, hair, rmse

MAPS = "adaptive_opacity_maps"
DEVICES = ["cpu", pytest.param("gpu", marks=pytest.mark.gl)]
DOWN = po.DirectionalLight((0.0, 0.0, -1.0))
EVEN_PART = 0.25  # of the planes, of strands and surfaces


def two_clusters() -> po.Scene:
    """Two dense clouds of threads with a lone thread far behind, which stretches every bound."""
    random = np.random.default_rng(3)
    roots = (
        random.normal(0.0, 0.5, (1500, 1, 3))
        + np.array([0, 0, 4.0]) * (np.arange(1500) % 2)[:, None, None]
    )
    points = roots + np.linspace(-1, 1, 4)[:, None] * random.normal(0, 0.3, (1500, 1, 3))
    far = np.array([[[-1, 0, -30], [-0.3, 0, -30], [0.3, 0, -30], [1, 0, -30]]], float)
    every = np.concatenate([points, far]).reshape(-1, 3)
    offsets = np.arange(1502) * 4
    return po.Scene(
        po.Strands(every, offsets, width=0.05, opacity=0.4), po.DirectionalLight((0, 0, -1))
    )


Array = npt.NDArray[np.float64]


def renderer(scene: po.Scene, device: str = "cpu", map_size: int = 32, **parameters) -> po.Renderer:
    technique = po.technique(MAPS, **parameters)
    return po.Renderer(scene, technique=technique, device=device, map_size=map_size, size=(8, 8))


def planes(used: po.Renderer, layers: int) -> Array:
    """Of every tile, with the 0 and the 1 that all have."""
    images = used.read(f"{MAPS}/tile_planes").astype(float)
    flat = np.moveaxis(images, 0, 2).reshape(*images.shape[1:3], -1)
    assert flat.shape[-1] == 4 * -(-(layers - 1) // 4)
    inner = flat[..., : layers - 1]
    ends = np.zeros((*inner.shape[:2], 1))
    return np.concatenate([ends, inner, ends + 1.0], axis=-1)


def stack(sheet: Callable[..., po.Mesh], depths: Array, opacity: float) -> po.Scene:
    """Level sheets, at these parts of the way from the first to the last."""
    sheets = [sheet(10.0 * (1.0 - z), 2.0, opacity=opacity) for z in depths]
    return po.Scene(*sheets, DOWN)


# ---- where planes lie ----


@pytest.mark.parametrize("device", DEVICES)
def test_planes_lie_at_equal_steps_of_what_the_light_loses(
    sheet: Callable[..., po.Mesh], device: str
) -> None:
    """A medium that is even: between two planes the light loses the same, up to the even part."""
    depths, layers = np.linspace(0.0, 1.0, 161), 8
    with renderer(stack(sheet, depths, 0.02), device, layers=layers, filter="none") as used:
        used.transmittance(np.zeros((1, 3)))
        found = planes(used, layers)[16, 16]
    optical_depth = -161.0 * np.log1p(-0.02)
    steps = (1 - EVEN_PART) * np.expm1(-optical_depth * found) / np.expm1(-optical_depth)
    assert np.abs(np.diff(steps + EVEN_PART * found) - 1 / layers).max() < 0.2 / layers
    # Even planes are far from that.
    assert np.diff(found).max() > 3 * np.diff(found).min()


@pytest.mark.parametrize("layers", [2, 5, 16, 64])
@pytest.mark.parametrize("refine", ["once", "frames", 0])
def test_planes_rise_between_the_bounds(layers: int, refine: str | int) -> None:
    for scene in (hair(2000)[0], two_clusters()):
        with renderer(scene, layers=layers, refine=refine) as used:
            used.transmittance(np.zeros((1, 3)))
            found = planes(used, layers)
        assert (np.diff(found, axis=-1) >= 0).all()
        assert (found[..., -2] < 1).all()


@pytest.mark.parametrize("device", DEVICES)
def test_no_plane_is_wasted_on_a_gap(sheet: Callable[..., po.Mesh], device: str) -> None:
    clusters = np.concatenate([np.linspace(0.0, 0.1, 12), np.linspace(0.9, 1.0, 12)])
    with renderer(stack(sheet, clusters, 0.1), device, layers=16, filter="none") as used:
        used.transmittance(np.zeros((1, 3)))
        found = planes(used, 16)[16, 16, 1:-1]
    in_gap = (found > 0.15) & (found < 0.85)
    assert in_gap.sum() <= 1 + EVEN_PART * 16 * 0.7


def test_an_empty_texel_has_even_planes() -> None:
    scene, _ = hair(200)
    with renderer(scene, layers=4) as used:
        used.transmittance(np.zeros((1, 3)))
        is_empty = used.read(f"{MAPS}/start").reshape(32, 32) == 1.0
        found = planes(used, 4)
    assert is_empty.any()
    assert np.abs(found[is_empty] - np.linspace(0, 1, 5)).max() < 1e-6


# ---- closed forms ----


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("layers", [1, 4, 16])
def test_one_sheet(sheet: Callable[..., po.Mesh], device: str, layers: int) -> None:
    scene = po.Scene(sheet(0.0, 2.0, opacity=0.7), DOWN)
    points = np.array([[0.3, 0.2, z] for z in (0.5, 0.0, -1e-4, -0.5)])
    with renderer(scene, device, layers=layers, bias=0.0) as used:
        T = used.transmittance(points)
    assert np.abs(T - [1.0, 1.0, 0.3, 0.3]).max() < 1e-6


@pytest.mark.parametrize("device", DEVICES)
def test_two_sheets_are_steps(sheet: Callable[..., po.Mesh], device: str) -> None:
    """Each has a layer of its own, and T is right as near to them as these layers are narrow."""
    scene = stack(sheet, np.array([0.0, 1.0]), 0.5)
    part = np.array([0.01, 0.05, 0.5, 0.95, 0.99, 1.01])
    points = np.stack([0.3 + 0 * part, 0.2 + 0 * part, 10.0 * (1.0 - part)], axis=1)
    with renderer(scene, device, layers=16, bias=0.0) as used:
        T = used.transmittance(points)
    assert np.abs(T - [0.5, 0.5, 0.5, 0.5, 0.5, 0.25]).max() < 1e-5


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("layers", [8, 16])
def test_an_even_slab(sheet: Callable[..., po.Mesh], device: str, layers: int) -> None:
    """T = exp(-Omega z): between planes optical depth grows evenly, so that nothing is lost."""
    depths = (np.arange(320) + 0.5) / 320
    part = np.linspace(0.05, 0.95, 19)
    points = np.stack([0.3 + 0 * part, 0.2 + 0 * part, 10.0 * (1.0 - part)], axis=1)
    with renderer(stack(sheet, depths, 0.01), device, layers=layers, bias=0.0) as used:
        T = used.transmittance(points)
    assert np.abs(T - (1 - 0.01) ** (320 * part)).max() < 0.01


# ---- what it is worth ----


@pytest.mark.parametrize("layers", [8, 16])
def test_errors_are_far_below_those_of_the_papers(layers: int) -> None:
    published = {"own_correction": False}
    linear = published | {"interpolation": "linear"}
    errors = Errors(*hair())
    best = min(
        rmse(errors.of("opacity_shadow_maps", layers=layers, **linear)),
        rmse(errors.of("deep_opacity_maps", layers=layers, **published)),
        *(
            rmse(errors.of("bounding_opacity_maps", layers=layers, split=split, **linear))
            for split in ("linear", "hybrid", "logarithmic")
        ),
    )
    # Of straight.hair and bear.hair .35 (docs/accuracy_tables.md).
    assert rmse(errors.of(MAPS, layers=layers)) <= 0.45 * best


SCENES = {
    "hair": "demo:hair?segments=6000",
    "grass": "demo:grass?segments=6000",
    "leaves": "demo:tree?leaves=2000",
    "particles": "demo:plume?particles=1500",
    "mixed": "demo:mixed?primitives=4000",
}


@pytest.mark.parametrize("name", [*SCENES, "clusters"])
@pytest.mark.parametrize("layers", [4, 16])
def test_nothing_is_lost_against_bounding_maps(name: str, layers: int) -> None:
    scene = two_clusters()
    if name != "clusters":
        scene = po.Scene(po.load(SCENES[name]), po.DirectionalLight(LIGHT))
    receiver = next(shape for shape in scene.shapes if shape.casts)
    errors = Errors(scene, receiver, 256)
    ours, bounding = (
        rmse(errors.of(maps, layers=layers)) for maps in (MAPS, "bounding_opacity_maps")
    )
    assert ours <= bounding


def test_refining_and_planes_of_ones_own_are_worth_it() -> None:
    errors = Errors(*hair())
    once = rmse(errors.of(MAPS))
    assert once < 0.95 * rmse(errors.of(MAPS, refine=0))
    assert once < 0.95 * rmse(errors.of(MAPS, tile=8))
    assert rmse(errors.of(MAPS, tile=8)) < rmse(errors.of("bounding_opacity_maps"))


# ---- over frames ----


def test_over_frames_planes_come_to_rest() -> None:
    scene, strands = hair(3000)
    with renderer(scene, layers=8, refine="frames", map_size=64) as used:
        found, ran = [], []
        for _ in range(8):
            used.transmittance(strands)
            found.append(planes(used, 8))
            ran.append({row.name for row in used.report if row.status == "ran"})
            moved = [np.abs(b - a).mean() for a, b in zip(found, found[1:], strict=False)]
    assert moved[0] > 0 and moved[1] > 0
    assert moved[2:] == [0] * 5
    assert f"{MAPS}/cells/opacity" in ran[0] and f"{MAPS}/cells/opacity" not in ran[1]
    assert not any(name.startswith(MAPS) for name in ran[-1])


def test_over_frames_nothing_is_lost() -> None:
    scene, strands = hair(6000)
    with renderer(scene, layers=16, map_size=128) as used:
        used.technique = "exact"
        exact = used.transmittance(strands)
        used.technique = po.technique(MAPS)
        once = used.transmittance(strands)
        used.technique = po.technique(MAPS, refine="frames")
        first = used.transmittance(strands)
        for _ in range(4):
            last = used.transmittance(strands)
        assert np.array_equal(first, once)
        assert rmse(last - exact) <= 1.05 * rmse(once - exact)


def test_what_moves_starts_from_the_planes_of_the_frame_before() -> None:
    scene, strands = hair(3000)
    with renderer(scene, layers=16, refine="frames", map_size=64) as used:
        for frame in range(6):
            strands.transform = np.eye(4) + 0.002 * frame * np.eye(4, k=3)
            T = used.transmittance(strands)
        assert not any("cells" in row.name for row in used.report)
        used.technique = "exact"
        exact = used.transmittance(strands)
        used.technique = po.technique("bounding_opacity_maps")
        bounding = used.transmittance(strands)
    assert rmse(T - exact) < rmse(bounding - exact)


# ---- both devices ----


@pytest.mark.gl
@pytest.mark.parametrize("parameters", [{}, {"tile": 4}, {"refine": 0}, {"layers": 5}])
def test_the_gpu_equals_the_cpu(parameters: dict[str, int]) -> None:
    scene, strands = hair(6000)
    T, exact = [], []
    for device in ("cpu", "gpu"):
        with renderer(scene, device, map_size=128, **parameters) as used:
            T.append(used.transmittance(strands))
            used.technique = "exact"
            exact.append(used.transmittance(strands))
    alike = np.abs(exact[0] - exact[1]) < 1e-4  # not so one vertex that falls on a texel's edge
    assert alike.mean() > 0.999
    assert np.abs(T[0] - T[1])[alike].max() < 1e-4
