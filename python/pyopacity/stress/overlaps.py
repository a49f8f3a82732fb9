"""Many fragments in a texel, or in one depth, or none at all."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import numpy.typing as npt

from pyopacity.scene import Scene
from pyopacity.shapes import Shape, Strands
from pyopacity.stress.bench import Bench
from pyopacity.stress.case import Finding, apart, case, wrong
from pyopacity.stress.grid import Grid
from pyopacity.stress.shapes import (
    ASIDE,
    column,
    down,
    opacity_of,
    random_shapes,
    ribbons,
    sheet,
    stack,
)
from pyopacity.stress.way import ALL, CASTING, Way
from pyopacity.technique import EXACT

F64 = npt.NDArray[np.float64]

TOTAL = 2.0  # optical depth of all fragments of a texel
BIAS = 1e-4  # as much as the automatic one of a scene of radius 1: a place has rounded digits
STEP = 0.1  # optical depth of one of several surfaces


def _overlaps(bench: Bench, count: int, ways: list[Way] | None = None) -> Iterator[Finding]:
    """Squares as strands, all over one texel and no other."""
    grid = Grid(bench, 8)
    opacity = opacity_of(TOTAL / count)
    depths = np.linspace(0.1 * grid.last, 0.9 * grid.last, count)
    places = np.stack([np.full(count, 3.0), np.full(count, 3.5), depths], axis=1)
    ends = np.stack([grid.world(places), grid.world(places + (1.0, 0.0, 0.0))], axis=1)
    offsets = 2 * np.arange(count + 1)
    width = float(np.float32(grid.texel))
    scene = grid.scene(Strands(ends.reshape(-1, 3), offsets, width=width, opacity=opacity))
    behind = grid.world((3.5, 3.5, 1.5))
    right = -count * float(np.log1p(-float(np.float32(opacity))))
    for way in [*bench.ways(), *bench.accumulators()] if ways is None else ways:
        T = bench.T(way, scene, behind, grid.size, filter="none")
        omega = float(-np.log(max(T[0], 1e-30)))
        yield Finding(way, abs(omega - right) / right, f"{omega:.7g}, {right:.7g}")
    bench.clear()


@case(
    "accumulate",
    input="1e3 and 1e4 fragments in a texel, of optical depth 2 together",
    right="N tau",
    tolerance=2e-4,
    of="optical depth, relative",
)
def ten_thousand_fragments(bench: Bench) -> Iterator[Finding]:
    """Optical depth is additive: N fragments of -log1p(-o) are N times that."""
    for count in (1000, 10_000):
        yield from _overlaps(bench, count)


@case(
    "accumulate",
    input="1e5 fragments in a texel",
    right="N tau",
    tolerance=1e-3,
    of="optical depth, relative",
)
def a_hundred_thousand_fragments(bench: Bench) -> Iterator[Finding]:
    """As with fewer; float32 sums, each rounded by 2^-24 of the sum, drift by sqrt(N) of that."""
    yield from _overlaps(bench, 100_000)


@case(
    "accumulate",
    input="1e6 fragments in a texel",
    right="N tau",
    tolerance=2e-2,
    of="optical depth, relative",
    is_slow=True,
)
def a_million_fragments(bench: Bench) -> Iterator[Finding]:
    """As with fewer; a fragment is 2e-6, eight units in the last place of the sum. Without the time
    for more, of lists and of the first technique.
    """
    few = [way for name in (ALL[0], EXACT) for way in bench.ways([name])]
    yield from _overlaps(bench, 1_000_000, None if bench.is_thorough else few)


def _thin(bench: Bench, kind: Callable[[float], Shape]) -> Iterator[Finding]:
    points = column([1.0, 0.0, -1.0, -100.0])
    for tau in (0.1, 0.7, 2.3, 10.0):
        opacity = opacity_of(tau)
        right = [1.0, 1.0, *[1.0 - float(np.float32(opacity))] * 2]
        scene = Scene(kind(opacity), down())
        for way in bench.ways():
            yield apart(way, bench.T(way, scene, points), right)


@case(
    "thin object",
    input="a surface across the light, tau .1, .7, 2.3, 10: z0 = z1",
    right="1 before and on it, exp(-tau) behind",
    tolerance=1e-6,
)
def thin_surface(bench: Bench) -> Iterator[Finding]:
    """Both bounds of a texel coincide, where the papers divide by their distance."""
    yield from _thin(bench, lambda opacity: sheet(0.0, opacity))


@case(
    "thin object",
    input="the same of a ribbon",
    right="1 before and on it, exp(-tau) behind",
    tolerance=1e-6,
)
def thin_ribbon(bench: Bench) -> Iterator[Finding]:
    """As of a surface; the map has room for the ribbon's width, whichever way it lies."""
    yield from _thin(bench, lambda opacity: ribbons(1, opacity))


def _on_planes(bench: Bench, count: int) -> Iterator[tuple[Scene, F64, int]]:
    """(scene, heights of its surfaces, map): between bounds of a texel; in slices of the map."""
    opacity = opacity_of(STEP)
    heights = -np.linspace(0.0, 1.0, count + 1)
    yield Scene(stack(heights, opacity), down()), heights, 16
    grid = Grid(bench, 16)
    depths = np.arange(1, count) / count
    depths = depths[depths < grid.last]
    if len(depths):
        inside = grid.world([(8.0, 8.0, depth) for depth in depths])[:, 2]
        yield grid.scene(stack(inside, opacity)), inside, 16


def _asked(bench: Bench) -> Iterator[tuple[Way, F64, int, int]]:
    """(way, T on each surface and far below all, how many surfaces, layers)."""
    for count in (1, 2, 4, 8, 16, 32, 64):
        for scene, heights, size in _on_planes(bench, count):
            points = column([*heights, -99.0])
            for way in bench.ways():
                T = bench.T(way, scene, points, size, layers=count, split="linear", bias=BIAS)
                yield way, T, len(heights), count


@case(
    "boundary",
    input="surfaces on the planes of K = 1 .. 64 layers of a texel, and of K slices",
    right="each counted once behind all of them",
    tolerance=0,
    of="surfaces",
)
def on_the_planes(bench: Bench) -> Iterator[Finding]:
    """Omega / tau is a whole number of surfaces. K is a power of two, whose planes are floats."""
    for way, T, surfaces, _ in _asked(bench):
        yield apart(way, np.round(-np.log(T[-1]) / STEP), surfaces)


@case(
    "boundary",
    input="the same, asked on every surface, bias 1e-4",
    right="exp(-k tau) on surface k: itself does not count",
    tolerance=1e-6,
    why_tolerance="T, not a count: k terms of .1 round by k (k .1) 2^-24 together, T = exp(-.1 k) "
    "by 3e-7 of that at most, at k = 20",
)
def receivers_on_the_planes(bench: Bench) -> Iterator[Finding]:
    """The strict < of the definition, written and read by one convention, after the least bias:
    a surface's depth and that of a point on it differ in the last digit.
    """
    for way, T, surfaces, layers in _asked(bench):
        found = apart(way, T[:-1], np.exp(-STEP * np.arange(surfaces)))
        yield Finding(way, found.error, f"{found.got} with {layers} layers")


def _passes(bench: Bench, way: Way, scene: Scene) -> list[str]:
    """Of the technique's own, those that ran."""
    report = bench.renderer(way, scene).report
    return [row.name for row in report if way.technique in row.name and row.status == "ran"]


@case(
    "empty",
    input="no shape; no light; casters that do not cast; opacity 0",
    right="T = 1, and no pass of the technique runs",
    tolerance=0,
    of="wrong answers",
)
def nothing_casts(bench: Bench) -> Iterator[Finding]:
    """exp(0) = 1, and nothing is to be drawn for it."""
    invisible = random_shapes(bench.seed)
    for shape in invisible:
        shape.casts = False
    clear = [sheet(0.0, 0.0), ribbons(5, 0.0)]
    scenes = [
        Scene(),
        Scene(down()),
        Scene(random_shapes(bench.seed)),
        Scene(invisible, down()),
        Scene(clear, down()),
    ]
    asked = bench.random(1).uniform(-2, 2, (50, 3))
    for scene in scenes:
        for way in bench.ways(ALL):
            T = bench.T(way, scene, asked)
            problems = [] if (T == 1.0).all() else [f"T is {T.min()}"]
            yield wrong(way, problems + [f"{name} ran" for name in _passes(bench, way, scene)])


@case(
    "all opaque",
    input="an opaque surface over a part of the map, and nothing else",
    right="0 behind it, 1 before and beside it",
    tolerance=0,
)
def all_is_opaque(bench: Bench) -> Iterator[Finding]:
    """An opaque surface is no optical depth: it lies in the opaque depth map."""
    scene = Scene(sheet(0.0, 1.0), sheet(-1.0, 1.0, half=0.1, x=3.0), down())
    points = np.array([[*ASIDE, 1.0], [*ASIDE, -0.5], [*ASIDE, -9.0], [2.0, 0.3, -5.0]])
    for way in bench.ways(CASTING):
        yield apart(way, bench.T(way, scene, points), [1.0, 0.0, 0.0, 1.0])


@case(
    "one layer",
    input="surfaces of tau .1 a millionth apart, another far behind: all of them in one layer",
    right="exp(-Omega) behind them, 1 before",
    tolerance=1e-6,
    why_tolerance="13 terms round by 2^-24 of a sum of 1.2, 9e-7 at most",
)
def all_in_one_layer(bench: Bench) -> Iterator[Finding]:
    """What a layer holds is all counted behind it, wherever in the layer it lies."""
    tau, count = 0.1, 12
    faint = 1e-3
    heights = -1e-6 * np.arange(count)
    for pair in (stack(heights, opacity_of(tau)), ribbons(count, opacity_of(tau), depth=1e-5)):
        scene = Scene(pair, sheet(-1.0, opacity_of(faint)), down())
        for way in bench.ways():
            T = bench.T(way, scene, column([0.5, -2.0]))
            yield apart(way, T, [1.0, np.exp(-tau * count - faint)])


@case(
    "one fragment",
    input="one ribbon over half of one texel, opacity .3 and 1",
    right="1 - opacity / 2 behind it, 1 in the texel beside it",
    tolerance=1e-6,
    why_tolerance="exp and log1p of float32, 6e-8 each",
)
def one_fragment(bench: Bench) -> Iterator[Finding]:
    """The deposit rule: over the fraction c of a texel opacity o lets 1 - o c through."""
    grid = Grid(bench, 16)
    ends = grid.world([(7.0, 7.25, 0.1), (8.0, 7.25, 0.1)])
    points = grid.world([(7.5, 7.5, 1.5), (8.5, 7.5, 1.5), (7.5, 8.5, 1.5)])
    for opacity in (0.3, 1.0):
        strand = Strands(ends, np.array([0, 2]), width=0.5 * grid.texel, opacity=opacity)
        scene = grid.scene(strand)
        for way in bench.ways():
            T = bench.T(way, scene, points, grid.size, filter="none")
            yield apart(way, T, [1.0 - 0.5 * opacity, 1.0, 1.0])
