"""Every technique on every scene: errors, passes, bytes a texel, time.

    python benchmarks/compare_scenes.py [--only oak] > table.md

What `pyopacity compare` measures, as the tables of docs/comparison.md. Real models are those that
PYOPACITY_DATA has. Layers are 16 where a technique has any.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable, Iterator

import real_models
from depth_error import DATA

import pyopacity as po
from pyopacity.comparison import Plan, Result, compare
from pyopacity.technique import EXACT

SCENES = (
    "demo:hair?segments=60000",
    "demo:fur?segments=60000",
    "demo:grass?segments=40000",
    "demo:tree?leaves=10000",
    "demo:plume?particles=8000",
    "demo:smoke?voxels=100000",
    "demo:mixed?primitives=40000",
)
PLAN = Plan(receivers=4000, samples=16, image_size=(160, 120), image_samples=2)
TABLES: dict[str, Callable[[Result, Result], str]] = {
    "Depth error": lambda row, _: f"{row.depth.rmse:.4f}",
    "Total error": lambda row, _: f"{row.total.rmse:.4f}",
    "Image error": lambda row, _: f"{row.image.rmse:.4f}" if row.image else "-",
    "Time of the maps, `exact` = 1": lambda row, exact: (
        f"{row.cost.map_seconds / exact.cost.map_seconds:.2f}"
    ),
    "Passes": lambda row, _: f"{row.cost.passes}",
    "Bytes a texel": lambda row, _: f"{row.cost.bytes_per_texel:,.0f}",
}


def scenes() -> Iterator[tuple[str, po.Scene]]:
    """Name and scene, lit as the tables of errors are."""
    for name in (*SCENES, *(real_models.MODELS if DATA.exists() else ())):
        model = real_models.model(name)
        yield name, po.Scene(model.make(), po.DirectionalLight(model.light))


def line(first: str, cells: Iterable[str]) -> str:
    """A row of a table."""
    return f"| {' | '.join([first, *cells])} |"


def main() -> None:
    """Prints a table for each figure, once all is measured."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="scenes whose name holds this")
    only = parser.parse_args().only
    found: dict[str, dict[str, Result]] = {}
    for name, scene in scenes():
        if only in name:
            print(f"measuring {name}", file=sys.stderr, flush=True)
            results = compare(scene, po.Camera.fit(scene), PLAN)
            found[name] = {result.variant.technique: result for result in results}
    for title, cell in TABLES.items():
        print(f"\n## {title}\n")
        print(line("scene", (f"`{name}`" for name in po.techniques())))
        print(line("---", ("---" for _ in po.techniques())))
        for name, rows in found.items():
            print(line(name, (cell(row, rows[EXACT]) for row in rows.values())))


if __name__ == "__main__":
    main()
