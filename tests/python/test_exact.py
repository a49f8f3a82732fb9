"""The reference technique against a float64 brute force that shares no code with it."""

import numpy as np
import pytest

import pyopacity as po
import reference
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
    lists = reference.deposit(points, offsets, widths, opacities, matrix, map_size)
    expected = reference.transmittance(
        lists, reference.light_points(matrix, points), bias / reference.depth_range(matrix)
    )
    assert np.abs(got - expected).max() < 1e-4
    assert expected.min() < 0.9  # the scene does cast


def test_exact_is_the_same_on_every_run(needs_gl):
    points, offsets = tangle(5, strands=200)
    strands = po.Strands(points, offsets, width=0.3, opacity=0.3)
    results = []
    for _ in range(3):
        with po.Renderer(lit(strands), size=(8, 8), technique="exact", map_size=32) as r:
            results.append(r.transmittance(strands).tobytes())
    assert len(set(results)) == 1


@pytest.mark.parametrize("overlaps", [1, 2, 3, 1000, 20_000])
def test_many_fragments_in_one_texel_add_up(needs_gl, overlaps):
    """Behind N equal strands T is that of one to the power of N, however long the list."""
    z = np.linspace(0, 1, overlaps) if overlaps > 1 else np.zeros(1)
    points = np.zeros((overlaps, 2, 3))
    points[:, 0, 0], points[:, 1, 0] = -8, 8  # over several whole texels
    points[:, :, 2] = z[:, None]
    tau = 2.0 / overlaps
    opacity = -np.expm1(-tau)
    strands = po.Strands(
        points.reshape(-1, 3), np.arange(overlaps + 1) * 2, width=16.0, opacity=float(opacity)
    )
    with po.Renderer(
        lit(strands, (0, 0, -1)),
        size=(8, 8),
        technique=po.technique("exact", bias=0.0),
        map_size=16,
    ) as r:
        behind = r.transmittance(np.array([[0.0, 0.0, -1.0]]))
    assert -np.log(behind[0]) == pytest.approx(2.0, rel=2e-4)
