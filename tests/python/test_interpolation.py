"""What a look-up makes of a layer between two planes: closed forms, and what it is worth."""

from collections.abc import Callable

import numpy as np
import pytest

import pyopacity as po
from layer_errors import LIGHT, Errors, hair, rmse

DEVICES = ["cpu", pytest.param("gpu", marks=pytest.mark.gl)]
PART = np.linspace(0.02, 0.98, 25)  # from the first sheet to the last one


def linear(first: float, last: float) -> np.ndarray:
    return ((1 - first) * (1 - last)) ** PART


def about_the_mean_depth(first: float, last: float) -> np.ndarray:
    """Two casters of half of the layer each, met with the same probability."""
    weights = -np.log1p([-first, -last])
    mean = weights[1] / weights.sum()
    reach = min(mean, 1 - mean)
    met = np.clip((PART - mean + reach) / (2 * reach), 0, 1)
    return (1 - met * -np.expm1(-weights.sum() / 2)) ** 2


EXPECTED = {"linear": linear, "mean_depth": about_the_mean_depth}


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize(("first", "last"), [(0.1, 0.1), (0.5, 0.5), (0.9, 0.3), (0.2, 0.8)])
@pytest.mark.parametrize("interpolation", EXPECTED)
def test_one_layer_between_two_sheets(
    sheet: Callable[..., po.Mesh], device: str, first: float, last: float, interpolation: str
) -> None:
    scene = po.Scene(
        sheet(1.0, 2.0, opacity=first),
        sheet(0.0, 2.0, opacity=last),
        po.DirectionalLight((0.0, 0.0, -1.0)),
    )
    points = np.stack([0.3 * np.ones(25), 0.2 * np.ones(25), 1.0 - PART], axis=1)
    technique = po.technique(
        "bounding_opacity_maps", layers=1, interpolation=interpolation, bias=0.0
    )
    with po.Renderer(scene, technique=technique, size=(8, 8), map_size=32, device=device) as r:
        T = r.transmittance(points)
    assert np.abs(T - EXPECTED[interpolation](first, last)).max() < 2e-5


def _leaves() -> tuple[po.Scene, po.Shape]:
    scene = po.Scene(po.load("demo:tree?leaves=3000"), po.DirectionalLight(LIGHT))
    return scene, next(s for s in scene.shapes if isinstance(s, po.Mesh) and not s.opaque)


def _particles() -> tuple[po.Scene, po.Shape]:
    rng = np.random.default_rng(5)
    particles = po.Particles(rng.uniform(-1, 1, (800, 3)), rng.uniform(0.05, 0.12, 800))
    particles.opacity = 0.4
    return po.Scene(particles, po.DirectionalLight(LIGHT)), particles


@pytest.mark.parametrize("make", [hair, _leaves, _particles], ids=["hair", "leaves", "particles"])
@pytest.mark.parametrize("layers", [8, 16])
def test_mean_depths_are_worth_more_than_as_many_planes(
    make: Callable[[], tuple[po.Scene, po.Shape]], layers: int
) -> None:
    """In the same memory: K planes with mean depths, and 2 K without."""
    errors = Errors(*make())
    ours = errors.of("bounding_opacity_maps", layers=layers, interpolation="mean_depth")
    more = errors.of("bounding_opacity_maps", layers=2 * layers, interpolation="linear")
    assert rmse(ours) < 0.9 * rmse(more)


def test_auto_keeps_mean_depths_where_sums_are_fine() -> None:
    scene, _ = hair(200)

    def textures(**parameters: str) -> bool:
        technique = po.technique("bounding_opacity_maps", **parameters)
        with po.Renderer(scene, technique=technique, device="cpu", map_size=32) as renderer:
            renderer.transmittance(np.zeros((1, 3)))
            try:
                renderer.read("bounding_opacity_maps/moments")
            except po.ParameterError:
                return False
        return True

    assert textures()
    assert not textures(interpolation="linear")
    assert not textures(accumulator="float16")
