"""The benchmark as one page that needs nothing else."""

from __future__ import annotations

import html
from collections.abc import Iterator, Sequence

from pyopacity.benchmark.machine import Machine
from pyopacity.benchmark.table import Cell, Table, text_of
from pyopacity.comparison.document import document

_STYLE = """
h2 { margin-top: 2.5rem; }
th.words, td.words { text-align: left; }
caption { caption-side: bottom; text-align: left; padding: .4rem .5rem; opacity: .75; }
tr.no td { background: #d55e0022; }
tr.front td { font-weight: 600; }
"""


def html_of(tables: Sequence[Table], machine: Machine, command: str) -> str:
    """The whole page."""
    body = [
        "<h1>pyopacity bench</h1>",
        f"<p>{html.escape(str(machine))}</p>",
        "<p>Ratios are of things that took turns; figures are medians. A time in seconds means "
        "something on this machine only.</p>",
        *(part for table in tables for part in _section(table, machine)),
        f"<p><code>{html.escape(command)}</code></p>",
    ]
    return document("pyopacity bench", _STYLE, body)


def _section(table: Table, machine: Machine) -> Iterator[str]:
    yield f"<h2>{html.escape(table.title)}</h2>"
    yield f"<p>{html.escape(' '.join(table.note.split()))}</p>"
    if table.plots:
        yield f'<div class="row">{"".join(table.plots.values())}</div>'
    yield f'<div class="scroll">{_table(table, machine)}</div>'


def _table(table: Table, machine: Machine) -> str:
    words = [_is_words(table, column) for column in table.columns]
    head = "".join(_cell("th", name, left) for name, left in zip(table.columns, words, strict=True))
    lines = []
    for row in table.rows:
        cells = "".join(
            _cell("td", text_of(value), left)
            for value, left in zip(row.values(), words, strict=True)
        )
        lines.append(f"<tr{_mark(row)}>{cells}</tr>")
    caption = f"<caption>{html.escape(str(machine))}</caption>"
    return f"<table>{caption}<thead><tr>{head}</tr></thead><tbody>{''.join(lines)}</tbody></table>"


def _is_words(table: Table, column: str) -> bool:
    return any(isinstance(row[column], str) and row[column] for row in table.rows)


def _mark(row: dict[str, Cell]) -> str:
    """What is seen at once: a goal that is missed, a row on the front."""
    if row.get("holds") is False:
        return ' class="no"'
    return ' class="front"' if row.get("front") is True else ""


def _cell(tag: str, text: str, is_words: bool) -> str:
    mark = ' class="words"' if is_words else ""
    return f"<{tag}{mark}>{html.escape(text)}</{tag}>"
