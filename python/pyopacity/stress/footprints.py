"""Filters at silhouettes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from pyopacity.scene import Scene
from pyopacity.shapes import Mesh, Strands
from pyopacity.stress.bench import Bench
from pyopacity.stress.case import Finding, apart, case
from pyopacity.stress.grid import Grid

TEXELS = 16
RADIUS = 1.5  # texels: 3 x 3


def _means(
    bench: Bench, scene: Scene, points: npt.NDArray[np.float64], right: npt.ArrayLike
) -> Iterator[Finding]:
    for way in bench.ways():
        T = bench.T(way, scene, points, TEXELS, filter="box", filter_radius=RADIUS)
        yield apart(way, T, right)


@case(
    "silhouette",
    input="a ribbon, .5 and 1 opaque, over half of a row of texels; the mean over 3 x 3",
    right="(1 + 1 + 1 - opacity / 2) / 3",
    tolerance=1e-3,
)
def half_covered_row(bench: Bench) -> Iterator[Finding]:
    """A texel that is half covered lets 1 - o / 2 through; T is filtered, not optical depth."""
    grid = Grid(bench, TEXELS)
    ends = grid.world([(3.0, 7.25, 0.1), (13.0, 7.25, 0.1)])
    points = grid.world([(8.5, 7.5, 1.5), (5.5, 8.5, 1.5), (8.5, 9.5, 1.5)])
    for opacity in (0.5, 1.0):
        strand = Strands(ends, np.array([0, 2]), width=0.5 * grid.texel, opacity=opacity)
        scene = grid.scene(strand)
        mean = 1.0 - 0.5 * opacity / 3.0
        yield from _means(bench, scene, points, [mean, mean, 1.0])


@case(
    "silhouette",
    input="the edge of a surface, opacity .7; the mean over 3 x 3, on the edge and beside it",
    right="1 - .7 x the part of the 3 x 3 that is covered",
    tolerance=1e-3,
)
def edge_of_a_surface(bench: Bench) -> Iterator[Finding]:
    """Texels are covered or not; of the three columns around a place 0 .. 3 are."""
    grid = Grid(bench, TEXELS)
    corners = grid.world([(x, y, 0.1) for x, y in ((2, 2), (8, 2), (8, 14), (2, 14))])
    half_plane = Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]), opacity=0.7)
    scene = grid.scene(half_plane)
    columns = np.array([4.5, 6.5, 7.5, 8.5, 9.5, 12.5])
    points = grid.world([(x, 8.5, 1.5) for x in columns])
    covered = np.clip((8.0 - columns) / 3.0 + 0.5, 0.0, 1.0)
    yield from _means(bench, scene, points, 1.0 - 0.7 * covered)
