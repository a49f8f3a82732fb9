"""A split ratio for each texel, or region of texels: what is found, what it is worth, and when."""

import numpy as np
import numpy.typing as npt
import pytest

import pyopacity as po
from layer_errors import LIGHT, Errors, hair, rmse

MAPS = "bounding_opacity_maps"
DEVICES = ["cpu", pytest.param("gpu", marks=pytest.mark.gl)]
LOCAL = {"per_texel": 1, "per_region": 8}  # texels to a side of what has one ratio
RATIOS = np.arange(11) / 10
Array = npt.NDArray[np.float32]


def renderer(scene: po.Scene, device: str = "cpu", map_size: int = 36, **parameters) -> po.Renderer:
    technique = po.technique(MAPS, **{"layers": 4, **parameters})
    return po.Renderer(scene, technique=technique, device=device, map_size=map_size, size=(8, 8))


def ratios(used: po.Renderer) -> Array:
    return used.read(f"{MAPS}/split_ratios")


# ---- what is found ----


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("split", LOCAL)
def test_each_region_has_one_of_eleven_ratios(device: str, split: str) -> None:
    scene, strands = hair(2000)
    with renderer(scene, device, split=split) as used:
        used.transmittance(strands)
        found = ratios(used)
    assert found.shape[:2] == (-(-36 // LOCAL[split]),) * 2
    assert np.abs(found[..., None] - RATIOS).min(axis=-1).max() < 1e-6
    assert len(np.unique(found)) > 3


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("split", LOCAL)
@pytest.mark.parametrize("interpolation", ["linear", "mean_depth"])
def test_each_texel_is_drawn_and_looked_up_at_its_own_ratio(
    device: str, split: str, interpolation: str
) -> None:
    scene, strands = hair(2000)
    with renderer(scene, device, split=split, filter="none", interpolation=interpolation) as used:
        T = used.transmittance(strands)
        found = ratios(used)
        places = strands.points @ used.light_from_world[:2, :3].T + used.light_from_world[:2, 3]
        x, y = np.floor(places.T).astype(int) // LOCAL[split]
        used.technique.split = "hybrid"
        of_ratio = []
        for ratio in RATIOS:
            used.technique.split_ratio = ratio
            of_ratio.append(used.transmittance(strands))
    picked = np.rint(10 * found.reshape(found.shape[:2])[y, x]).astype(int)
    wanted = np.asarray(of_ratio)[picked, np.arange(len(picked))]
    on_border = np.abs(places - np.rint(places)).min(axis=1) < 1e-3
    assert np.array_equal(T[~on_border], wanted[~on_border])


def planes_of(ratio: float, layers: int) -> npt.NDArray[np.float64]:
    """Where f(x) = k / K, by interpolation in a dense table of f."""
    x = np.linspace(0.0, 1.0, 400001)
    f = (1 - ratio) * x + ratio * np.log2(1 + 255 * x) / 8
    return np.interp(np.arange(layers + 1) / layers, f, x)


def square_error(held: Array, cells: Array, planes: Array, bias: float) -> float:
    """By brute force: the sum of squares of the error of T on each caster, by its optical depth."""
    places = 0.5 * (cells[:-1] + cells[1:])
    places[0], places[-1] = 0.0, 1.0
    layer = np.searchsorted(planes[1:-1], places, side="right")
    total = 0.0
    for i in np.flatnonzero(held > 0):
        x = places[i] - bias
        truth = held[places < x].sum()
        k = np.searchsorted(planes[1:-1], x, side="right")
        others = (layer == k) & (np.arange(len(held)) != i)
        found = held[layer < k].sum()
        if others.any() and held[others].sum() > 0:
            mean = np.average(places[others], weights=held[others])
            reach = min(mean - planes[k], planes[k + 1] - mean)
            met = (x - mean + reach) / (2 * reach) if reach > 0 else float(x > mean)
            found += np.clip(met, 0, 1) * held[others].sum()
        total += held[i] * (np.exp(-found) - np.exp(-truth)) ** 2
    return total


def test_the_ratio_of_a_texel_is_the_best_for_it_and_its_neighbours() -> None:
    scene, strands = hair(3000)
    layers, size = 4, 12
    with renderer(scene, map_size=size, split="per_texel", bias=0.02) as used:
        used.transmittance(strands)
        found = ratios(used).reshape(size, size)
        sums = np.moveaxis(used.read(f"{MAPS}/histogram"), 0, -2).reshape(size, size, -1)
        start, end = (
            used.read(f"{MAPS}/{name}").reshape(size, size).astype(np.float64)
            for name in ("start", "end")
        )
        depth_range = 1.0 / np.linalg.norm(used.light_from_world[2, :3])
    held = np.diff(sums.astype(np.float64), axis=-1, prepend=0.0)
    cells = planes_of(0.45, held.shape[-1])
    trials = [planes_of(ratio, layers) for ratio in RATIOS]
    scores = np.zeros((size, size, len(RATIOS)))
    for y, x in np.argwhere(held.sum(axis=-1) > 0):
        reach = end[y, x] - start[y, x]
        bias = min(1.0, 0.02 / depth_range / reach) if reach > 0 else 1.0
        scores[y, x] = [square_error(held[y, x], cells, planes, bias) for planes in trials]
    weights = held.sum(axis=-1)
    for y, x in np.argwhere(weights[1:-1, 1:-1] > 0) + 1:
        around = np.s_[y - 1 : y + 2, x - 1 : x + 2]
        square = scores[around].sum(axis=(0, 1)) + 7 * scores[y, x]
        roots = np.sqrt(square / (weights[around].sum() + 7 * weights[y, x]))
        assert roots[int(round(10 * found[y, x]))] <= roots.min() + 2e-4, (y, x)


@pytest.mark.gl
@pytest.mark.parametrize("split", LOCAL)
@pytest.mark.parametrize("similarity", ["error", "absolute_difference"])
def test_shaders_find_what_the_cpu_does(split: str, similarity: str) -> None:
    scene, strands = hair(8000)
    found = []
    for device in ("cpu", "gpu"):
        with renderer(scene, device, 64, split=split, similarity=similarity, layers=8) as used:
            used.transmittance(strands)
            found.append(ratios(used))
    assert np.mean(found[0] != found[1]) < 0.005


# ---- what it is worth ----


@pytest.mark.parametrize("layers", [8, 16])
def test_a_ratio_for_each_texel_beats_the_best_one_for_all(layers: int) -> None:
    """Depth error on everything in demo:mixed, hair, leaves, grass and smoke in one map."""
    scene = po.Scene(po.load("demo:mixed"), po.DirectionalLight(LIGHT))

    def ask(name: str, **parameters: object) -> Array:
        technique = po.technique(name, **parameters)
        with po.Renderer(scene, technique=technique, device="cpu", map_size=128) as used:
            return np.concatenate([used.transmittance(shape) for shape in scene.shapes])

    exact = ask("exact")
    best = min(
        rmse(ask(MAPS, layers=layers, split="hybrid", split_ratio=r) - exact) for r in RATIOS
    )
    assert rmse(ask(MAPS, layers=layers, split="per_texel") - exact) < 0.95 * best


def test_a_ratio_for_each_region_beats_the_best_one_for_all_on_hair() -> None:
    errors = Errors(*hair())
    best = min(rmse(errors.of(MAPS, layers=8, split="hybrid", split_ratio=r)) for r in RATIOS)
    of_texels, of_regions = (rmse(errors.of(MAPS, layers=8, split=split)) for split in LOCAL)
    assert of_texels < of_regions < best


# ---- when ----


@pytest.mark.parametrize("device", DEVICES)
def test_it_is_found_in_the_same_frame_and_again_when_casters_move(device: str) -> None:
    scene, strands = hair(1000)
    passes = {f"{MAPS}/{name}" for name in ("split_scores", "split_ratios")}

    def ran(used: po.Renderer) -> set[str]:
        return {row.name for row in used.report if row.status == "ran"} & passes

    with renderer(scene, device, split="per_texel") as used:
        used.transmittance(strands)
        assert ran(used) == passes
        first = ratios(used)
        used.transmittance(strands.points[:5])
        assert ran(used) == set()
        strands.opacity = 0.9
        used.transmittance(strands)
        assert ran(used) == passes
        assert not np.array_equal(ratios(used), first)


@pytest.mark.parametrize("split", LOCAL)
def test_one_layer_has_no_ratio(split: str) -> None:
    scene, strands = hair(200)
    with renderer(scene, split=split, layers=1) as used:
        used.transmittance(strands)
        assert all("split" not in row.name for row in used.report)


def test_eleven_frames_are_refused() -> None:
    scene, strands = hair(200)
    with (
        renderer(scene, split="per_region", search_frames=11) as used,
        pytest.raises(po.ParameterError, match="one frame"),
    ):
        used.transmittance(strands)


@pytest.mark.parametrize("similarity", ["correlation", "paper_correlation"])
def test_a_measure_of_whole_images_is_refused(similarity: str) -> None:
    scene, strands = hair(200)
    with (
        renderer(scene, split="per_texel", similarity=similarity) as used,
        pytest.raises(po.ParameterError, match="compares whole images"),
    ):
        used.transmittance(strands)
