"""A comparison in a folder: results.csv, results.json, index.html, and pictures, if any."""

from __future__ import annotations

import csv
import io
import json
import pathlib
from typing import Any

import numpy as np

from pyopacity import _native, image
from pyopacity._files import whole_file
from pyopacity.comparison import page
from pyopacity.comparison.plan import Plan
from pyopacity.comparison.rows import Result
from pyopacity.comparison.surfaces import F32
from pyopacity.errors import ParameterError

# Linear luminance that makes an error map fully red or blue.
ERROR_MAP_RANGE = 0.1
_LUMINANCE = np.array([0.2126, 0.7152, 0.0722], np.float32)


class Results:
    """What was measured so far. After each row the files are complete, whatever comes then."""

    def __init__(self, folder: pathlib.Path, plan: Plan, scene: str, command: str) -> None:
        """
        Args:
            folder: made with the first row; what it holds of an earlier comparison is replaced.
            plan: as it was measured.
            scene, command: in every row, so that it can be measured again.
        """
        self.rows: list[dict[str, Any]] = []
        self._folder, self._plan = folder, plan
        self._scene, self._command = scene, command
        self._traced: list[F32] = []

    def add(self, result: Result) -> None:
        """Writes a row's pictures, then every file that lists rows."""
        picture, traced = result.picture, result.traced
        self._make(self._folder if picture is None else self._folder / "images")
        row = self._row(result)
        if picture is not None:
            row |= {"picture": f"images/{_name_of(result)}.png"}
            image.save_image(self._folder / row["picture"], picture)
        if picture is not None and traced is not None:
            row |= self._names_of(result, traced)
            image.save_image(self._folder / row["traced"], traced)
            image.save_image(self._folder / row["error_map"], error_map(picture, traced))
        self.rows.append(row)
        self._write("results.csv", _as_csv(self.rows))
        self._write("results.json", json.dumps(self.rows, indent=2) + "\n")
        self._write("index.html", page.html_of(self.rows))

    @staticmethod
    def _make(folder: pathlib.Path) -> None:
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise ParameterError(
                f"{folder} cannot be made: {error.strerror}", "choose another folder"
            ) from error

    def _row(self, result: Result) -> dict[str, Any]:
        plan, variant = self._plan, result.variant
        width, height = plan.image_size
        return {
            "scene": self._scene,
            "seed": plan.seed,
            "technique": variant.technique,
            "parameters": variant.parameters,
            "map_size": result.map_size,
            "map_size_reason": result.map_size_reason,
            "footprint": result.footprint,
            "receivers": result.receivers,
            "samples": plan.samples,
            "image_size": f"{width}x{height}",
            "image_samples": plan.image_samples,
            **result.figures(),
            "renderer": result.renderer,
            "version": _native.version(),
            "command": self._command,
            **dict.fromkeys(("picture", "error_map", "traced")),
        }

    def _names_of(self, result: Result, traced: F32) -> dict[str, str]:
        """Files of what a row's picture is measured by."""
        return {
            "error_map": f"images/{_name_of(result)}-error.png",
            "traced": f"images/{self._name_of_traced(traced)}.png",
        }

    def _name_of_traced(self, traced: F32) -> str:
        """Rows that are measured against the same picture show the same file."""
        if not any(traced is known for known in self._traced):
            self._traced.append(traced)
        index = next(i for i, known in enumerate(self._traced) if traced is known)
        return "traced" if index == 0 else f"traced-{index + 1}"

    def _write(self, name: str, content: str) -> None:
        with whole_file(self._folder / name) as file:
            file.write(content.encode())


def _name_of(result: Result) -> str:
    layers = result.variant.parameters.get("layers")
    name = result.variant.technique + (f"-{layers}" if layers is not None else "")
    return f"{name}-map-{'auto' if result.map_size_reason else result.map_size}"


def error_map(picture: F32, traced: F32) -> F32:
    """Where a picture is too light (red) and too dark (blue), in linear luminance over black."""
    difference = (picture[..., :3] - traced[..., :3]) @ _LUMINANCE
    strength = np.clip(difference / ERROR_MAP_RANGE, -1.0, 1.0)
    colors = np.ones((*strength.shape, 3), np.float32)
    colors[..., 0] -= np.maximum(-strength, 0.0)
    colors[..., 1] -= np.abs(strength)
    colors[..., 2] -= np.maximum(strength, 0.0)
    return colors


def _as_csv(rows: list[dict[str, Any]]) -> str:
    """One line a row; parameters as ``name=value``, a figure that there is not as nothing."""
    text = io.StringIO()
    writer = csv.DictWriter(text, fieldnames=list(rows[0]), lineterminator="\n")
    writer.writeheader()
    for row in rows:
        parameters = " ".join(f"{name}={value}" for name, value in row["parameters"].items())
        writer.writerow({**row, "parameters": parameters})
    return text.getvalue()
