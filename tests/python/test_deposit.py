"""The deposit rule: optical depth does not depend on the map's size, nor on how a strand is cut."""

import numpy as np
import pytest

import pyopacity as po
from pyopacity.stress import oracle
from scenes import tangle

LIGHT = (0.5, 0.3, -0.8)
FAINT = 1e-3  # optical depth is then opacity times area, to 5e-4


def deposited(scene_shapes, map_size, direction=LIGHT):
    """Total optical depth of the map times the area of a texel, and the light's matrix."""
    scene = po.Scene()
    scene.add(scene_shapes)
    scene.add(po.DirectionalLight(direction=direction))
    technique = po.technique("bounding_opacity_maps", layers=4, split="linear")
    with po.Renderer(scene, size=(8, 8), technique=technique, map_size=map_size) as r:
        r.transmittance(np.zeros((1, 3)))
        planes = r.read("bounding_opacity_maps/opacity")
        matrix = r.light_from_world
    total = planes[-1, ..., -1].sum(dtype=np.float64)  # plane 4 of 4: all of it
    return total / oracle.texels_per_unit(matrix) ** 2, matrix


def ribbon_area(points, offsets, width, direction=LIGHT):
    """What ribbons facing the light cover as it sees them: projected length times width."""
    d = np.array(direction) / np.linalg.norm(direction)
    area = 0.0
    for first, end in zip(offsets[:-1], offsets[1:], strict=True):
        segments = np.diff(points[first:end], axis=0)
        area += np.linalg.norm(np.cross(segments, d), axis=1).sum() * width
    return area


@pytest.mark.parametrize("width", [0.01, 0.1, 1.0])  # at 128 texels: thinner than one to many wide
@pytest.mark.parametrize("map_size", [128, 256, 512, 1024])
def test_the_area_is_that_of_the_ribbons_at_every_map_size(needs_gl, width, map_size):
    points, offsets = tangle()
    total, _ = deposited(po.Strands(points, offsets, width=width, opacity=FAINT), map_size)
    assert total / FAINT == pytest.approx(ribbon_area(points, offsets, width), rel=1e-2)


def test_cutting_segments_in_two_changes_no_texel(needs_gl):
    points, offsets = tangle()
    count = len(offsets) - 1
    strands = points.reshape(count, -1, 3)
    middles = 0.5 * (strands[:, 1:] + strands[:, :-1])
    cut = np.empty((count, 2 * strands.shape[1] - 1, 3))
    cut[:, ::2], cut[:, 1::2] = strands, middles
    whole, _ = deposited(po.Strands(points, offsets, width=0.1, opacity=0.3), 256)
    parts, _ = deposited(
        po.Strands(
            cut.reshape(-1, 3).copy(), np.arange(count + 1) * cut.shape[1], width=0.1, opacity=0.3
        ),
        256,
    )
    assert parts == pytest.approx(whole, rel=1e-5)


def test_turning_the_scene_about_the_light_keeps_the_area(needs_gl):
    points, offsets = tangle()
    direction = (0.0, 0.0, -1.0)
    areas = []
    for degrees in (0, 17, 45, 71):
        a = np.radians(degrees)
        turn = np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])
        total, _ = deposited(
            po.Strands(np.ascontiguousarray(points @ turn.T), offsets, width=0.1, opacity=FAINT),
            256,
            direction,
        )
        areas.append(total)
    assert areas == pytest.approx([areas[0]] * 4, rel=1e-2)


@pytest.mark.parametrize("opacity", [1e-8, 1e-3, 0.1, 0.5, 0.9, 0.999999])
def test_the_map_holds_what_float64_says(needs_gl, opacity):
    """For strands thinner and wider than a texel; -log1p(-opacity c) f in float64."""
    points, offsets = tangle(seed=3, strands=6)
    for width in (0.02, 0.9):
        total, matrix = deposited(po.Strands(points, offsets, width=width, opacity=opacity), 64)
        n = len(points)
        lists = oracle.deposit(
            points, offsets, np.full(n, width), np.full(n, float(np.float32(opacity))), matrix, 64
        )
        expected = lists.total_optical_depth / oracle.texels_per_unit(matrix) ** 2
        assert total == pytest.approx(expected, rel=2e-4)


def test_an_opaque_thin_strand_is_translucent_in_the_map(needs_gl):
    """Opacity 1 over the fraction c of a texel lets 1 - c through."""
    points = np.array([[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [-1.0, 0.2, 0.0], [1.0, 0.2, 0.0]])
    scene = po.Scene()
    scene.add(po.Strands(points, np.array([0, 2, 4]), width=0.001, opacity=1.0))
    scene.add(po.DirectionalLight(direction=(0, 0, -1)))
    with po.Renderer(scene, size=(8, 8), technique="exact", map_size=16) as r:
        below = r.transmittance(np.array([[0.0, 0.0, -1.0]]))
    assert 0.9 < below[0] < 1.0


def test_a_strand_along_the_light_casts_nothing(needs_gl):
    points = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]])
    total, _ = deposited(
        po.Strands(points, np.array([0, 2]), width=0.1, opacity=0.5), 64, (0, 0, -1)
    )
    assert total == 0.0
