"""Bounding opacity maps against the exact lists of the same map."""

import sys
from pathlib import Path

import numpy as np
import pytest

import pyopacity as po

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "benchmarks"))
import depth_error


def error_of(scene, strands, map_size=128, **params):
    with po.Renderer(scene, size=(8, 8), technique="exact", map_size=map_size) as r:
        exact = r.transmittance(strands)
        r.technique = po.technique("bounding_opacity_maps", **params)
        return float(np.sqrt(np.mean((r.transmittance(strands) - exact) ** 2)))


def small_hair():
    scene = po.Scene()
    scene.add(po.load("demo:hair?segments=15000"))
    scene.add(po.DirectionalLight(direction=depth_error.LIGHT))
    strands = scene.shapes[0]
    strands.opacity = 0.3
    strands.width = 0.15  # as much hair as the whole demo has
    return scene, strands


@pytest.mark.parametrize("split", depth_error.SPLITS)
def test_the_error_falls_with_layers(needs_gl, split):
    scene, strands = small_hair()
    errors = [error_of(scene, strands, layers=n, split=split) for n in (1, 4, 16, 64)]
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 0.03


@pytest.mark.parametrize("layers", [4, 16])
def test_the_search_finds_nearly_the_best_ratio(needs_gl, layers):
    scene, strands = small_hair()
    found = error_of(scene, strands, layers=layers, split="auto")
    fixed = [
        error_of(scene, strands, layers=layers, split="hybrid", split_ratio=r / 5) for r in range(6)
    ]
    assert found <= 1.1 * min(fixed)
    assert found < max(fixed)


@pytest.mark.slow
@pytest.mark.parametrize("model", ["straight.hair", "bear.hair on bear_body.obj"])
def test_the_error_falls_with_layers_on_real_models(needs_gl, model):
    found = [(scene, strands) for name, scene, strands in depth_error.scenes() if name == model]
    if not found:
        pytest.skip(f"{model}: not there; set PYOPACITY_DATA")
    scene, strands = found[0]
    errors = [error_of(scene, strands, map_size=256, layers=n, split="hybrid") for n in (4, 8, 16)]
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 0.09
