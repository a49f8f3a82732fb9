"""The tables of a benchmark for docs/performance_tables.md, of what `pyopacity bench` found.

    pyopacity bench -o DIR && python benchmarks/benchmark_tables.py DIR > docs/performance_tables.md

Of time against error the fronts alone; a column that is the same in all rows is told once, before
its table, and a name that the row above has too is left out.
"""

from __future__ import annotations

import argparse
import json
from itertools import pairwise
from pathlib import Path

from pyopacity.benchmark.table import Row, Table, text_of

LEFT_OUT = ("errors",)  # every setting of every scene, some 400 rows
TOLD_ONCE = ("scene", "primitives", "technique", "what grows", "goal", "frame")


def split(rows: list[Row]) -> tuple[Row, list[Row]]:
    """Cells that all rows share, and rows without them; of one row none are."""
    alike = {key: cell for key, cell in rows[0].items() if all(r[key] == cell for r in rows)}
    if len(rows) == 1:
        alike = {}
    return alike, [{key: row[key] for key in row if key not in alike} for row in rows]


def sparse(rows: list[Row]) -> list[Row]:
    """Without names that the row above has too."""
    names = [key for key in rows[0] if key in TOLD_ONCE]
    return rows[:1] + [
        {key: "" if key in names and row[key] == above[key] else row[key] for key in row}
        for above, row in pairwise(rows)
    ]


def printed(table: Table) -> str:
    """A section of the document."""
    alike, rows = split(table.rows)
    facts = {key: cell for key, cell in alike.items() if cell not in ("", None)}
    told = ", ".join(f"{key} {text_of(cell)}" for key, cell in facts.items())
    note = table.note + (f" In all rows: {told}." if told else "")
    shown = Table(table.name, table.title, "", sparse(rows)).markdown()
    return f"## {table.title}\n\n{note}\n\n{shown}"


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path, help="of `pyopacity bench -o`")
    found = json.loads((parser.parse_args().folder / "results.json").read_text("utf-8"))
    machine = ", ".join(f"{name} {text_of(fact)}" for name, fact in found["machine"].items())
    head = f"# Performance: tables\n\n`{found['command']}`; {machine}."
    parts = [f"{head}\nWhat they say is in [performance.md](performance.md)."]
    for name, table in found["tables"].items():
        if name not in LEFT_OUT and table["rows"]:
            parts.append(printed(Table(name, table["title"], table["note"], table["rows"])))
    print("\n\n".join(parts))


if __name__ == "__main__":
    main()
