"""Every technique on every map: how long T at all points of a scene takes, and how wrong it is.

Total error is told over one footprint in the world for all maps, two texels of one of them: what a
finer map knows beyond that does not count as an error, and every look-up is as wide as the
footprint (docs/accuracy.md). Only the papers' techniques as published look up as they did.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from pyopacity import comparison
from pyopacity.benchmark import ways
from pyopacity.benchmark.clock import WHOLE, Parts
from pyopacity.benchmark.figures import front
from pyopacity.benchmark.run import Run, primitives
from pyopacity.benchmark.table import Row, Table
from pyopacity.camera import Camera
from pyopacity.comparison import DepthReference, Truth, Variant, plot, sample_receivers
from pyopacity.comparison.cost import size_of_maps, time_of_look_ups
from pyopacity.comparison.rows import Bench
from pyopacity.comparison.truth import FOOTPRINT_TEXELS, box_width, texel_side
from pyopacity.errors import OutOfMemoryError
from pyopacity.renderer import Renderer

ENGINE, FIXED_SPLIT = "engine", "engine, fixed split"
PAPERS, PUBLISHED = "paper, our deposit", "paper, as published"
_KINDS = (ENGINE, FIXED_SPLIT, PAPERS, PUBLISHED)
_SEED = 0
_ANY_POINT = np.zeros((1, 3))
_NOTE = """T at all points of the scene's shapes, everything anew: seconds, and those of the maps
alone. Depth error: RMSE of T against every fragment of the same map, sorted. Total error: against
rays through the real geometry, over one footprint for all maps. On the front, bold here and joined
in the plot: nothing of the scene, of whatever kind, is both faster and less wrong."""
_FRONT_NOTE = """The rows of time against error that lie on the front of their scene, the fastest
first: what to choose from."""


@dataclass(frozen=True, slots=True)
class _Setting:
    """What a row is about."""

    who: str
    name: str
    variant: Variant


def measure(run: Run) -> Iterator[Table]:
    """A table that grows scene by scene, with a plot each, and one of its fronts."""
    rows: list[Row] = []
    plots: dict[str, str] = {}
    best: list[Row] = []
    for name in run.plan.scenes:
        found = run.once(rows_of, name)
        rows = rows + found
        best = best + _front(found)
        plots = plots | {f"error-over-time-{len(plots) + 1}": _plot(name, found)}
        yield Table("errors", "Time against error", _NOTE, rows, plots)
        yield Table("front", "Pareto fronts", _FRONT_NOTE, best)


def rows_of(run: Run, name: str) -> list[Row]:
    """Of one scene; of the goals' also a split without a search, and the papers' techniques."""
    scene, plan = run.scene(name), run.plan
    receivers = sample_receivers(scene, plan.receivers, _SEED)
    camera = Camera.fit(scene)
    rows: list[Row] = []
    with Renderer(scene, camera, device=plan.device, size=(8, 8)) as renderer:
        footprint = FOOTPRINT_TEXELS * _texel(renderer, plan.judged_px)
        judged = comparison.Plan(samples=plan.rays, device="cpu", footprint=footprint)
        truth = Truth(scene, camera, judged, receivers, lambda what: run.tell(f"{name}: {what}"))
        bench = Bench(judged, renderer, receivers, truth, DepthReference(receivers))
        for map_size in plan.map_sizes_of(primitives(scene)):
            width = box_width(footprint, _texel(renderer, map_size))
            settings = _settings(run, name, width)
            rows += _rows_of_map(run, name, bench, settings)
    measured = [row for row in rows if row["seconds"] is not None]
    costs, errors = ([_number(row, key) for row in measured] for key in ("seconds", "total error"))
    for row, is_best in zip(measured, front(costs, errors), strict=True):
        row["front"] = is_best
    return rows


def _front(rows: list[Row]) -> list[Row]:
    """Rows of one scene, the fastest first, without cells that say nothing there."""
    best = sorted((row for row in rows if row["front"]), key=lambda row: _number(row, "seconds"))
    return [{key: row[key] for key in row if key not in ("front", "note")} for row in best]


def _settings(run: Run, name: str, width: float) -> list[_Setting]:
    """Every technique of the registry with every number of layers, and the papers'."""
    plan = run.plan
    wide = comparison.Plan(layers=plan.layers, parameters={"filter_width": width}).variants()
    settings = [_Setting(ENGINE, _label(variant), variant) for variant in wide]
    if name != plan.hair:
        return settings
    for layers in plan.layers:
        fixed = Variant(
            ways.BOUNDING, {"layers": layers, **ways.FIXED_SPLIT, "filter_width": width}
        )
        settings.append(_Setting(FIXED_SPLIT, _label(fixed), fixed))
        for who, variants in (
            (PAPERS, ways.papers(layers, filter_width=width)),
            (PUBLISHED, ways.published(layers)),
        ):
            settings += [_Setting(who, f"{way}, {layers} layers", v) for way, v in variants]
    return settings


def _label(variant: Variant) -> str:
    """Without the width, which all have alike."""
    own = {k: v for k, v in variant.parameters.items() if k != "filter_width"}
    return Variant(variant.technique, own).label


def _rows_of_map(run: Run, name: str, bench: Bench, settings: list[_Setting]) -> list[Row]:
    """Errors first, then times in turns."""
    rows: dict[str, Row] = {}
    works: dict[str, Callable[[], Parts]] = {}
    for setting in settings:
        key = f"{setting.who}: {setting.name}"
        run.tell(f"{name}, map {bench.renderer.map_size}: errors of {key}")
        try:
            rows[key] = _row(name, bench, setting)
            works[key] = _work(bench, setting.variant)
        except OutOfMemoryError as error:
            rows[key] = _unmeasured(name, bench, setting, error.what)
    run.tell(f"{name}, map {bench.renderer.map_size}: times in turns")
    clock = replace(run.plan.grid_clock, warm_up=0)  # errors asked every setting already
    turns = clock.in_turns(works)
    for key in works:
        rows[key] |= {
            "seconds": turns.median(key),
            "map seconds": turns.median(key, "maps"),
            "rounds": turns.rounds,
        }
    return list(rows.values())


def _row(name: str, bench: Bench, setting: _Setting) -> Row:
    found = bench.errors(setting.variant)
    _, bytes_per_texel = size_of_maps(bench.renderer, bench.receivers.lights)
    return _head(name, bench, setting) | {
        "depth error": found.depth.rmse,
        "total error": found.total.rmse,
        "bias": found.total.bias,
        "bytes a texel": bytes_per_texel,
    }


def _unmeasured(name: str, bench: Bench, setting: _Setting, why: str) -> Row:
    return _head(name, bench, setting) | {"note": why}


def _head(name: str, bench: Bench, setting: _Setting) -> Row:
    """All cells of a row, of which those that are measured are empty."""
    head: Row = {
        "scene": name,
        "primitives": primitives(bench.renderer.scene),
        "of": setting.who,
        "technique": setting.name,
        "map": int(bench.renderer.map_size),
    }
    figures = ("depth error", "total error", "bias", "seconds", "map seconds", "bytes a texel")
    return head | dict.fromkeys((*figures, "rounds")) | {"front": False, "note": ""}


def _work(bench: Bench, variant: Variant) -> Callable[[], Parts]:
    def look_up() -> Parts:
        bench.renderer.technique = variant.make()
        seconds, maps = time_of_look_ups(bench.renderer, bench.receivers)
        return {WHOLE: seconds, "maps": maps}

    return look_up


def _texel(renderer: Renderer, map_size: int) -> float:
    """World units; the renderer has maps of this size then."""
    renderer.map_size = map_size
    renderer.transmittance(_ANY_POINT)
    return texel_side(renderer)


def _plot(name: str, rows: list[Row]) -> str:
    """Total error over time, a colour a technique, a shape a kind; the rows of the front joined."""
    shown = [row for row in rows if row["seconds"] is not None]
    names = list(dict.fromkeys(_technique(row) for row in shown))
    kinds = [who for who in _KINDS if any(row["of"] == who for row in shown)]
    points = [
        plot.Point(
            number,
            f"{row['of']}: {row['technique']}, map {row['map']}",
            names.index(_technique(row)),
            _number(row, "seconds"),
            _number(row, "total error"),
            kinds.index(str(row["of"])),
        )
        for number, row in enumerate(shown, 1)
    ]
    joined = [point for point, row in zip(points, shown, strict=True) if row["front"]]
    points.sort(key=lambda point: -point.kind)  # ours come last, and lie above
    return plot.error_over_time(f"{name}: total error", points, joined, names, kinds)


def _technique(row: Row) -> str:
    """Its name in the registry; the papers' rows have those of the papers."""
    name = str(row["technique"])
    way = ways.PAPERS.get(name.rpartition(", ")[0])
    return name.partition(",")[0] if way is None else way.technique


def _number(row: Row, key: str) -> float:
    value = row[key]
    assert isinstance(value, float)
    return value
