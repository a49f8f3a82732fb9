"""Every technique on every scene: errors, passes, bytes a texel, time.

    python benchmarks/compare_scenes.py [--only oak] > table.md

What `pyopacity compare` measures, as tables of docs/accuracy_tables.md. Real models are those that
PYOPACITY_DATA has. Figures of a row are those of one technique, layers 16 where it has any.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator

import real_models
from depth_error import DATA

import pyopacity as po
from pyopacity.comparison import Plan, Result, compare

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
HEAD = """| technique | depth | total | image | passes | bytes a texel | maps, ms | frame, ms |
|---|---|---|---|---|---|---|---|"""


def scenes() -> Iterator[tuple[str, po.Scene]]:
    """Name and scene, lit as the tables of errors are."""
    for name in (*SCENES, *(real_models.MODELS if DATA.exists() else ())):
        model = real_models.model(name)
        yield name, po.Scene(model.make(), po.DirectionalLight(model.light))


def line(result: Result) -> str:
    """A row of the table."""
    name = f"`{result.variant.technique}`"
    errors = [f"{e.rmse:.4f}" if e else "-" for e in (result.depth, result.total, result.image)]
    cost = result.cost
    sizes = [f"{cost.passes}", f"{cost.bytes_per_texel:,.0f}"]
    times = [f"{1000 * seconds:.0f}" for seconds in (cost.map_seconds, cost.seconds)]
    return f"| {' | '.join([name, *errors, *sizes, *times])} |"


def main() -> None:
    """Prints a table for each scene."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="scenes whose name holds this")
    only = parser.parse_args().only
    for name, scene in scenes():
        if only not in name:
            continue
        print(f"\n### {name}\n\n{HEAD}", flush=True)
        for result in compare(scene, po.Camera.fit(scene), PLAN):
            print(line(result), flush=True)


if __name__ == "__main__":
    main()
