"""Deep shadow maps against the exact lists of the same map, texel by texel."""

import numpy as np
import pytest

import pyopacity as po
from scenes import random_shapes, tangle

LIGHT = (0.5, 0.3, -0.8)
MAP_SIZE = 64
DEVICES = pytest.mark.parametrize("device", ["gpu", "cpu"])
LEAST_IN_INTERVALS = 1e-4  # deep_shadow_maps.hpp
ROUNDING = 1e-6

pytestmark = pytest.mark.usefixtures("needs_gl")


def hair(opacity: float = 0.3, strands: int = 150, width: float = 0.2) -> po.Scene:
    points, offsets = tangle(3, strands=strands)
    strands_ = po.Strands(points, offsets, width=width, opacity=opacity)
    return po.Scene(strands_, po.DirectionalLight(LIGHT))


def every_kind() -> po.Scene:
    return po.Scene(random_shapes(3), po.DirectionalLight(LIGHT))


SCENES = {"hair": (hair, 12.0), "every kind": (every_kind, 2.5)}


def points_in(reach: float) -> np.ndarray:
    return np.random.default_rng(4).uniform(-reach, reach, (10_000, 3))


def answered(
    scene: po.Scene, points: np.ndarray | po.Shape, technique: po.Technique, device: str
) -> np.ndarray:
    with po.Renderer(scene, technique=technique, map_size=MAP_SIZE, device=device) as renderer:
        return renderer.transmittance(points)


def entries(scene: po.Scene, technique: po.Technique, name: str) -> np.ndarray:
    """How long each texel's list is."""
    with po.Renderer(scene, technique=technique, map_size=MAP_SIZE, device="cpu") as renderer:
        renderer.transmittance(np.zeros((1, 3)))
        return renderer.read(f"{technique.name}/{name}")


@DEVICES
@pytest.mark.parametrize("kind", SCENES)
@pytest.mark.parametrize("filter", ["none", "box"])
@pytest.mark.parametrize("error_bound", [0.0, 0.003, 0.01, 0.1])
def test_every_sample_is_within_the_bound(
    device: str, kind: str, filter: str, error_bound: float
) -> None:
    build, reach = SCENES[kind]
    scene, points = build(), points_in(reach)
    exact = answered(scene, points, po.technique("exact", filter=filter), device)
    deep = po.technique("deep_shadow_maps", filter=filter, error_bound=error_bound)
    bound = error_bound if kind == "hair" else max(error_bound, LEAST_IN_INTERVALS)
    error = np.abs(answered(scene, points, deep, device) - exact)
    assert error.max() <= bound + ROUNDING
    assert error.max() >= 0.5 * error_bound  # and it is used
    assert exact.min() < 0.3


@DEVICES
def test_behind_everything_it_is_exact(device: str) -> None:
    """What a whole texel lets through has no error, however few nodes it keeps."""
    for build, reach in SCENES.values():
        scene = build()
        points = points_in(reach) + 5.0 * reach * np.array(LIGHT)
        exact = answered(scene, points, po.technique("exact"), device)
        for parameters in ({"error_bound": 0.2}, {"nodes": 1}, {"nodes": 3}):
            deep = po.technique("deep_shadow_maps", **parameters)
            assert np.abs(answered(scene, points, deep, device) - exact).max() < 1e-5


def test_receivers_on_shapes_are_within_the_bound_too() -> None:
    scene = hair()
    exact = answered(scene, scene.shapes[0], po.technique("exact"), "gpu")
    deep = answered(scene, scene.shapes[0], po.technique("deep_shadow_maps"), "gpu")
    assert np.abs(deep - exact).max() <= 0.01 + ROUNDING


def test_nodes_are_fewer_than_fragments_where_these_are_many_and_thin() -> None:
    scene = hair(opacity=0.05, strands=3000)
    fragments = entries(scene, po.technique("exact"), "count").sum()
    counts = [
        entries(scene, po.technique("deep_shadow_maps", error_bound=bound), "node_count").sum()
        for bound in (0.003, 0.01, 0.03, 0.1)
    ]
    assert counts[1] < 0.4 * fragments
    assert np.all(np.diff(counts) < 0)


@DEVICES
def test_a_number_of_nodes_is_kept_to_and_more_of_them_err_less(device: str) -> None:
    scene, points = hair(), points_in(12.0)
    exact = answered(scene, points, po.technique("exact", filter="none"), device)
    errors = []
    for nodes in (1, 2, 4, 8, 16, 32):
        deep = po.technique("deep_shadow_maps", filter="none", nodes=nodes)
        assert entries(scene, deep, "node_count").max() <= nodes
        errors.append(po.metrics.rmse(answered(scene, points, deep, device), exact))
    assert np.all(np.diff(errors) < 0)
    assert errors[-1] < 0.002


@pytest.mark.parametrize("parameters", [{}, {"nodes": 8}, {"error_bound": 0.0}])
def test_shaders_and_cpp_keep_the_same_nodes(parameters: dict[str, float]) -> None:
    scene = hair()
    lists = []
    for device in ("gpu", "cpu"):
        technique = po.technique("deep_shadow_maps", **parameters)
        with po.Renderer(scene, technique=technique, map_size=MAP_SIZE, device=device) as renderer:
            renderer.transmittance(np.zeros((1, 3)))
            count = renderer.read("deep_shadow_maps/node_count")
            lists.append(
                renderer.read("deep_shadow_maps/node_list").ravel()[: 2 * int(count.sum())]
            )
    assert len(lists[0]) == len(lists[1])
    assert np.abs(lists[0] - lists[1]).max() < 1e-5


@DEVICES
@pytest.mark.parametrize("nodes", [0, 8])
def test_a_list_of_many_parts_stays_within_the_bound(device: str, nodes: int) -> None:
    """20,000 equal strands over one texel: T falls as exp, whatever a part of the list holds."""
    count, tau = 20_000, 2.0
    points = np.zeros((count, 2, 3))
    points[:, 0, 0], points[:, 1, 0] = -8, 8
    points[:, :, 2] = np.linspace(0.0, 1.0, count)[:, None]
    opacity = float(-np.expm1(-tau / count))
    strands = po.Strands(points.reshape(-1, 3), 2 * np.arange(count + 1), 16.0, opacity)
    scene = po.Scene(strands, po.DirectionalLight((0, 0, -1)))
    depths = np.linspace(1.0, 0.0, 101)
    places = np.stack([np.zeros(101), np.zeros(101), depths - 0.5 / count], axis=1)
    technique = po.technique("deep_shadow_maps", bias=0.0, nodes=nodes)
    with po.Renderer(scene, technique=technique, map_size=16, device=device) as renderer:
        T = renderer.transmittance(places)
    assert np.abs(T - np.exp(-tau * (1.0 - depths))).max() < (0.02 if nodes else 0.0102)
