"""deposit_rule="paper": a line one texel wide for every strand, and what that costs."""

import math

import numpy as np
import pytest

import pyopacity as po
from pyopacity.stress import oracle
from scenes import tangle

LIGHT = (0.5, 0.3, -0.8)


def total_optical_depth(rule: str, map_size: int, opacity: float = 0.3, width: float = 0.05):
    points, offsets = tangle(12, strands=50)
    strands = po.Strands(points, offsets, width=width, opacity=opacity)
    scene = po.Scene(strands, po.DirectionalLight(LIGHT))
    technique = po.technique("bounding_opacity_maps", layers=4, split="linear", deposit_rule=rule)
    with po.Renderer(scene, technique=technique, map_size=map_size, device="cpu") as renderer:
        renderer.transmittance(np.zeros((1, 3)))
        behind_all = renderer.read("bounding_opacity_maps/opacity")[0, ..., 3]
        return float(behind_all.sum()), renderer.light_from_world, points, offsets


@pytest.mark.parametrize("map_size", [32, 100, 333])
def test_a_fragment_in_each_column_that_a_segment_passes(map_size: int) -> None:
    opacity = 0.4
    got, matrix, points, offsets = total_optical_depth("paper", map_size, opacity)
    p = oracle.light_points(matrix, points)
    inside = ((p[:, :2] > 0) & (p[:, :2] < map_size)).all()
    assert inside
    columns = 0
    for first, end in zip(offsets[:-1], offsets[1:], strict=True):
        for a, b in zip(p[first : end - 1], p[first + 1 : end], strict=True):
            major = 1 if abs(b[1] - a[1]) > abs(b[0] - a[0]) else 0
            low, high = sorted((a[major], b[major]))
            columns += math.ceil(high - 0.5) - math.ceil(low - 0.5)
    assert got == pytest.approx(-columns * math.log1p(-opacity), rel=2e-3)


def test_it_depends_on_the_maps_size_where_areas_do_not() -> None:
    """Shadow per area of the map: the papers' doubles with every doubling of the texel."""
    sizes = (64, 128, 256, 512)

    def per_area(rule: str) -> list[float]:
        found = []
        for size in sizes:
            total, matrix, *_ = total_optical_depth(rule, size, opacity=0.01)
            found.append(total / oracle.texels_per_unit(matrix) ** 2)
        return found

    area, paper = per_area("area"), per_area("paper")
    assert max(area) / min(area) < 1.03
    for coarse, fine in zip(paper[:-1], paper[1:], strict=True):
        assert coarse / fine == pytest.approx(2.0, rel=0.05)


def test_width_means_nothing_to_it() -> None:
    thin, *_ = total_optical_depth("paper", 100, width=0.02)
    wide, *_ = total_optical_depth("paper", 100, width=0.04)
    assert thin == pytest.approx(wide, rel=2e-2)  # the map's box grows with the width


def test_both_rules_leave_surfaces_alone() -> None:
    corners = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    sheet = po.Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]), opacity=0.5)
    scene = po.Scene(sheet, po.DirectionalLight((0, 0, -1)))
    behind = np.array([[0.1, 0.2, -1.0]])
    for rule in ("area", "paper"):
        technique = po.technique("exact", deposit_rule=rule)
        assert po.transmittance(scene, behind, technique, 64) == pytest.approx(0.5, abs=1e-6)
