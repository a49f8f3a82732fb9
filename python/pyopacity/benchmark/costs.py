"""What each technique holds of memory, and what each of its passes takes."""

from __future__ import annotations

from collections.abc import Iterator

from pyopacity import comparison
from pyopacity.benchmark.clock import WHOLE, all_maps
from pyopacity.benchmark.run import Run, primitives
from pyopacity.benchmark.table import Row, Table
from pyopacity.comparison import Variant, sample_receivers
from pyopacity.comparison.cost import size_of_maps
from pyopacity.renderer import Renderer

_PASSES = """Every pass of the maps of the goals' scene, made from nothing: seconds, the part of all
passes of the technique, draw calls and dispatches (none without OpenGL). The engine waits until
the device is done after each pass."""
_MEMORY = """What the maps hold, with what passes hand to each other: bytes for each of their
texels; and everything that the last question needed, in MiB."""


def measure(run: Run) -> Iterator[Table]:
    """Two tables that grow technique by technique."""
    passes: list[Row] = []
    memory: list[Row] = []
    for variant in comparison.Plan(layers=(run.plan.goals.layers,)).variants():
        run.tell(f"cost of {variant.label}")
        timed, held = _of(run, variant)
        passes, memory = passes + timed, [*memory, held]
        yield Table("passes", "Cost of each pass", _PASSES, passes)
        yield Table("memory", "Memory", _MEMORY, memory)


def _of(run: Run, variant: Variant) -> tuple[list[Row], Row]:
    plan, name = run.plan, run.plan.hair
    scene = run.scene(name)
    map_size = plan.goals.map_size
    head: Row = {
        "scene": name,
        "primitives": primitives(scene),
        "map": map_size,
        "technique": variant.label,
    }
    technique = variant.make()
    with Renderer(scene, device=plan.device, technique=technique, map_size=map_size) as renderer:
        turns = plan.grid_clock.in_turns({"": all_maps(renderer)})
        calls = {row.name: row.calls for row in renderer.report}
        whole = turns.median("")
        rows = [
            head
            | {
                "pass": part,
                "seconds": turns.median("", part),
                "part": turns.median("", part) / whole if whole > 0.0 else 0.0,
                "calls": calls.get(part, 0),
                "rounds": turns.rounds,
            }
            for part in turns.parts("")
            if part != WHOLE
        ]
        receivers = sample_receivers(scene, 1, 0)
        count, bytes_per_texel = size_of_maps(renderer, receivers.lights)
        held = sum(resource.bytes for resource in renderer.memory())
    return rows, head | {
        "passes": count,
        "bytes a texel": bytes_per_texel,
        "MiB": held / 2**20,
    }
