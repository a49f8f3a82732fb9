"""Boxes around what is in a scene."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt


class Bounds(NamedTuple):
    """An axis-aligned box: corners ``min`` and ``max``, (3,) float64; empty if min exceeds max."""

    min: npt.NDArray[np.float64]
    max: npt.NDArray[np.float64]

    @classmethod
    def of(cls, corners: tuple[Iterable[float], Iterable[float]]) -> Bounds:
        """The box between two corners."""
        low, high = corners
        return cls(np.array(list(low)), np.array(list(high)))

    @classmethod
    def union(cls, boxes: Iterable[Bounds]) -> Bounds:
        """The box around boxes; an empty one around none."""
        low, high = np.full(3, np.inf), np.full(3, -np.inf)
        for box in boxes:
            low, high = np.minimum(low, box.min), np.maximum(high, box.max)
        return cls(low, high)

    @property
    def empty(self) -> bool:
        """Whether it holds no point."""
        return not bool((self.min <= self.max).all())
