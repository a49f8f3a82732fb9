"""An independent float64 deposit and look-up, fragment by fragment in plain Python.

It shares no code with the engine: docs/accuracy.md is all that both follow.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]


@dataclass
class Fragment:
    """What one segment leaves in one texel."""

    depth: float
    optical_depth: float
    column_part: float  # f of the deposit rule


@dataclass
class TexelLists:
    """Every fragment of every texel of a map of ``size`` x ``size``."""

    size: int
    fragments: dict[tuple[int, int], list[Fragment]]

    @property
    def total_optical_depth(self) -> float:
        return sum(f.optical_depth for texel in self.fragments.values() for f in texel)

    def covered_texels(self) -> float:
        """The area deposited: sum of f (1 - exp(-tau / f)), in texels."""
        return sum(
            f.column_part * -math.expm1(-f.optical_depth / f.column_part)
            for texel in self.fragments.values()
            for f in texel
        )


def light_points(light_from_world: Array, points: Array) -> Array:
    """World points in the light's map: x and y in texels, z in 0 .. 1."""
    return points @ light_from_world[:3, :3].T + light_from_world[:3, 3]


def texels_per_unit(light_from_world: Array) -> float:
    return float(np.linalg.norm(light_from_world[0, :3]))


def depth_range(light_from_world: Array) -> float:
    return 1.0 / float(np.linalg.norm(light_from_world[2, :3]))


def deposit(
    points: Array,
    offsets: npt.NDArray[np.integer],
    width: Array,
    opacity: Array,
    light_from_world: Array,
    size: int,
) -> TexelLists:
    """Ribbons of exact area, one column of the major axis after the other."""
    p = light_points(light_from_world, points)
    width_texels = width * texels_per_unit(light_from_world)
    lists: dict[tuple[int, int], list[Fragment]] = defaultdict(list)
    for first, end in zip(offsets[:-1], offsets[1:], strict=True):
        for i in range(first, end - 1):
            for texel, fragment in _segment(p, width_texels, opacity, i):
                if all(0 <= t < size for t in texel) and fragment.depth <= 1.0:
                    lists[texel].append(fragment)
    return TexelLists(size, dict(lists))


def _segment(
    p: Array, width: Array, opacity: Array, i: int
) -> Iterator[tuple[tuple[int, int], Fragment]]:
    dx, dy = (p[i + 1] - p[i])[:2]
    major = 1 if abs(dy) > abs(dx) else 0
    minor = 1 - major
    a, b = p[i], p[i + 1]
    run = b[major] - a[major]
    if run == 0.0:
        return
    slope = (b[minor] - a[minor]) / run
    low, high = sorted((a[major], b[major]))
    for column in range(math.floor(low), math.ceil(high)):
        part = min(high, column + 1) - max(low, column)
        if part <= 0.0:
            continue
        center = column + 0.5
        along = min(max((center - a[major]) / run, 0.0), 1.0)
        half = 0.5 * (width[i] + along * (width[i + 1] - width[i])) * math.hypot(1.0, slope)
        middle = a[minor] + slope * (center - a[major])
        o = min(opacity[i] + along * (opacity[i + 1] - opacity[i]), 1.0 - 2.0**-24)
        depth = a[2] + along * (b[2] - a[2])
        for row in range(math.floor(middle - half), math.ceil(middle + half)):
            cover = min(middle + half, row + 1) - max(middle - half, row)
            cover = min(max(cover, 0.0), 1.0)
            if cover > 0.0:
                texel = (column, row) if major == 0 else (row, column)
                yield texel, Fragment(max(depth, 0.0), part * -math.log1p(-o * cover), part)


def transmittance(lists: TexelLists, points_ls: Array, bias: float) -> Array:
    """The mean over the four nearest texels of T in front of the biased depth."""
    result = np.ones(len(points_ls))
    for n, (x, y, z) in enumerate(points_ls):
        left, low = math.floor(x - 0.5), math.floor(y - 0.5)
        wx, wy = x - 0.5 - left, y - 0.5 - low
        total = 0.0
        for column, row, weight in (
            (left, low, (1 - wx) * (1 - wy)),
            (left + 1, low, wx * (1 - wy)),
            (left, low + 1, (1 - wx) * wy),
            (left + 1, low + 1, wx * wy),
        ):
            front = lists.fragments.get((column, row), ())
            omega = sum(f.optical_depth for f in front if f.depth < z - bias)
            total += weight * math.exp(-omega)
        result[n] = total
    return result
