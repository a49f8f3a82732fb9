"""Error over time, as SVG in a page: it needs no package, scales, and takes the page's colours."""

from __future__ import annotations

import html
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

# Of a colour-blind safe set (Okabe and Ito 2008), readable on light and dark.
_COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6d31", "#7f7f7f")
_WIDTH, _HEIGHT = 360, 260
_LEFT, _RIGHT, _TOP, _BOTTOM = 52, 16, 30, 40


@dataclass(frozen=True, slots=True)
class Point:
    """A row of the table: its number there, and what a pointer over it tells."""

    number: int
    label: str
    color: str
    seconds: float
    error: float


def color_of(index: int) -> str:
    """Of the technique with this index."""
    return _COLORS[index % len(_COLORS)]


def error_over_time(title: str, points: Sequence[Point]) -> str:
    """Seconds across, logarithmic; the error upward, from 0."""
    low, high = _decades(point.seconds for point in points)
    step = _step(max(point.error for point in points))
    top = step * max(1, math.ceil(max(point.error for point in points) / step))

    def x_of(seconds: float) -> float:
        part = (math.log10(seconds) - low) / (high - low)
        return _LEFT + part * (_WIDTH - _LEFT - _RIGHT)

    def y_of(error: float) -> float:
        return _HEIGHT - _BOTTOM - error / top * (_HEIGHT - _TOP - _BOTTOM)

    parts = [f'<text x="{_WIDTH / 2}" y="16" class="title">{html.escape(title)}</text>']
    for exponent in range(low, high + 1):
        parts.append(_grid(x_of(10.0**exponent), None, f"{10.0**exponent:g} s"))
    for tick in range(round(top / step) + 1):
        parts.append(_grid(None, y_of(tick * step), f"{tick * step:.4g}"))
    parts += [_dot(x_of(p.seconds), y_of(p.error), p) for p in points]
    return (
        f'<svg viewBox="0 0 {_WIDTH} {_HEIGHT}" role="img" '
        f'aria-label="{html.escape(title)} over seconds a frame">{"".join(parts)}</svg>'
    )


def _decades(values: Iterable[float]) -> tuple[int, int]:
    """Powers of ten around values above 0, at least one apart."""
    logarithms = [math.log10(value) for value in values]
    low, high = math.floor(min(logarithms)), math.ceil(max(logarithms))
    return low, max(high, low + 1)


def _step(largest: float) -> float:
    """Between ticks: 1, 2 or 5 times a power of ten, some four of them up to the largest."""
    if not largest > 0.0:
        return 1.0
    power = 10.0 ** math.floor(math.log10(largest / 4.0))
    return next(factor * power for factor in (1, 2, 5, 10) if factor * power >= largest / 4.0)


def _grid(x: float | None, y: float | None, label: str) -> str:
    if x is not None:
        line = f'x1="{x:.1f}" x2="{x:.1f}" y1="{_TOP}" y2="{_HEIGHT - _BOTTOM}"'
        place = f'x="{x:.1f}" y="{_HEIGHT - _BOTTOM + 16}" text-anchor="middle"'
    else:
        line = f'x1="{_LEFT}" x2="{_WIDTH - _RIGHT}" y1="{y:.1f}" y2="{y:.1f}"'
        place = f'x="{_LEFT - 6}" y="{y:.1f}" dy="4" text-anchor="end"'
    return f'<line {line} class="grid"/><text {place}>{label}</text>'


def _dot(x: float, y: float, point: Point) -> str:
    label = html.escape(f"{point.label}: {point.error:.4f}, {point.seconds:.3g} s")
    return (
        f'<g><title>{label}</title><circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="{point.color}"/>'
        f'<text x="{x + 8:.1f}" y="{y - 4:.1f}">{point.number}</text></g>'
    )
