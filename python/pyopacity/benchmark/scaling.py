"""How the time of the maps grows with segments, texels, layers and lights: fitted exponents."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack

from pyopacity.benchmark import ways
from pyopacity.benchmark.clock import Turns, all_maps
from pyopacity.benchmark.figures import exponent
from pyopacity.benchmark.run import Run
from pyopacity.benchmark.table import Row, Table
from pyopacity.comparison import Variant, plot
from pyopacity.light import DirectionalLight
from pyopacity.renderer import Renderer
from pyopacity.scene import Scene
from pyopacity.technique import EXACT

_NOTE = """Seconds to make the light's maps from nothing, of demo:hair; the exponent p of time =
c size^p, by least squares of the logarithms. 1 is linear, 0 free."""
Make = Callable[[int, Variant], Renderer]


def measure(run: Run) -> Iterator[Table]:
    """A table that grows axis by axis, with a plot each."""
    rows: list[Row] = []
    plots: dict[str, str] = {}
    for axis, sizes, make in _axes(run):
        run.tell(f"scaling: {axis}")
        series: dict[str, list[tuple[float, float]]] = {}
        for name, variant in _variants(run, has_layers=axis == "layers").items():
            turns = _turns(run, sizes, make, variant)
            seconds = [turns.median(str(size)) for size in sizes]
            series[name] = [(float(a), b) for a, b in zip(sizes, seconds, strict=True)]
            rows.append(_row(axis, name, sizes, seconds, turns.rounds))
        plots[f"scaling-{axis}"] = plot.lines(f"seconds by {axis}", "", series)
        yield Table("scaling", "Scaling", _NOTE, list(rows), dict(plots))


def _row(axis: str, name: str, sizes: Sequence[int], seconds: list[float], rounds: int) -> Row:
    return {
        "what grows": axis,
        "technique": name,
        "from": sizes[0],
        "to": sizes[-1],
        "seconds at first": seconds[0],
        "seconds at last": seconds[-1],
        "exponent": exponent(sizes, seconds),
        "rounds": rounds,
    }


def _turns(run: Run, sizes: Sequence[int], make: Make, variant: Variant) -> Turns:
    with ExitStack() as stack:
        renderers = {size: stack.enter_context(make(size, variant)) for size in sizes}
        return run.plan.grid_clock.in_turns({str(s): all_maps(r) for s, r in renderers.items()})


def _variants(run: Run, has_layers: bool) -> dict[str, Variant]:
    """Ours with a split that is fixed, and searched, and adaptive; and the exact lists."""
    found = {
        ways.BOUNDING_FIXED: Variant(ways.BOUNDING, dict(ways.FIXED_SPLIT)),
        ways.BOUNDING: Variant(ways.BOUNDING, {}),
        ways.ADAPTIVE: Variant(ways.ADAPTIVE, {}),
    }
    return found if has_layers else {**found, EXACT: Variant(EXACT, {})}


def _axes(run: Run) -> Iterator[tuple[str, Sequence[int], Make]]:
    """What grows, in which steps, and the renderer of each."""
    plan, goals = run.plan, run.plan.goals
    middle = plan.scaled_segments[len(plan.scaled_segments) // 2]

    def renderer(scene: Scene, variant: Variant, map_size: int = goals.map_size) -> Renderer:
        technique = variant.make()
        return Renderer(scene, device=plan.device, technique=technique, map_size=map_size)

    def lit(lights: int, variant: Variant) -> Renderer:
        shapes = run.hair(middle).shapes
        scene = Scene(shapes, [DirectionalLight((0.5, 0.3, -0.8 - 0.1 * i)) for i in range(lights)])
        return renderer(scene, variant)

    def layered(layers: int, variant: Variant) -> Renderer:
        more = {**variant.parameters, "layers": layers}
        return renderer(run.hair(middle), Variant(variant.technique, more))

    yield "segments", plan.scaled_segments, lambda n, v: renderer(run.hair(n), v)
    texels = plan.scaled_map_sizes
    yield "texels", [n * n for n in texels], lambda n, v: renderer(run.hair(middle), v, _root(n))
    yield "layers", plan.scaled_layers, layered
    yield "lights", plan.scaled_lights, lit


def _root(square: int) -> int:
    return math.isqrt(square)
