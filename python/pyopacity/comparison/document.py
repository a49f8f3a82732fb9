"""A page that needs nothing from elsewhere: its style is in it."""

from __future__ import annotations

import html
from collections.abc import Iterable

from pyopacity.comparison import plot

_STYLE = """
:root { color-scheme: light dark; font: 15px/1.5 system-ui, sans-serif; }
body { margin: 2rem auto; max-width: 76rem; padding: 0 1rem; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: .85rem; }
th, td { padding: .2rem .5rem; text-align: right; }
thead th { border-bottom: 1px solid #8886; }
tbody tr:hover { background: #8882; }
.scroll { overflow-x: auto; }
.row { display: flex; flex-wrap: wrap; gap: 1rem; }
code { overflow-wrap: anywhere; }
"""


def document(title: str, style: str, body: Iterable[str]) -> str:
    """The whole page.

    Args:
        title: as text, of its tab.
        style: beside what all pages have: CSS.
        body: HTML.
    """
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        f'<title>{html.escape(title)}</title><meta name="viewport" content="width=device-width">'
        f"<style>{_STYLE}{plot.STYLE}{style}</style></head>\n"
        + "\n".join(["<body>", *body, "</body></html>", ""])
    )
