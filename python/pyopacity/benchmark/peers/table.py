"""The peers in one table: what each took for the same T, or picture, and how far apart they are."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import numpy.typing as npt

from pyopacity import metrics
from pyopacity.benchmark.clock import Turns, timed
from pyopacity.benchmark.peers import mitsuba, rays
from pyopacity.benchmark.peers.brute_force import Segments
from pyopacity.benchmark.run import LIGHT, Run, hair_of, strands_of
from pyopacity.benchmark.table import Row, Table
from pyopacity.light import DirectionalLight
from pyopacity.look_up import transmittance
from pyopacity.scene import Scene
from pyopacity.trace import trace_transmittance

_NOTE = """Others in the same run, on the same cores: seconds, theirs over ours, and the RMSE
between the two. Where ours are maps, most of it is their texels; where both are rays, it is whether
they agree."""
_BRUTE, _MAPS, _RAYS = "numpy", "maps", "rays"


def measure(run: Run) -> Iterator[Table]:
    """A row each; what is not installed says how to get it."""
    rows: list[Row] = []
    for row in _rows(run):
        rows = [*rows, row]
        yield Table("peers", "Peers", _NOTE, rows)


def _rows(run: Run) -> Iterator[Row]:
    yield from _brute_force(run)
    found = run.once(rays.measure)
    yield _row(
        f"{found.backend}, one ray a vertex",
        "maps without OpenGL",
        found.where,
        (found.turns, rays.RAYS, rays.MAPS),
        found.difference,
    )
    if (why := mitsuba.missing(run)) is None:
        pictures = run.once(mitsuba.measure)
        turns = (pictures.turns, mitsuba.THEIRS, mitsuba.OURS)
        yield _row("Mitsuba 3, volpath", "a picture", pictures.where, turns, pictures.difference)
    else:
        yield _row("Mitsuba 3, volpath", "a picture", run.plan.hair, None, None, why)


def _brute_force(run: Run) -> Iterator[Row]:
    """Every ray against every segment, beside rays and maps."""
    segments = run.plan.brute_force_segments
    run.tell(f"numpy goes through {hair_of(segments)}")
    hair = strands_of(run.hair(segments))
    scene = Scene(hair, DirectionalLight(LIGHT))
    toward = -np.asarray(LIGHT) / np.linalg.norm(LIGHT)
    bias = float(np.mean(hair.width))
    points = np.asarray(hair.points, np.float64)
    by_numpy = Segments(hair, toward)
    map_size = run.plan.goals.map_size
    works: dict[str, Callable[[], npt.NDArray[np.floating[Any]]]] = {
        _BRUTE: lambda: by_numpy.transmittance(points, bias),
        _RAYS: lambda: trace_transmittance(scene, hair, bias=bias),
        _MAPS: lambda: transmittance(scene, hair, map_size=map_size),
    }
    found = {name: work() for name, work in works.items()}
    turns = run.plan.clock.in_turns({name: timed(work) for name, work in works.items()})
    where = f"{hair_of(segments)} alone"
    for ours in (_RAYS, _MAPS):
        told, difference = (turns, _BRUTE, ours), metrics.rmse(found[ours], found[_BRUTE])
        yield _row("numpy, brute force", f"{ours}, without OpenGL", where, told, difference)


def _row(
    peer: str,
    ours: str,
    where: str,
    timed_as: tuple[Turns, str, str] | None,
    difference: float | None,
    note: str = "",
) -> Row:
    row: Row = {"peer": peer, "ours": ours, "where": where}
    row |= dict.fromkeys(("peer, s", "ours, s", "peer / ours", "rounds"))
    if timed_as is not None:
        turns, theirs, own = timed_as
        seconds = turns.median(theirs), turns.median(own)
        row |= {
            "peer, s": seconds[0],
            "ours, s": seconds[1],
            "peer / ours": turns.ratio(theirs, own),
            "rounds": turns.rounds,
        }
    return row | {"difference, RMSE": difference, "note": note and f"not measured: {note}"}
