"""P6 and P7: what the papers' techniques need of time, and err, beside ours."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from pyopacity import metrics
from pyopacity.benchmark import time_against_error, ways
from pyopacity.benchmark.goals.goal import Goal, quotient
from pyopacity.benchmark.run import Run
from pyopacity.benchmark.table import Row
from pyopacity.benchmark.time_against_error import ENGINE, FIXED_SPLIT, PAPERS, PUBLISHED
from pyopacity.comparison import DepthReference, Receivers, Variant, sample_receivers
from pyopacity.renderer import Renderer

TIME = Goal("P6", "time to total error .04, our best / the papers' best with our deposit", 0.2)
ERROR = Goal("P6", "total error, our best / the papers' best as published", 0.4)
EQUAL_LAYERS = Goal("P7", "depth error at equal layers, ours / the papers' best", 0.35)
EQUAL_BYTES = Goal("P7", "depth error at equal bytes, ours / the papers' best", 0.5)
TOTAL_ERROR = 0.04
_LAYERS = (8, 16)
_RECEIVERS, _SEED = 20_000, 0


# ---- P6 ----


def total(run: Run) -> Iterator[Row]:
    """Both parts of P6."""
    rows = run.once(time_against_error.rows_of, run.plan.hair)
    plan = run.plan
    where = f"{plan.hair}, maps {_list(plan.map_sizes)}, layers {_list(plan.layers)}, {plan.device}"
    ours = [
        row
        for row in rows
        if row["of"] in (ENGINE, FIXED_SPLIT)
        and str(row["technique"]).partition(",")[0] in ways.OURS
    ]
    yield _time(where, ours, [row for row in rows if row["of"] == PAPERS])
    yield _least_error(where, ours, [row for row in rows if row["of"] == PUBLISHED])


def _time(where: str, ours: Sequence[Row], theirs: Sequence[Row]) -> Row:
    """Of the fastest that err little enough."""
    fastest = []
    for whose, rows in (("ours", ours), ("theirs", theirs)):
        if not (measured := _measured(rows)):
            return TIME.not_measured(where, _none(whose, rows))
        good = [row for row in measured if _of(row, "total error") <= TOTAL_ERROR]
        if not good:
            least = _told(_least(measured))
            why = f"none of {whose} errs by {TOTAL_ERROR} or less: {least}"
            return TIME.not_measured(where, why)
        fastest.append(min(good, key=lambda row: _of(row, "seconds")))
    rounds = min(int(row["rounds"] or 0) for row in fastest)
    own, other = fastest
    ratio = quotient(_of(own, "seconds"), _of(other, "seconds"))
    return TIME.measured(ratio, where, rounds, f"{_told(own)}; {_told(other)}")


def _least_error(where: str, ours: Sequence[Row], theirs: Sequence[Row]) -> Row:
    """Of the least that either errs by, however long it takes."""
    least = []
    for whose, rows in (("ours", ours), ("theirs", theirs)):
        if not (measured := _measured(rows)):
            return ERROR.not_measured(where, _none(whose, rows))
        least.append(_least(measured))
    own, other = least
    ratio = quotient(_of(own, "total error"), _of(other, "total error"))
    return ERROR.measured(ratio, where, 1, f"{_told(own)}; {_told(other)}")


def _measured(rows: Sequence[Row]) -> list[Row]:
    return [row for row in rows if row["seconds"] is not None]


def _none(whose: str, rows: Sequence[Row]) -> str:
    notes = dict.fromkeys(str(row["note"]) for row in rows)
    return f"none of {whose} could be measured: {'; '.join(notes)}"


def _least(rows: Sequence[Row]) -> Row:
    return min(rows, key=lambda row: _of(row, "total error"))


def _of(row: Row, key: str) -> float:
    value = row[key]
    assert isinstance(value, float)
    return value


def _told(row: Row) -> str:
    error, seconds = _of(row, "total error"), _of(row, "seconds")
    return f"{row['technique']}, map {row['map']}: error {error:.4f}, {seconds:.3f} s"


def _list(numbers: Sequence[int]) -> str:
    return "/".join(map(str, numbers))


# ---- P7 ----


def depth(run: Run) -> Iterator[Row]:
    """P7, of two numbers of layers."""
    plan = run.plan
    scene = run.scene(plan.hair)
    receivers = sample_receivers(scene, _RECEIVERS, _SEED)
    reference = DepthReference(receivers)
    map_size = plan.goals.map_size
    with Renderer(scene, device=plan.device, map_size=map_size) as renderer:
        for layers in _LAYERS:
            run.tell(f"depth errors of {layers} layers")
            ours = _error(
                renderer, receivers, reference, Variant(ways.ADAPTIVE, {"layers": layers})
            )
            for goal, count in (
                (EQUAL_LAYERS, layers),
                (EQUAL_BYTES, ways.PUBLISHED_A_LAYER * layers),
            ):
                theirs = {
                    name: _error(renderer, receivers, reference, variant)
                    for name, variant in ways.papers(count)
                }
                best = min(theirs, key=theirs.__getitem__)
                where = f"{plan.hair}, map {map_size}, {layers} layers of ours, {count} of theirs"
                note = f"{ours:.4f} / {theirs[best]:.4f} of {best}"
                yield goal.measured(quotient(ours, theirs[best]), where, 1, note)


def _error(
    renderer: Renderer, receivers: Receivers, reference: DepthReference, variant: Variant
) -> float:
    exact = reference.of(renderer, variant)
    renderer.technique = variant.make()
    return metrics.rmse(receivers.transmittance(renderer), exact)
