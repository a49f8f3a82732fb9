"""Plots as SVG in a page: they need no package, scale, and take the page's colours.

Both axes are logarithmic: what is compared lies decades apart.
"""

from __future__ import annotations

import html
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

# Of a colour-blind safe set (Okabe and Ito 2008), readable on light and dark.
_COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6d31", "#7f7f7f")
_WIDTH, _HEIGHT = 360, 260
_LEFT, _RIGHT, _TOP, _BOTTOM = 52, 16, 30, 40
_LINE_OF_LEGEND = 15
# Around (0, 0), for kinds of a technique after the first, which has a circle.
_SHAPES = ("M-3-3H3V3H-3Z", "M0-4L4 3H-4Z", "M0 4L4-3H-4Z")
_LEAST_ERROR = 1e-4
# Where an axis spans fewer decades, these parts of one are marked too.
_FEW_DECADES = 2
_PARTS = (1.0, 2.0, 5.0)

STYLE = """
svg { flex: 1 1 20rem; max-width: 30rem; }
svg text { font-size: 11px; fill: currentColor; }
svg .title { font-size: 13px; text-anchor: middle; }
svg .grid { stroke: #8884; }
svg .line { fill: none; stroke-width: 1.5; }
svg .front { fill: none; stroke: currentColor; stroke-dasharray: 4 3; }
"""


@dataclass(frozen=True, slots=True)
class Point:
    """A row of the table: its number there, and what a pointer over it tells.

    ``technique`` gives it a colour, ``kind`` a shape: 0 to 3.
    """

    number: int
    label: str
    technique: int
    seconds: float
    error: float
    kind: int = 0


def color_of(index: int) -> str:
    """Of the technique with this index."""
    return _COLORS[index % len(_COLORS)]


def is_ring(index: int) -> bool:
    """Whether its dot is empty: every colour has been used."""
    return index // len(_COLORS) % 2 == 1


def error_over_time(
    title: str,
    points: Sequence[Point],
    front: Sequence[Point] = (),
    names: Sequence[str] = (),
    kinds: Sequence[str] = (),
) -> str:
    """Seconds across, the error upward, both logarithmic; errors below .0001 lie on the ground.

    Args:
        title: above it.
        points: of a dot each.
        front: those which a dashed line joins.
        names: of the techniques, for a legend below; without any each dot has its number.
        kinds: what the shapes of dots stand for, for the legend too.
    """
    across = _Axis([p.seconds for p in points], _LEFT, _WIDTH - _RIGHT)
    upward = _Axis([max(p.error, _LEAST_ERROR) for p in points], _HEIGHT - _BOTTOM, _TOP)

    def place(p: Point) -> tuple[float, float]:
        return across.place(p.seconds), upward.place(max(p.error, _LEAST_ERROR))

    parts = [*_frame(title, across, upward, " s")]
    parts += [_dot(*place(p), p, is_numbered=not names) for p in points]
    if len(front) > 1:
        ordered = sorted(front, key=lambda p: p.seconds)
        parts.append(f'<polyline points="{_path(map(place, ordered))}" class="front"/>')
    parts += _legend(names, kinds)
    lines_below = len(names) + len(kinds)
    return _svg(f"{title} over seconds", parts, _HEIGHT + _LINE_OF_LEGEND * lines_below)


def lines(title: str, unit: str, series: Mapping[str, Sequence[tuple[float, float]]]) -> str:
    """A line for each name, through its points (across, upward), both above 0; a legend below.

    Args:
        title: above it.
        unit: of what is across, such as " segments".
        series: name and points.
    """
    points = [point for line in series.values() for point in line]
    across = _Axis([x for x, _ in points], _LEFT, _WIDTH - _RIGHT)
    upward = _Axis([y for _, y in points], _HEIGHT - _BOTTOM, _TOP)
    parts = [*_frame(title, across, upward, unit)]
    for index, (name, line) in enumerate(series.items()):
        color = color_of(index)
        places = [(across.place(a), upward.place(b)) for a, b in line]
        parts.append(f'<polyline points="{_path(places)}" class="line" stroke="{color}"/>')
        for (cx, cy), (a, b) in zip(places, line, strict=True):
            told = html.escape(f"{name}: {b:.3g} at {a:,.0f}")
            parts.append(
                f'<circle cx="{cx:.1f}" cy="{cy:.1f}" r="3.5" fill="{color}">'
                f"<title>{told}</title></circle>"
            )
    parts += _legend(series)
    return _svg(title, parts, _HEIGHT + _LINE_OF_LEGEND * len(series))


def standalone(svg: str) -> str:
    """The plot as a file of its own."""
    style = f"<style>svg {{ color: #222; font-family: sans-serif; }}{STYLE}</style>"
    opening, closing, rest = svg.partition(">")
    named = opening.replace("<svg", '<svg xmlns="http://www.w3.org/2000/svg"')
    return f"{named}{closing}{style}{rest}\n"


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
        decades = range(self._low, self._high)
        parts = _PARTS if len(decades) < _FEW_DECADES else _PARTS[:1]
        return [part * 10.0**e for e in decades for part in parts] + [10.0**self._high]


def _frame(title: str, across: _Axis, upward: _Axis, unit: str) -> Iterable[str]:
    yield f'<text x="{_WIDTH / 2}" y="16" class="title">{html.escape(title)}</text>'
    for tick in across.ticks():
        yield _grid(across.place(tick), None, f"{_short(tick)}{html.escape(unit)}")
    for tick in upward.ticks():
        yield _grid(None, upward.place(tick), _short(tick))


def _short(tick: float) -> str:
    """Thousands and millions as letters, so that marks stay apart."""
    for size, letter in ((1e6, " M"), (1e3, " k")):
        if tick >= size:
            return f"{tick / size:g}{letter}"
    return f"{tick:g}"


def _svg(label: str, parts: Iterable[str], height: int) -> str:
    return (
        f'<svg viewBox="0 0 {_WIDTH} {height}" role="img" '
        f'aria-label="{html.escape(label)}">{"".join(parts)}</svg>'
    )


def _path(places: Iterable[tuple[float, float]]) -> str:
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in places)


def _grid(x: float | None, y: float | None, label: str) -> str:
    if x is not None:
        line = f'x1="{x:.1f}" x2="{x:.1f}" y1="{_TOP}" y2="{_HEIGHT - _BOTTOM}"'
        place = f'x="{x:.1f}" y="{_HEIGHT - _BOTTOM + 16}" text-anchor="middle"'
    else:
        line = f'x1="{_LEFT}" x2="{_WIDTH - _RIGHT}" y1="{y:.1f}" y2="{y:.1f}"'
        place = f'x="{_LEFT - 6}" y="{y:.1f}" dy="4" text-anchor="end"'
    return f'<line {line} class="grid"/><text {place}>{label}</text>'


def _legend(names: Iterable[str], kinds: Iterable[str] = ()) -> Iterable[str]:
    """Below the axes, a line each: colours, then shapes."""
    marks = [(name, color_of(index), 0, is_ring(index)) for index, name in enumerate(names)]
    marks += [(name, "currentColor", kind, True) for kind, name in enumerate(kinds)]
    for line, (name, color, kind, is_empty) in enumerate(marks):
        y = _HEIGHT + _LINE_OF_LEGEND * line
        yield _mark(color, kind, is_empty, _LEFT + 5, y - 4)
        yield f'<text x="{_LEFT + 16}" y="{y}">{html.escape(name)}</text>'


def _mark(color: str, kind: int, is_empty: bool, x: float, y: float) -> str:
    fill = "none" if is_empty else color
    look = f'fill="{fill}" fill-opacity=".4" stroke="{color}" stroke-width="1.2"'
    if kind == 0:
        return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" {look}/>'
    return f'<path d="{_SHAPES[kind - 1]}" transform="translate({x:.1f} {y:.1f})" {look}/>'


def _dot(x: float, y: float, point: Point, is_numbered: bool) -> str:
    label = html.escape(f"{point.label}: {point.error:.4f}, {point.seconds:.3g} s")
    number = f'<text x="{x + 8:.1f}" y="{y - 4:.1f}">{point.number}</text>' if is_numbered else ""
    mark = _mark(color_of(point.technique), point.kind, is_ring(point.technique), x, y)
    return f"<g><title>{label}</title>{mark}{number}</g>"
