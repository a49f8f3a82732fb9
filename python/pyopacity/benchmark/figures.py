"""What rows come to: which are on the Pareto front, and how fast a cost grows."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def front(costs: Sequence[float], errors: Sequence[float]) -> list[bool]:
    """Which points no other beats: none costs as little and errs as little, one of them less.

    Args:
        costs, errors: of each point, finite.
    """
    points = list(zip(costs, errors, strict=True))
    return [
        not any(c <= cost and e <= error and (c, e) != (cost, error) for c, e in points)
        for cost, error in points
    ]


def exponent(sizes: Sequence[float], costs: Sequence[float]) -> float:
    """p of cost = c size^p, by least squares of the logarithms, in float64.

    Args:
        sizes: at least two, above 0, not all alike.
        costs: above 0.
    """
    x = np.log(np.asarray(sizes, np.float64))
    y = np.log(np.asarray(costs, np.float64))
    x = x - x.mean()
    return float((x * (y - y.mean())).sum() / (x * x).sum())
