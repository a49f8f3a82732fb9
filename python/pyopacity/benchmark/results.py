"""The benchmark in a folder: index.html, results.json, a .csv for each table, its plots as .svg."""

from __future__ import annotations

import csv
import io
import json
import pathlib
from typing import Any

from pyopacity._files import whole_file
from pyopacity.benchmark import page
from pyopacity.benchmark.machine import Machine
from pyopacity.benchmark.table import Table
from pyopacity.comparison import plot
from pyopacity.errors import ParameterError


class Results:
    """What was measured so far. After each table the files are complete, whatever comes then."""

    def __init__(self, folder: pathlib.Path, machine: Machine, command: str) -> None:
        """
        Args:
            folder: made with the first table; files of the same names are replaced.
            machine: stands beside every table.
            command: that measures this again.
        """
        self.tables: dict[str, Table] = {}
        self._folder, self._machine, self._command = folder, machine, command

    def put(self, table: Table) -> None:
        """Writes a table, in the place of what it was before, and every file that lists tables."""
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise ParameterError(
                f"{self._folder} cannot be made: {error.strerror}", "choose another folder"
            ) from error
        self.tables[table.name] = table
        self._write(f"{table.name}.csv", self._csv(table))
        for name, svg in table.plots.items():
            self._write(f"{name}.svg", plot.standalone(svg))
        self._write("results.json", json.dumps(self.document(), indent=2) + "\n")
        tables = list(self.tables.values())
        self._write("index.html", page.html_of(tables, self._machine, self._command))

    def document(self) -> dict[str, Any]:
        """For programs."""
        return {
            "machine": self._machine.facts,
            "command": self._command,
            "tables": {
                name: {
                    "title": table.title,
                    "note": " ".join(table.note.split()),
                    "rows": table.rows,
                }
                for name, table in self.tables.items()
            },
        }

    def _csv(self, table: Table) -> str:
        """The rows, each with the machine's facts."""
        text = io.StringIO()
        facts = self._machine.facts
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow([*table.columns, *facts])
        for row in table.rows:
            writer.writerow([*row.values(), *facts.values()])
        return text.getvalue()

    def _write(self, name: str, content: str) -> None:
        with whole_file(self._folder / name) as file:
            file.write(content.encode())
