"""The reference technique against a float64 brute force that shares no code with it."""

import numpy as np
import pytest

import pyopacity as po
from pyopacity.stress import oracle
from scenes import tangle


def lit(shapes, direction=(0.5, 0.3, -0.8)):
    scene = po.Scene()
    scene.add(shapes)
    scene.add(po.DirectionalLight(direction=direction))
    return scene


@pytest.mark.parametrize(
    ("seed", "map_size", "width"), [(1, 16, 0.3), (2, 64, 0.05), (3, 32, 1.5), (4, 128, 0.4)]
)
def test_exact_equals_a_brute_force_over_fragments(needs_gl, seed, map_size, width):
    points, offsets = tangle(seed)
    rng = np.random.default_rng(seed)
    widths = width * rng.uniform(0.5, 1.5, len(points))
    opacities = rng.uniform(0.05, 0.6, len(points))
    strands = po.Strands(points, offsets, width=widths, opacity=opacities)
    bias = 0.37
    technique = po.technique("exact", bias=bias)
    with po.Renderer(lit(strands), size=(8, 8), technique=technique, map_size=map_size) as r:
        got = r.transmittance(strands)
        matrix = r.light_from_world
    # What the engine stores is float32.
    widths, opacities = (
        widths.astype(np.float32).astype(float),
        opacities.astype(np.float32).astype(float),
    )
    lists = oracle.deposit(points, offsets, widths, opacities, matrix, map_size)
    expected = oracle.transmittance(
        lists, oracle.light_points(matrix, points), bias / oracle.depth_range(matrix)
    )
    assert np.abs(got - expected).max() < 1e-4
    assert expected.min() < 0.9  # the scene does cast
