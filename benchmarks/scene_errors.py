"""Total error on everything that a scene holds, by what receives: T of maps against rays.

    python benchmarks/scene_errors.py [--table models] [--only oak] > tables.md

Prints tables of docs/accuracy_tables.md: generated and real models under one light, and small
scenes of each kind of caster under each kind of light. Real ones are those that PYOPACITY_DATA has.
Maps are the CPU's, so no OpenGL is needed.
"""

from __future__ import annotations

import argparse
import itertools
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import numpy.typing as npt
import real_models
import small_scenes
from real_models import Model
from total_error import TECHNIQUES, cell

import pyopacity as po
from pyopacity.comparison import Plan, Receivers, sample_receivers
from pyopacity.comparison.truth import FOOTPRINT_TEXELS, Truth
from pyopacity.metrics import Errors

MAP_SIZE, RECEIVERS, RAYS, SEED = 512, 1000, 64, 0  # receivers of each kind, rays of each
GOAL = 0.05
DEMOS = (
    "demo:hair?segments=60000",
    "demo:grass?segments=40000",
    "demo:tree?leaves=10000",
    "demo:smoke?voxels=100000",
    "demo:clouds?voxels=200000",
    "demo:plume?particles=8000",
    "demo:mixed?primitives=40000",
)
GROUND_CELLS = 80


# ---- what receives ----


def kind_of(shape: po.Shape) -> str:
    """What the tables call it."""
    if isinstance(shape, po.Mesh):
        return "leaves" if not shape.opaque else "bodies" if shape.casts else "ground"
    return {po.Strands: "strands", po.Particles: "particles", po.Volume: "voxels"}[type(shape)]


def receivers_by_kind(scene: po.Scene) -> dict[str, Receivers]:
    """Some of each kind, so that none is lost among many of another."""
    found = {}
    for kind in dict.fromkeys(map(kind_of, scene.shapes)):
        for shape in scene.shapes:
            shape.receives = kind_of(shape) == kind
        if kind == "voxels":
            found[kind] = filled(sample_receivers(scene, 20 * RECEIVERS, SEED))
        else:
            found[kind] = sample_receivers(scene, RECEIVERS, SEED)
    for shape in scene.shapes:
        shape.receives = True
    return found


def filled(voxels: Receivers) -> Receivers:
    """Those that hold something, which alone are seen; at most as many as of other kinds."""
    parts = [shape.extinction.ravel()[own] > 0.0 for shape, own in voxels.chosen]
    kept = np.flatnonzero(np.concatenate(parts))
    kept = np.sort(np.random.default_rng(SEED).permutation(kept)[:RECEIVERS])
    return subset(voxels, kept)


def subset(found: Receivers, kept: npt.NDArray[np.int64]) -> Receivers:
    """Of these indices, which ascend."""
    chosen, first = [], 0
    for shape, own in found.chosen:
        here = kept[(kept >= first) & (kept < first + len(own))] - first
        first += len(own)
        if len(here):
            chosen.append((shape, own[here]))
    columns = {name: getattr(found, name)[kept] for name in ("points", "normals", "bias")}
    return replace(found, chosen=chosen, **columns)


def ground_below(casters: list[po.Shape], model: Model) -> po.Mesh:
    """A fine square that holds their shadow."""
    box = po.Bounds.union(shape.bounds for shape in casters)
    level, light = model.level(casters), np.array(model.light)
    corners = np.array(list(itertools.product(*zip(box.min, box.max, strict=True))))
    shadow = corners + (level - corners[:, [model.up]]) / light[model.up] * light
    middle = 0.5 * (shadow.min(axis=0) + shadow.max(axis=0))
    half = 0.5 * float(np.ptp(shadow, axis=0).max())
    x, y, z = middle.tolist()
    return real_models.ground((x, y, z), half, model.up, GROUND_CELLS)


# ---- errors ----


def errors(scene: po.Scene) -> dict[str, list[Errors]]:
    """For each kind of receiver: of each technique."""
    plan = Plan(samples=RAYS, device="cpu")
    camera = po.Camera.look_at((1, 0, 0), (0, 0, 0))  # no picture is made
    kinds = receivers_by_kind(scene)
    truths = {k: Truth(scene, camera, plan, found, lambda _: None) for k, found in kinds.items()}
    result: dict[str, list[Errors]] = {kind: [] for kind in kinds}
    with po.Renderer(scene, device="cpu", map_size=MAP_SIZE) as renderer:
        for name, parameters in TECHNIQUES.items():
            renderer.technique = po.technique(name, **parameters)
            for kind, receivers in kinds.items():
                T = receivers.transmittance(renderer)
                sides = FOOTPRINT_TEXELS * receivers.texel_sides(renderer)
                truth = truths[kind].transmittance(sides, None)
                result[kind].append(po.metrics.errors(T, truth))
    return result


def verdict(found: list[Errors]) -> str:
    worst = max(one.rmse for one in found)
    return "holds" if worst <= GOAL else f"misses, {worst:.3f}"


# ---- tables ----


def models(only: list[str] | None) -> Iterator[tuple[str, po.Scene]]:
    """Each under its light, on a ground."""
    for name in [*DEMOS, *real_models.MODELS]:
        short = name.partition("?")[0]
        if only and short not in only:
            continue
        model = real_models.model(name)
        try:
            casters = [shape for shape in model.make() if shape.casts]
        except po.FileFormatError:
            continue
        shapes = [*casters, ground_below(casters, model)]
        yield short, po.Scene(shapes, po.DirectionalLight(model.light))


def small_scene(caster: po.Shape, light: po.Light) -> po.Scene:
    """On a ground that holds its shadow under all of the lights."""
    below = real_models.ground(small_scenes.BELOW, 3.0, real_models.Z_UP, GROUND_CELLS)
    return po.Scene([caster, below], light)


def print_models(only: list[str] | None) -> None:
    print(
        "| model | receivers | " + " | ".join(f"`{name}`" for name in TECHNIQUES) + f" | {GOAL} |"
    )
    print("|---|---|" + "---|" * (len(TECHNIQUES) + 1))
    for name, scene in models(only):
        for kind, found in errors(scene).items():
            cells = " | ".join(map(cell, found))
            print(f"| {name} | {kind} | {cells} | {verdict(found)} |", flush=True)


def print_lights(only: list[str] | None) -> None:
    print("| casters | receivers | technique | " + " | ".join(small_scenes.LIGHTS) + f" | {GOAL} |")
    print("|---|---|---|" + "---|" * (len(small_scenes.LIGHTS) + 1))
    for name, make in small_scenes.CASTERS.items():
        if only and name not in only:
            continue
        table = [errors(small_scene(make(), light)) for light in small_scenes.LIGHTS.values()]
        for kind, (i, technique) in itertools.product(table[0], enumerate(TECHNIQUES)):
            row = [column[kind][i] for column in table]
            cells = " | ".join(map(cell, row))
            print(f"| {name} | {kind} | `{technique}` | {cells} | {verdict(row)} |", flush=True)


TABLES = {"models": print_models, "lights": print_lights}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--table", choices=TABLES, action="append")
    parser.add_argument("--only", action="append", help="the one of this name; again for more")
    arguments = parser.parse_args()
    for table in arguments.table or TABLES:
        TABLES[table](arguments.only)
        print()


if __name__ == "__main__":
    main()
