"""``pyopacity info FILE...``"""

import argparse
from typing import Any

import numpy as np

import pyopacity as po
from pyopacity.bounds import Bounds
from pyopacity.cli import text
from pyopacity.shapes import PointShape

_NO_SHADOW = "; casts no shadow"


def add_to(commands: Any) -> None:
    """The command's options."""
    summary = "tell what is in files: shapes, counts, bounds, widths, opacities, maps"
    parser = text.add_command(commands, "info", run, summary)
    parser.add_argument("files", nargs="+", metavar="FILE", help=text.FILES)


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
    document: dict[str, Any] = {"kind": type(shape).__name__.lower()}
    if isinstance(shape, po.Strands):
        document |= {"strands": len(shape.offsets) - 1, "segments": shape.segment_count}
        document["width"] = _range(shape.width)
    elif isinstance(shape, po.Mesh):
        document |= {"triangles": len(shape.triangles)} | _maps(shape)
    elif isinstance(shape, po.Particles):
        document["radius"] = _range(shape.radius)
    elif isinstance(shape, po.Volume):
        document["voxels"] = list(reversed(shape.extinction.shape))
        document["extinction"] = _range(shape.extinction)
    if isinstance(shape, PointShape):
        document |= {"points": len(shape.points), "opacity": _range(shape.opacity)}
    return document | {"bounds": _corners(shape.bounds), "casts": shape.casts}


def _maps(mesh: po.Mesh) -> dict[str, Any]:
    maps: dict[str, Any] = {}
    if mesh.alpha_map is not None:
        maps["alpha_map"] = list(reversed(mesh.alpha_map.shape))
        maps["alpha_mode"] = mesh.alpha_mode
        maps["alpha_cutoff"] = mesh.alpha_cutoff
    if mesh.color_map is not None:
        height, width, _ = mesh.color_map.shape
        maps["color_map"] = [width, height]
    return maps


def _range(values: object) -> list[float]:
    array = np.asarray(values, np.float64)
    return [float(array.min()), float(array.max())] if array.size else []


def _corners(bounds: Bounds) -> list[list[float]] | None:
    return None if bounds.empty else [bounds.min.tolist(), bounds.max.tolist()]


def _print(document: dict[str, Any]) -> None:
    count = len(document["shapes"])
    print(f"{document['file']}: {count} shape{'' if count == 1 else 's'}")
    print(f"  bounds     {_box_text(document['bounds'])}")
    for shape in document["shapes"]:
        counts = [
            f"{shape[name]} {name}"
            for name in ("strands", "segments", "triangles", "points")
            if name in shape
        ]
        if "voxels" in shape:
            counts = [f"{_size_text(shape['voxels'])} voxels"]
        print(f"  {shape['kind']}: {', '.join(counts)}{'' if shape['casts'] else _NO_SHADOW}")
        for name in ("width", "radius", "extinction", "opacity"):
            if shape.get(name):
                low, high = shape[name]
                _print_row(name, f"{low:g}" + (f" .. {high:g}" if high > low else ""))
        if "alpha_map" in shape:
            cutoff = f" at {shape['alpha_cutoff']:g}" if shape["alpha_mode"] == "mask" else ""
            mode = f"{shape['alpha_mode']}{cutoff}"
            _print_row("alpha", f"{mode}, {_size_text(shape['alpha_map'])} texels")
        if "color_map" in shape:
            _print_row("color", f"{_size_text(shape['color_map'])} texels")
        _print_row("bounds", _box_text(shape["bounds"]))


def _print_row(name: str, content: str) -> None:
    print(f"    {name:11}{content}")


def _size_text(size: list[int]) -> str:
    return " x ".join(map(str, size))


def _box_text(corners: list[list[float]] | None) -> str:
    if corners is None:
        return "empty"
    low, high = (" ".join(f"{value:g}" for value in corner) for corner in corners)
    return f"{low} .. {high}"
