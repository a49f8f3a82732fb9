"""One ray a vertex through the real geometry, which counts every hit: Embree, if it is there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from pyopacity import metrics
from pyopacity.benchmark.clock import Turns, timed
from pyopacity.benchmark.run import Run, hair_of, strands_of
from pyopacity.look_up import transmittance
from pyopacity.trace import trace_backends, trace_transmittance

MAPS, RAYS = "maps", "rays"


@dataclass(frozen=True, slots=True)
class Rays:
    """T at every vertex of demo:hair, by maps without OpenGL and by rays; both from nothing.

    Attributes:
        where: the scene and the map.
        backend: what found the hits.
        vertices: how many.
        turns: of "maps" and "rays".
        difference: RMSE of the two, of which the maps' texels are the larger part.
    """

    where: str
    backend: str
    vertices: int
    turns: Turns
    difference: float


def measure(run: Run) -> Rays:
    """Both take turns, and have all cores."""
    goals = run.plan.goals
    scene = run.hair(goals.look_up_segments)
    hair = strands_of(scene)
    found: dict[str, npt.NDArray[np.float32]] = {}

    def look_up() -> None:
        found[MAPS] = transmittance(scene, hair, map_size=goals.map_size)

    def trace() -> None:
        found[RAYS] = trace_transmittance(scene, hair, footprint=0.0)

    run.tell(f"rays from every vertex of {hair_of(goals.look_up_segments)}")
    turns = run.plan.clock.in_turns({MAPS: timed(look_up), RAYS: timed(trace)})
    return Rays(
        where=f"{hair_of(goals.look_up_segments)}, map {goals.map_size}, without OpenGL",
        backend=trace_backends()[0],
        vertices=len(hair.points),
        turns=turns,
        difference=metrics.rmse(found[MAPS], found[RAYS]),
    )
