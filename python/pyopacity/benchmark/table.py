"""What a section finds: rows, and the plots that show them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

Cell = str | int | float | bool | None
Row = dict[str, Cell]


@dataclass(frozen=True, slots=True)
class Table:
    """One of the benchmark's results.

    Attributes:
        name: of its file, such as "errors".
        title: for people.
        note: what was measured, and how.
        rows: all with the same names, in the order of the columns.
        plots: name of a file and its SVG.
    """

    name: str
    title: str
    note: str
    rows: list[Row]
    plots: dict[str, str] = field(default_factory=dict)

    @property
    def columns(self) -> list[str]:
        """Names of the cells of a row."""
        return list(self.rows[0]) if self.rows else []

    def lines(self) -> list[list[str]]:
        """The cells as text for people."""
        return [[text_of(cell) for cell in row.values()] for row in self.rows]

    def markdown(self) -> str:
        """As it can stand in a document."""
        ruled = [self.columns, ["---"] * len(self.columns), *self.lines()]
        return "\n".join(_ruled(line) for line in ruled)


def text_of(cell: Cell) -> str:
    """Three digits of what was measured; nothing for what was not."""
    if cell is None:
        return "-"
    if isinstance(cell, bool):
        return "yes" if cell else "no"
    if isinstance(cell, int):
        return f"{cell:,}"
    if isinstance(cell, float):
        return f"{cell:,.0f}" if abs(cell) >= 1000.0 else f"{cell:.3g}"
    return cell


def _ruled(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cell.replace('|', '/') for cell in cells)} |"
