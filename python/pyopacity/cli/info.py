"""``pyopacity info FILE...``"""

import argparse
from typing import Any

import numpy as np

import pyopacity as po
from pyopacity.bounds import Bounds
from pyopacity.cli import text


def add_to(commands: Any) -> None:
    """The command's options."""
    summary = "tell what is in files: shapes, counts, bounds, widths, opacities"
    parser = text.add_command(commands, "info", run, summary)
    parser.add_argument("files", nargs="+", metavar="FILE", help=".hair, .obj, demo:hair")


def run(arguments: argparse.Namespace) -> int:
    """Prints what is in each file."""
    documents = []
    for file in arguments.files:
        shapes = po.load(file)
        documents.append(
            {
                "file": file,
                "bounds": _corners(Bounds.union(shape.bounds for shape in shapes)),
                "shapes": [_document(shape) for shape in shapes],
            }
        )
    if arguments.json:
        text.print_json(documents)
        return 0
    for document in documents:
        _print(document)
    return 0


def _document(shape: po.Shape) -> dict[str, Any]:
    document: dict[str, Any] = {"kind": "mesh", "points": len(shape.points)}
    if isinstance(shape, po.Strands):
        document |= {
            "kind": "strands",
            "strands": len(shape.offsets) - 1,
            "segments": shape.segment_count,
            "width": _range(shape.width),
        }
    elif isinstance(shape, po.Mesh):
        document["triangles"] = len(shape.triangles)
    return document | {
        "opacity": _range(shape.opacity),
        "bounds": _corners(shape.bounds),
        "casts": shape.casts,
    }


def _range(values: object) -> list[float]:
    array = np.asarray(values, np.float64)
    return [float(array.min()), float(array.max())] if array.size else []


def _corners(bounds: Bounds) -> list[list[float]] | None:
    return None if bounds.empty else [bounds.min.tolist(), bounds.max.tolist()]


def _print(document: dict[str, Any]) -> None:
    count = len(document["shapes"])
    print(f"{document['file']}: {count} shape{'' if count == 1 else 's'}")
    print(f"  bounds    {_box_text(document['bounds'])}")
    for shape in document["shapes"]:
        counts = ", ".join(
            f"{shape[name]} {name}"
            for name in ("strands", "segments", "triangles", "points")
            if name in shape
        )
        print(f"  {shape['kind']}: {counts}{'' if shape['casts'] else '; casts no shadow'}")
        for name in ("width", "opacity"):
            if shape.get(name):
                low, high = shape[name]
                print(f"    {name:8}{low:g}" + (f" .. {high:g}" if high > low else ""))
        print(f"    bounds  {_box_text(shape['bounds'])}")


def _box_text(corners: list[list[float]] | None) -> str:
    if corners is None:
        return "empty"
    low, high = (" ".join(f"{value:g}" for value in corner) for corner in corners)
    return f"{low} .. {high}"
