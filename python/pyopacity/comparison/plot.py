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
_LEAST_ERROR = 1e-4


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
    """Seconds across, the error upward, both logarithmic; errors below .0001 lie on the ground."""
    across = _Axis([p.seconds for p in points], _LEFT, _WIDTH - _RIGHT)
    upward = _Axis([max(p.error, _LEAST_ERROR) for p in points], _HEIGHT - _BOTTOM, _TOP)
    parts = [f'<text x="{_WIDTH / 2}" y="16" class="title">{html.escape(title)}</text>']
    parts += [_grid(across.place(tick), None, f"{tick:g} s") for tick in across.ticks()]
    parts += [_grid(None, upward.place(tick), f"{tick:g}") for tick in upward.ticks()]
    for p in points:
        parts.append(_dot(across.place(p.seconds), upward.place(max(p.error, _LEAST_ERROR)), p))
    return (
        f'<svg viewBox="0 0 {_WIDTH} {_HEIGHT}" role="img" '
        f'aria-label="{html.escape(title)} over seconds a frame">{"".join(parts)}</svg>'
    )


class _Axis:
    """Whole decades around values above 0, at least one, between two places."""

    def __init__(self, values: Iterable[float], start: float, end: float) -> None:
        logarithms = [math.log10(value) for value in values]
        self._low = math.floor(min(logarithms))
        self._high = max(math.ceil(max(logarithms)), self._low + 1)
        self._start, self._end = start, end

    def place(self, value: float) -> float:
        part = (math.log10(value) - self._low) / (self._high - self._low)
        return self._start + part * (self._end - self._start)

    def ticks(self) -> list[float]:
        return [10.0**exponent for exponent in range(self._low, self._high + 1)]


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
