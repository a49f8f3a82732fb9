"""Lines over an axis, as a picture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from PIL import Image, ImageDraw

from common.pictures import INK, PAPER, font

# Of a colour-blind safe set (Okabe and Ito 2008).
COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6d31", "#7f7f7f")
LEFT, RIGHT, BOTTOM, ROW = 52, 14, 38, 15
GRID = (225, 225, 225)

Line = tuple[Sequence[float], Sequence[float]]
Range = tuple[float, float]


def steps(low: float, high: float, most: int = 7) -> list[float]:
    """Round numbers within a range."""
    rough = (high - low) / most
    power = 10.0 ** np.floor(np.log10(rough))
    step = next(power * factor for factor in (1, 2, 2.5, 5, 10) if power * factor >= rough)
    first = np.ceil(low / step - 1e-9) * step
    return [float(first + i * step) for i in range(int((high - first) / step + 1e-9) + 1)]


class Axes:
    """Where values lie on a picture."""

    def __init__(self, size: tuple[int, int], across: Range, upward: Range, top: int) -> None:
        self.size, self.across, self.upward, self.top = size, across, upward, top

    def place(self, x: float, y: float) -> tuple[float, float]:
        (left, right), (low, high) = self.across, self.upward
        width, height = self.size
        return (
            LEFT + (x - left) / (right - left) * (width - LEFT - RIGHT),
            height - BOTTOM - (y - low) / (high - low) * (height - self.top - BOTTOM),
        )

    def draw_grid(self, draw: ImageDraw.ImageDraw, x_name: str, y_name: str) -> None:
        width, height = self.size
        for x in steps(*self.across):
            at = self.place(x, self.upward[0])
            draw.line([at, (at[0], self.top)], GRID)
            draw.text((at[0], at[1] + 3), f"{x:g}", INK, font(11), anchor="ma")
        for y in steps(*self.upward):
            at = self.place(self.across[0], y)
            draw.line([at, (width - RIGHT, at[1])], GRID)
            draw.text((at[0] - 4, at[1]), f"{y:g}", INK, font(11), anchor="rm")
        draw.text((width / 2, height - 4), x_name, INK, font(11), anchor="md")
        draw.text((4, 4), y_name, INK, font(11))


def _range(lines: Mapping[str, Line], index: int) -> Range:
    values = [float(value) for line in lines.values() for value in line[index]]
    return min(values), max(values)


def chart(
    lines: Mapping[str, Line],
    x_name: str,
    y_name: str,
    upward: Range | None = None,
    size: tuple[int, int] = (440, 300),
    dots: bool = True,
) -> Image.Image:
    """Lines by name, each of its x and y; upward from 0, or over a range."""
    image = Image.new("RGB", size, PAPER)
    draw = ImageDraw.Draw(image)
    top = ROW * len(lines) + 8
    axes = Axes(size, _range(lines, 0), upward or (0.0, 1.05 * _range(lines, 1)[1]), top)
    axes.draw_grid(draw, x_name, y_name)
    for i, (name, (across, values)) in enumerate(lines.items()):
        color = COLORS[i % len(COLORS)]
        points = [axes.place(x, y) for x, y in zip(across, values, strict=True)]
        draw.line(points, color, 2)
        if dots:
            for x, y in points:
                draw.ellipse((x - 3, y - 3, x + 3, y + 3), color)
        draw.text((size[0] - RIGHT, 4 + ROW * i), name, color, font(11), anchor="ra")
    return image
