"""T at every vertex of strands by numpy: each ray against each segment, in float64.

It shares no code with the engine: the rule is that of docs/accuracy.md, "Truth by rays".
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from pyopacity.shapes import Strands

F64 = npt.NDArray[np.float64]
# An opacity of 1 stays a number.
_MOST_OPACITY = 1.0 - 2.0**-24


class Segments:
    """Those of all strands, seen along the light.

    Args:
        strands: without a transform.
        toward: (3,) unit vector to the light.
    """

    def __init__(self, strands: Strands, toward: F64) -> None:
        points = np.asarray(strands.points, np.float64)
        half = np.broadcast_to(np.asarray(strands.width, np.float64) / 2.0, len(points))
        opacity = np.broadcast_to(np.asarray(strands.opacity, np.float64), len(points))
        self._across_of_point = _plane(toward)
        self._toward = toward
        starts = np.ones(len(points), bool)
        starts[np.asarray(strands.offsets[1:]) - 1] = False  # of each strand all but the last
        first = np.flatnonzero(starts)
        flat, depth = self._project(points)
        self._start, self._depth, self._half = flat[first], depth[first], half[first]
        self._axis = flat[first + 1] - flat[first]
        self._rise = depth[first + 1] - depth[first]
        self._half_rise = half[first + 1] - half[first]
        self._opacity, self._opacity_rise = opacity[first], opacity[first + 1] - opacity[first]
        self._squared = np.maximum((self._axis**2).sum(axis=1), np.finfo(np.float64).tiny)
        self._is_last = np.append(np.diff(first) > 1, True)

    def transmittance(self, points: F64, bias: float) -> F64:
        """(N,) in [0, 1]: the product over what lies farther than the bias before the light.

        Args:
            points: (N, 3) world units.
            bias: world units.
        """
        T = np.ones(len(points))
        for i, (place, depth) in enumerate(zip(*self._project(points), strict=True)):
            distance, opacity = self._crossed(place)
            T[i] = np.prod(1.0 - np.minimum(opacity[distance - depth > bias], _MOST_OPACITY))
        return T

    def _project(self, points: F64) -> tuple[F64, F64]:
        """Across the light, and along it."""
        return points @ self._across_of_point, points @ self._toward

    def _crossed(self, place: F64) -> tuple[F64, F64]:
        """(depth, opacity) of every stretch that this ray crosses, at its nearest place."""
        apart = place - self._start
        foot = (apart * self._axis).sum(axis=1) / self._squared
        t = np.clip(foot, 0.0, 1.0)
        distance = np.linalg.norm(apart - t[:, None] * self._axis, axis=1)
        inside = distance <= self._half + t * self._half_rise
        at_end = np.linalg.norm(apart - self._axis, axis=1) <= self._half + self._half_rise
        # A stretch goes on over a joint within half a width of the ray.
        goes_on = inside & at_end & np.append(inside[1:], False) & ~self._is_last
        stretch = np.cumsum(np.append(0, ~goes_on[:-1]))
        passed = goes_on & (foot >= 1.0) & np.append(foot[1:] <= 0.0, False)
        hits = np.flatnonzero((inside & (foot > 0.0) & (foot < 1.0)) | passed)
        ordered = hits[np.lexsort((distance[hits], stretch[hits]))]
        nearest = ordered[np.append(True, np.diff(stretch[ordered]) > 0)[: len(ordered)]]
        along = t[nearest]
        depth = self._depth[nearest] + along * self._rise[nearest]
        return depth, self._opacity[nearest] + along * self._opacity_rise[nearest]


def _plane(toward: F64) -> F64:
    """(3, 2): two axes across a direction."""
    x = np.cross(toward, np.eye(3)[np.argmin(np.abs(toward))])
    x /= np.linalg.norm(x)
    return np.stack([x, np.cross(toward, x)], axis=1)
