"""The page of a comparison: the table, error over time, pictures beside the traced one, if any."""

from __future__ import annotations

import html
from collections.abc import Sequence
from typing import Any

from pyopacity.comparison import plot
from pyopacity.comparison.document import document

Row = dict[str, Any]

_KINDS = {"depth": "depth error", "total": "total error", "image": "image error"}
_FIGURES = {"rmse": "RMSE", "mae": "mean", "bias": "bias", "p99": "99 %", "maximum": "max"}

_STYLE = """
thead tr:first-child th, th:nth-child(2), td:nth-child(2) { text-align: left; }
.first { border-left: 1px solid #8886; }
figure { margin: 0; }
img { display: block; background: #000; max-width: 100%; }
.dot { display: inline-block; width: .5em; height: .5em; border: .1em solid; border-radius: 50%; }
"""

_MEANING = """
<p>All errors are of T, the part of the light that arrives, in 0 .. 1; of pictures, linear colour.
<b>Depth error</b>: against every fragment of the same map, sorted; what layers cost.
<b>Total error</b>: against rays through the real geometry, averaged over the footprint.
<b>Image error</b>: of the picture, against the same picture shaded with T by rays; FLIP is what a
person sees. Mean is of |difference|; bias below 0 is too dark; 99 % is the percentile.
<b>Passes</b> and <b>bytes a texel</b>: of the maps of all lights, with what passes hand on.</p>
"""


def html_of(rows: Sequence[Row]) -> str:
    """The whole page, for rows as results.json holds them."""
    first = rows[0]
    body = [
        f"<h1>{html.escape(first['scene'])}</h1>",
        f"<p>{_facts(first)}</p>",
        _MEANING,
        f'<div class="scroll">{_table(rows)}</div>',
        "<h2>Error over time</h2>",
        "<p>RMSE over the seconds of a whole frame from nothing; numbers as in the table.</p>",
        f'<div class="row">{_plots(rows)}</div>',
        "<h2>Pictures</h2>",
        *_pictures_of_all(rows),
        f"<p><code>{html.escape(first['command'])}</code></p>",
    ]
    return document(f"{first['scene']}: errors", _STYLE, body)


def _facts(row: Row) -> str:
    samples = row["image_samples"]
    facts = [
        f"{row['receivers']:,} receivers (seed {row['seed']})",
        f"{row['samples']} rays a footprint",
        f"pyopacity {row['version']} on {row['renderer']}",
    ]
    if _has_pictures(row):
        rays = " with a ray each" if row["traced"] is not None else ""
        facts.insert(
            2, f"pictures {row['image_size']}, {samples} x {samples} samples a pixel{rays}"
        )
    return html.escape("; ".join(facts)) + "."


def _has_pictures(row: Row) -> bool:
    return row["picture"] is not None


def _kinds(row: Row) -> dict[str, str]:
    """The errors that were measured: name in a row -> for people."""
    return {k: v for k, v in _KINDS.items() if row[f"{k}_rmse"] is not None}


def _label(row: Row) -> str:
    parameters = [f"{name} {value}" for name, value in row["parameters"].items()]
    return ", ".join([row["technique"], *parameters])


def _indices(rows: Sequence[Row]) -> dict[str, int]:
    """Of each technique, for its dot."""
    names = dict.fromkeys(row["technique"] for row in rows)
    return {name: index for index, name in enumerate(names)}


def _table(rows: Sequence[Row]) -> str:
    indices, kinds = _indices(rows), _kinds(rows[0])
    groups = "".join(f'<th colspan="5" class="first">{kind}</th>' for kind in kinds.values())
    names = ""
    for _ in kinds:
        first, *others = _FIGURES.values()
        names += f'<th class="first">{first}</th>' + "".join(f"<th>{name}</th>" for name in others)
    head = (
        f'<thead><tr><th colspan="4"></th>{groups}<th></th><th colspan="2" class="first">seconds'
        '</th><th colspan="2" class="first">maps</th></tr>'
        "<tr><th>#</th><th>technique</th><th>map</th><th>footprint</th>"
        f'{names}<th>FLIP</th><th class="first">frame</th><th>maps</th>'
        '<th class="first">passes</th><th>bytes a texel</th></tr></thead>'
    )
    lines = [
        f"<tr>{''.join(_cells(number, row, indices[row['technique']]))}</tr>"
        for number, row in enumerate(rows, 1)
    ]
    return f"<table>{head}<tbody>{''.join(lines)}</tbody></table>"


def _cells(number: int, row: Row, index: int) -> list[str]:
    label = html.escape(_label(row))
    cells = [
        f"<td>{number}</td>",
        f"<td>{_dot(index)} {label}</td>",
        f"<td>{_map(row)}</td>",
        f"<td>{row['footprint']:.4g}</td>",
    ]
    for kind in _kinds(row):
        for name in _FIGURES:
            value = row[f"{kind}_{name}"]
            text = f"{value:+.4f}" if name == "bias" else f"{value:.4f}"
            mark = ' class="first"' if name == "rmse" else ""
            cells.append(f"<td{mark}>{text}</td>")
    flip = "-" if row["flip"] is None else f"{row['flip']:.4f}"
    cells.append(f"<td>{flip}</td>")
    cells.append(f'<td class="first">{row["seconds"]:.3f}</td><td>{row["map_seconds"]:.3f}</td>')
    cells.append(f'<td class="first">{row["passes"]}</td><td>{row["bytes_per_texel"]:.0f}</td>')
    return cells


def _dot(index: int) -> str:
    """As it is in the plots."""
    color = plot.color_of(index)
    fill = "transparent" if plot.is_ring(index) else color
    return f'<span class="dot" style="border-color:{color};background:{fill}"></span>'


def _plots(rows: Sequence[Row]) -> str:
    indices = _indices(rows)
    plots = []
    for kind, title in _kinds(rows[0]).items():
        points = [
            plot.Point(
                number,
                f"{_label(row)}, map {_map(row)}",
                indices[row["technique"]],
                row["seconds"],
                row[f"{kind}_rmse"],
            )
            for number, row in enumerate(rows, 1)
        ]
        plots.append(plot.error_over_time(title, points))
    return "".join(plots)


def _map(row: Row) -> str:
    reason = row["map_size_reason"]
    return f"{row['map_size']}" + (f" (auto: {reason})" if reason else "")


def _pictures_of_all(rows: Sequence[Row]) -> list[str]:
    if not _has_pictures(rows[0]):
        return ["<p>None: they need OpenGL, and T was looked up on the CPU.</p>"]
    meaning = "<p>Error maps: red is too light, blue too dark, by .1 or more.</p>"
    if rows[0]["traced"] is None:
        meaning = (
            "<p>Particles and volumes take T all along a view: their picture is not traced.</p>"
        )
    return [meaning, *(_pictures(number, row) for number, row in enumerate(rows, 1))]


def _pictures(number: int, row: Row) -> str:
    heading = html.escape(f"{number}. {_label(row)}, map {_map(row)}")
    figures = "".join(
        f'<figure><img src="{html.escape(row[name])}" alt="{caption}" loading="lazy">'
        f"<figcaption>{caption}</figcaption></figure>"
        for name, caption in (
            ("traced", "by rays"),
            ("picture", "the technique"),
            ("error_map", "error"),
        )
        if row[name] is not None
    )
    return f'<h3>{heading}</h3>\n<div class="row">{figures}</div>'
