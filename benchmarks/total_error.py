"""Total error: T of techniques against rays through the real geometry, on maps of all sizes.

    python benchmarks/total_error.py [--table total] [--model straight.hair] > tables.md

Prints tables of docs/accuracy_tables.md: at two texels of each map; over one world footprint for
all maps, by filter and by its width; and what map_size="auto" takes. Generated models, and those
that PYOPACITY_DATA has. Maps are the CPU's, so no OpenGL is needed.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import Any

import error_models
import numpy as np
from error_models import Bench, Model

import pyopacity as po
from pyopacity.comparison.truth import box_width
from pyopacity.metrics import Errors

MAP_SIZES = (128, 256, 512, 1024, 2048)
TECHNIQUES: dict[str, dict[str, Any]] = {"exact": {}, "bounding_opacity_maps": {"layers": 16}}
FILTERS = ("box", "bartlett", "gaussian", "pcf", "none")
LARGEST_BIAS = 0.01
# What finer maps may be worse by, relative: rays and receivers are a sample.
NOISE = 0.02

# A box whose variance, with that of the texels themselves, is a footprint of two texels:
# (2 r)^2 + 1 = 2^2.
FOOTPRINT_RADIUS = 0.5 * np.sqrt(3.0)
# (deposit_rule, what the table calls it, look-ups on that one map)
VARIANTS: dict[str, list[tuple[str, dict[str, Any]]]] = {
    "area": [("default", {}), ("`filter_radius` .87", {"filter_radius": FOOTPRINT_RADIUS})],
    "paper": [("paper deposit", {})],
}


def header(first: str, last: str = "") -> None:
    sizes = " | ".join(f"{size}^2" for size in MAP_SIZES)
    tail = f" {last} |" if last else ""
    print(f"| {first} | {sizes} |{tail}")
    print("|---" * (first.count("|") + 1 + len(MAP_SIZES) + bool(last)) + "|")


def cell(found: Errors) -> str:
    return f"{found.rmse:.3f} ({found.bias:+.3f})"


# ---- two texels of each map ----


def total_errors(
    bench: Bench, name: str, deposit_rule: str = "area", map_sizes: tuple[int, ...] = MAP_SIZES
) -> dict[str, list[Errors]]:
    """For each look-up: at each map size, against rays over two of its texels."""
    labels, look_ups = zip(*VARIANTS[deposit_rule], strict=True)
    found = []
    for size in map_sizes:
        technique = po.technique(name, deposit_rule=deposit_rule, **TECHNIQUES[name])
        found.append(bench.errors(technique, size, 2.0 * bench.texel(size), look_ups))
    return {
        label: list(column) for label, column in zip(labels, zip(*found, strict=True), strict=True)
    }


def verdict(errors: list[Errors], goal: float) -> str:
    """Whether the goal holds at every map size, or what misses."""
    rmse, bias = max(e.rmse for e in errors), max(abs(e.bias) for e in errors)
    missed = []
    if rmse > goal:
        missed.append(f"RMSE {rmse:.3f}")
    if bias > LARGEST_BIAS:
        missed.append(f"bias {bias:.3f}")
    return f"{goal}: " + ("holds" if not missed else "misses, " + ", ".join(missed))


def print_total(model: Model, bench: Bench) -> None:
    for name, goal in zip(TECHNIQUES, model.goals, strict=True):
        for deposit_rule in VARIANTS:
            for label, errors in total_errors(bench, name, deposit_rule).items():
                mark = "" if deposit_rule == "paper" else verdict(errors, goal)
                cells = " | ".join(map(cell, errors))
                print(f"| {model.name} | `{name}` | {label} | {cells} | {mark} |", flush=True)


# ---- one world footprint for all ----


def footprint_errors(
    bench: Bench,
    name: str,
    filters: tuple[str, ...] = FILTERS,
    map_sizes: tuple[int, ...] = MAP_SIZES,
    judged_px: int = 512,
) -> dict[str, list[Errors]]:
    """For each filter: at each map size, against rays over two texels of one map.

    Filters are as wide as the footprint; "box, matched" is as wide as :func:`box_width` says.
    """
    footprint = 2.0 * bench.texel(judged_px)
    found = []
    for size in map_sizes:
        look_ups = [{"filter": "box", "filter_width": box_width(footprint, bench.texel(size))}]
        look_ups += [{"filter": kind, "filter_width": footprint} for kind in filters]
        technique = po.technique(name, **TECHNIQUES[name])
        found.append(bench.errors(technique, size, footprint, look_ups))
    columns = zip(*found, strict=True)
    return dict(zip(("box, matched", *filters), map(list, columns), strict=True))


def trend(errors: list[Errors]) -> str:
    """Whether a finer map is ever worse, beyond the noise."""
    steps = [
        fine.rmse / coarse.rmse - 1.0 for coarse, fine in zip(errors, errors[1:], strict=False)
    ]
    worst = max(steps)
    return "never worse" if worst <= NOISE else f"worse by {100.0 * worst:.0f} %"


def print_footprint(model: Model, bench: Bench) -> None:
    for name in TECHNIQUES:
        for label, errors in footprint_errors(bench, name).items():
            cells = " | ".join(map(cell, errors))
            print(f"| {model.name} | `{name}` | {label} | {cells} | {trend(errors)} |", flush=True)


def print_widths(model: Model, bench: Bench) -> None:
    """RMSE of `exact` by the width of its box, in footprints; the least of each size in bold."""
    footprint = 2.0 * bench.texel(512)
    parts = np.arange(0.4, 1.61, 0.1)
    look_ups = [{"filter_width": float(part) * footprint} for part in parts]
    table = [
        [e.rmse for e in bench.errors(po.technique("exact"), size, footprint, look_ups)]
        for size in MAP_SIZES
    ]
    for part, column in zip(parts, zip(*table, strict=True), strict=True):
        cells = [
            f"**{rmse:.4f}**" if rmse == min(row) else f"{rmse:.4f}"
            for rmse, row in zip(column, table, strict=True)
        ]
        print(f"| {model.name} | {part:.1f} | " + " | ".join(cells) + " |", flush=True)
    rules = [box_width(footprint, bench.texel(size)) / footprint for size in MAP_SIZES]
    print(f"| {model.name} | rule | " + " | ".join(f"at {part:.2f}" for part in rules) + " |")


# ---- map_size="auto" ----


def print_auto(model: Model, bench: Bench) -> None:
    footprint = 2.0 * bench.texel(512)

    def error(size: int, name: str) -> float:
        width = box_width(footprint, bench.texel(size))
        technique = po.technique(name, filter_width=width, **TECHNIQUES[name])
        (found,) = bench.errors(technique, size, footprint)
        return found.rmse

    technique = po.technique("bounding_opacity_maps")
    size, why = bench.map_size_choice(technique)
    cells = []
    for name in TECHNIQUES:
        chosen, finest = error(size, name), error(MAP_SIZES[-1], name)
        cells.append(f"{chosen:.4f}, {chosen / finest:.2f} of {finest:.4f}")
    print(f"| {model.name} | {size} | {why} | " + " | ".join(cells) + " |", flush=True)


def auto_header() -> None:
    print("| model | texels | reason | `exact` | `bounding_opacity_maps` |")
    print("|---|---|---|---|---|")


TABLES = {
    "total": (lambda: header("model | technique | variant", "goal"), print_total),
    "footprint": (lambda: header("model | technique | filter, width", "finer"), print_footprint),
    "widths": (lambda: header("model | width / footprint"), print_widths),
    "auto": (auto_header, print_auto),
}


def benches(only: list[str] | None) -> Iterator[tuple[Model, Bench]]:
    for model in error_models.models(only):
        yield model, Bench(model)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--table", choices=TABLES, action="append")
    parser.add_argument(
        "--model", action="append", help="only the one of this name; again for more"
    )
    arguments = parser.parse_args()
    for table in arguments.table or TABLES:
        head, row = TABLES[table]
        head()
        for model, bench in benches(arguments.model):
            row(model, bench)
        print()


if __name__ == "__main__":
    main()
