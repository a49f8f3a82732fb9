"""Errors on logarithmic axes, as SVG: it needs no package, and is small enough to keep."""

from __future__ import annotations

import html
import math
import pathlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

# Okabe and Ito 2008, readable on light and dark, as in pyopacity/comparison/plot.py.
_COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6d31", "#7f7f7f")
_WIDTH, _HEIGHT, _LEFT, _RIGHT, _TOP, _BOTTOM = 560, 300, 62, 190, 30, 42
_STYLE = (
    "text{font:12px sans-serif;fill:#777}.grid{stroke:#8884;stroke-width:1}"
    "polyline{fill:none;stroke-width:2}.title{font-weight:bold}"
)


@dataclass(frozen=True, slots=True)
class Line:
    """Values over places, both above 0; a value of 0 is drawn at the lower end."""

    label: str
    x: Sequence[float]
    y: Sequence[float]


class _Axis:
    def __init__(self, values: Iterable[float], start: float, end: float) -> None:
        logarithms = [math.log10(value) for value in values if value > 0.0]
        self.low = math.floor(min(logarithms))
        self.high = max(math.ceil(max(logarithms)), self.low + 1)
        self._start, self._end = start, end

    def place(self, value: float) -> float:
        logarithm = math.log10(max(value, 10.0**self.low))
        return self._start + (logarithm - self.low) / (self.high - self.low) * (
            self._end - self._start
        )

    def ticks(self) -> list[int]:
        step = max((self.high - self.low) // 8, 1)
        return list(range(self.low, self.high + 1, step))


def log_log(path: pathlib.Path, title: str, across: str, lines: Sequence[Line]) -> None:
    """Writes a plot."""
    x = _Axis([v for line in lines for v in line.x], _LEFT, _WIDTH - _RIGHT)
    y = _Axis([v for line in lines for v in line.y], _HEIGHT - _BOTTOM, _TOP)
    right, ground = _WIDTH - _RIGHT, _HEIGHT - _BOTTOM
    parts = [f"<style>{_STYLE}</style>"]
    parts += [f'<text class="title" x="{_LEFT}" y="18">{html.escape(title)}</text>']
    parts += [f'<text x="{right}" y="{_HEIGHT - 6}" text-anchor="end">{html.escape(across)}</text>']
    for k in x.ticks():
        at = x.place(10.0**k)
        parts.append(f'<line class="grid" x1="{at:.0f}" x2="{at:.0f}" y1="{_TOP}" y2="{ground}"/>')
        parts.append(f'<text x="{at:.0f}" y="{ground + 16}" text-anchor="middle">1e{k}</text>')
    for k in y.ticks():
        at = y.place(10.0**k)
        parts.append(f'<line class="grid" x1="{_LEFT}" x2="{right}" y1="{at:.0f}" y2="{at:.0f}"/>')
        parts.append(f'<text x="{_LEFT - 6}" y="{at + 4:.0f}" text-anchor="end">1e{k}</text>')
    for i, line in enumerate(lines):
        color = _COLORS[i % len(_COLORS)]
        points = " ".join(
            f"{x.place(a):.1f},{y.place(b):.1f}" for a, b in zip(line.x, line.y, strict=True)
        )
        parts.append(f'<polyline stroke="{color}" points="{points}"/>')
        parts.append(
            f'<text x="{right + 10}" y="{_TOP + 12 + 18 * i}" style="fill:{color}">'
            f"{html.escape(line.label)}</text>"
        )
    path.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH} {_HEIGHT}" '
        f'width="{_WIDTH}" height="{_HEIGHT}">{"".join(parts)}</svg>\n',
        "utf-8",
    )
