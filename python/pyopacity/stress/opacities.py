"""Opacities at the ends of their range, and beyond them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
import numpy.typing as npt

from pyopacity.errors import ParameterError
from pyopacity.renderer import Renderer
from pyopacity.scene import Scene
from pyopacity.shapes import Mesh, Particles, Strands, Volume
from pyopacity.stress.bench import Bench
from pyopacity.stress.case import Finding, apart, case, refusal, relative, wrong
from pyopacity.stress.shapes import column, down, hair, random_shapes, ribbons, sheet
from pyopacity.stress.way import ALL, Way

LARGEST = 1.0 - 2.0**-24
OPACITIES = (0.0, 2.0**-24, *(10.0**-k for k in range(8, 1, -1)), 0.5, LARGEST, 1.0)
# Where techniques keep the optical depth of all of a texel's casters: of which texture, and which
# of its values. Lists have no such place.
_TOTALS = (("opacity", -1), ("coefficients", 0), ("moments", 0))


def _optical_depth(renderer: Renderer, technique: str) -> float | None:
    """That of all casters in the middle of the map, if the technique keeps it anywhere."""
    kept = {resource.name for resource in renderer.memory()}
    for texture, place in _TOTALS:
        if f"{technique}/{texture}" in kept:
            values = renderer.read(f"{technique}/{texture}")
            middle = values.reshape(-1, *values.shape[-3:])[:, 20, 20]
            return float(middle.ravel()[place])
    return None


def _is_fixed(way: Way) -> bool:
    return way.given("deposit") == "scatter"


LENGTH = 0.125  # of a voxel


def _covers() -> dict[str, Mesh | Strands | Volume]:
    """What covers the middle of the map with whole texels of one fragment."""
    smoke = Volume(np.ones((1, 1, 1)), (0, 0, 0), (2, 2, LENGTH))
    return {"surface": sheet(), "strand": ribbons(1, 0.5), "voxel": smoke}


def _set_opacity(shape: Mesh | Strands | Volume, opacity: float) -> None:
    if isinstance(shape, Volume):
        tau = -np.log1p(-min(opacity, LARGEST))
        shape.extinction = np.full((1, 1, 1), tau / LENGTH)
    else:
        shape.opacity = opacity


Asked = tuple[Way, str, float, npt.NDArray[np.float64], float | None]


def _edges(bench: Bench, ways: list[Way]) -> Iterator[Asked]:
    """(way, kind of caster, opacity, T before and behind, optical depth in the map)."""
    points = column([1.0, -1.0])
    for kind, shape in _covers().items():
        scene = Scene(shape, down())
        for way in ways:
            renderer = bench.renderer(way, scene, layers=4, interpolation="linear")
            for opacity in OPACITIES:
                _set_opacity(shape, opacity)
                T = renderer.transmittance(points).astype(np.float64)
                yield way, kind, opacity, T, _optical_depth(renderer, way.technique)


def _held(bench: Bench, is_fixed: bool) -> Iterator[tuple[Way, str, float, float]]:
    """(way, what and how opaque, optical depth in the map, the right one)."""
    chosen = [way for way in bench.ways() if _is_fixed(way) == is_fixed]
    for way, kind, opacity, _, held in _edges(bench, chosen):
        if held is not None and 0.0 < opacity < 1.0:
            right = -float(np.log1p(-float(np.float32(opacity))))
            yield way, f"{kind}, {opacity:g}", held, right


@case(
    "opacity edge",
    input="opacity 2^-24, 1e-8 .. 1e-2, .5, 1 - 2^-24 of a surface, a strand, a voxel",
    right="-log1p(-opacity) in the map",
    tolerance=1e-6,
    of="optical depth, relative",
)
def edges_in_float(bench: Bench) -> Iterator[Finding]:
    """The definition of optical depth, of the opacity that float32 keeps, by numpy in float64.

    A surface covers texels whole, a ribbon as wide as long too, and a voxel of extinction tau / d
    and depth d has the same tau. Sums of floats keep the digits of a single fragment.
    """
    for way, what, held, right in _held(bench, is_fixed=False):
        found = relative(way, held, right)
        yield Finding(way, found.error, f"{what}: {held:.9g}, {right:.9g}")


@case(
    "opacity edge",
    input="the same, scattered in fixed point",
    right="-log1p(-opacity), rounded to the stated step",
    tolerance=1.0,
    of="optical depth, in steps",
)
def edges_in_fixed_point(bench: Bench) -> Iterator[Finding]:
    """A deposit is rounded to a step: a power of two, 2^-32 to 2^-31 of twice the optical depth of
    all casters, at most of 128. Of a voxel that is counted as if it were opaque. What float32 keeps
    of the sum, 2^-24 of it, comes on top.
    """
    casters = {"surface": 2.0, "strand": 1.0, "voxel": np.inf}
    for way, what, held, right in _held(bench, is_fixed=True):
        count = casters[what.partition(",")[0]]
        step = 2.0**-31 * min(2.0 * count * right, 128.0) + 2.0**-24 * right
        yield Finding(way, abs(held - right) / step, f"{what}: {held:.9g}, {right:.9g}")


@case(
    "opacity edge",
    input="T behind opacity 0 .. 1 of a surface, a strand, a voxel; before it",
    right="1 - opacity, 0 behind an opaque surface; 1",
    tolerance=1e-6,
)
def edges_of_T(bench: Bench) -> Iterator[Finding]:
    """exp(log1p(-o)) = 1 - o. Opacity 1 of a surface is opaque, of others it is 1 - 2^-24."""
    for way, kind, opacity, T, _ in _edges(bench, bench.ways()):
        found = apart(way, T, [1.0, 1.0 - float(np.float32(opacity))])
        yield Finding(way, found.error, f"{kind}, {opacity:g}: {found.got}")


BAD = {"-.1": -0.1, "1.5": 1.5, "NaN": np.nan, "Inf": np.inf, "-Inf": -np.inf}


def _refused_of(shape: Strands | Mesh | Particles) -> Iterator[str]:
    count = len(shape.points)
    for name, bad in BAD.items():
        values = np.full(count, 0.5)
        values[count - 2] = bad
        colors = np.full((count, 3), 0.5)
        colors[count - 2, 1] = bad
        index = f"opacity[{count - 2}]"
        for words, given in ((index, values), (index, colors), ("opacity", bad)):
            set_it = partial(setattr, shape, "opacity", given)
            yield from (f"{shape!r}, {name}: {p}" for p in refusal(set_it, words, ParameterError))


@case(
    "opacity bad",
    input="opacity -.1, 1.5, NaN, Inf, -Inf: one for all, one of an array, one colour of one",
    right="a ParameterError that names the index; T as before, bit for bit",
    tolerance=0,
    of="wrong answers",
)
def bad_opacities(bench: Bench) -> Iterator[Finding]:
    """What is no part of the light is refused before any map sees it."""
    shapes = [s for s in random_shapes(bench.seed) if isinstance(s, Strands | Mesh | Particles)]
    scene = Scene(shapes, down())
    points = bench.random(1).uniform(-2, 2, (200, 3))
    for way in bench.ways(ALL, papers=True):
        before = bench.T(way, scene, points)
        problems = [p for shape in shapes for p in _refused_of(shape)]
        renderer = bench.renderer(way, scene)
        renderer.invalidate()
        after = bench.T(way, scene, points)
        if not np.array_equal(before, after) or not np.isfinite(after).all():
            problems.append("T is another")
        yield wrong(way, problems)


@case(
    "opacity bad",
    input="extinction -.1, NaN, Inf in a voxel; alpha of a map; width, radius",
    right="a ParameterError",
    tolerance=0,
    of="wrong answers",
)
def bad_attributes(bench: Bench) -> Iterator[Finding]:
    """Whatever else becomes optical depth is checked alike."""
    problems = []
    leaf = Mesh(np.eye(3), np.array([[0, 1, 2]]), uvs=np.zeros((3, 2)))
    for bad in (-0.1, np.nan, np.inf, -np.inf):
        voxels = np.ones((2, 3, 4))
        voxels[1, 2, 3] = bad
        strands = hair()
        width = np.full(len(strands.points), 0.1)
        width[5] = bad
        alpha = np.full((2, 3), 0.5, np.float32)
        alpha[1, 1] = bad
        tries: dict[str, Callable[[], object]] = {
            "extinction[23]": partial(Volume, voxels),
            "width[5]": partial(setattr, strands, "width", width),
            "alpha_map[4]": partial(setattr, leaf, "alpha_map", alpha),
            "radius[1]": partial(Particles, np.zeros((2, 3)), np.array([0.1, bad])),
        }
        for words, call in tries.items():
            problems += [f"{bad}: {p}" for p in refusal(call, words, ParameterError)]
    yield wrong(None, problems)
