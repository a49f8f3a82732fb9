"""OpenGL against the CPU against numpy in float64, on random scenes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from pyopacity.light import DirectionalLight
from pyopacity.scene import Scene
from pyopacity.shapes import Mesh, Strands
from pyopacity.stress import oracle
from pyopacity.stress.bench import Bench
from pyopacity.stress.case import Finding, case
from pyopacity.stress.shapes import random_shapes, slanted, tangle
from pyopacity.stress.way import ALL, Device, Way, exact

F64 = npt.NDArray[np.float64]
OF_ORACLE = 1e-4
# A fragment at a receiver's biased depth, or on a texel's border, may count or not.
MOST = 0.99


def apart_from_oracle(bench: Bench, seed: int, device: Device) -> F64:
    """Of the exact lists of random strands under a random light: |T - brute force| a vertex."""
    random = np.random.default_rng(seed)
    points, offsets = tangle(seed, 8)
    width = random.uniform(0.02, 2.0, len(points)).astype(np.float32).astype(np.float64)
    opacity = random.uniform(0.0, 1.0, len(points)).astype(np.float32).astype(np.float64)
    x, y, z = random.normal(size=3)
    scene = Scene(Strands(points, offsets, width, opacity), DirectionalLight((x, y, z)))
    size = int(random.choice([8, 16, 40]))
    bias = float(random.uniform(0.0, 0.5))
    way = exact(device)
    T = bench.T(way, scene, points, size, bias=bias)
    matrix = bench.renderer(way, scene, size, bias=bias).light_from_world
    lists = oracle.deposit(points, offsets, width, opacity, matrix, size)
    places = oracle.light_points(matrix, points)
    right = oracle.transmittance(lists, places, bias / oracle.depth_range(matrix))
    return np.asarray(np.abs(T - right))


@case(
    "oracle",
    input="random strands, widths, opacities, lights, biases, maps of 8, 16, 40",
    right="T of a brute force over fragments in float64",
    tolerance=OF_ORACLE,
    of="T, at 99 % of the vertices",
    why_tolerance="T of a fragment changes by 1 a texel at most; coordinates below 40 texels are "
    "rounded by 2.4e-6 of one: some ten fragments, two coordinates each, 5e-5. At 99 %: at a "
    "biased depth, or on a texel's border, a fragment may count or not",
)
def brute_force(bench: Bench) -> Iterator[Finding]:
    """The deposit rule and the look-up in plain Python, which share no code with the engine."""
    for device in bench.devices:
        for seed in range(bench.seed, bench.seed + (20 if bench.is_thorough else 4)):
            off = float(np.quantile(apart_from_oracle(bench, seed, device), MOST))
            yield Finding(exact(device), off, f"off by {off:.3g}, seed {seed}")


@case(
    "devices",
    input="random strands, particles, metaballs, a volume; T at points and at strands",
    right="T on the CPU is T by OpenGL",
    tolerance=1e-4,
    of="T, at 99 % of the points",
    why_tolerance="as of the brute force, below 64 texels: 8e-5, at 99 %",
)
def both_devices(bench: Bench) -> Iterator[Finding]:
    """One convention in C++ and GLSL. Without surfaces, of which an edge through a texel's middle
    may cover it in one and not in the other.
    """
    casters = [shape for shape in random_shapes(bench.seed + 6) if not isinstance(shape, Mesh)]
    scene = Scene(casters, slanted())
    asked = bench.random(9).uniform(-3, 3, (1500, 3))
    for way in bench.ways(ALL, papers=True):
        if way.device == "cpu" or "cpu" not in bench.devices:
            continue
        other = Way("cpu", way.technique, way.parameters)
        for where in (asked, casters[0]):
            T, right = bench.T(way, scene, where), bench.T(other, scene, where)
            off = float(np.quantile(np.abs(T - right), MOST))
            yield Finding(way, off, f"off by {off:.3g}")
