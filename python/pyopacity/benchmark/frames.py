"""Frames of every technique, as ratios to the same frame without shadows."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack

from pyopacity import comparison
from pyopacity.benchmark import ways
from pyopacity.benchmark.clock import WHOLE, Parts, Turns, seconds_of
from pyopacity.benchmark.run import Run, hair_of
from pyopacity.benchmark.table import Row, Table
from pyopacity.camera import Camera
from pyopacity.comparison import Variant
from pyopacity.comparison.cost import makes_maps
from pyopacity.renderer import Renderer
from pyopacity.scene import Scene
from pyopacity.shapes import PointShape
from pyopacity.technique import UNSHADOWED

NEEDS_OPENGL = "pictures need OpenGL"
CAMERA, NOTHING, MAPS, SEARCH = "camera", "nothing", "maps", "passes of a search"
LINEAR = f"{ways.BOUNDING_FIXED}, linear"  # as in the thesis, but for the deposit
# For scenes in which only the camera moves.
ALONG_STRANDS = f"{ways.BOUNDING_FIXED}, T along strands"
_OF_A_SEARCH = ("histogram", "sampled_", "split_search")  # what names start with
_TURN = 0.002  # of the camera's place, from frame to frame, in sides of the scene
_NOTE = """Everything: before each frame, with shadows or without, the points of every caster are
assigned again, so that uploads, the fit of the light's map and all passes are done anew; over the
same without shadows. The assignment itself is not timed: it is the same for both. Camera: only the
camera moves. Unchanged: nothing does. Pictures are opaque, so that the shadow is all that differs,
and each is brought back to the CPU."""


def measure(run: Run) -> Iterator[Table]:
    """A table that grows scene by scene; without OpenGL the reason why there are no frames."""
    rows: list[Row] = []
    for segments in run.plan.goals.segments:
        rows = [*rows, *_rows(run, segments)]
        yield Table("frames", "Frames", _NOTE, rows)


def _rows(run: Run, segments: int) -> Iterator[Row]:
    head: Row = {"scene": hair_of(segments), "map": run.plan.goals.map_size}
    if run.plan.device == "cpu":
        yield head | {"note": f"not measured: {NEEDS_OPENGL}"}
        return
    turns = run.once(turns_of, segments)
    for name in _variants(run):
        yield head | {
            "technique": name,
            "everything": turns.ratio(name, UNSHADOWED),
            "camera moves": turns.ratio(name, UNSHADOWED, CAMERA),
            "unchanged, ms": 1000.0 * turns.median(name, NOTHING),
            "maps, ms": 1000.0 * turns.median(name, MAPS),
            "frame, ms": 1000.0 * turns.median(name),
            "rounds": turns.rounds,
        }


def where(run: Run, segments: int) -> str:
    """On what frames are measured."""
    goals = run.plan.goals
    width, height = goals.size
    return f"{hair_of(segments)}, map {goals.map_size}, {width}x{height}, opaque"


def turns_of(run: Run, segments: int) -> Turns:
    """Frames of every technique by its name, and of bounding opacity maps without a search."""
    run.tell(f"frames of {where(run, segments)}")
    scene, goals = run.hair(segments), run.plan.goals
    with ExitStack() as stack:
        works: dict[str, Callable[[], Parts]] = {}
        for name, variant in _variants(run).items():
            renderer = Renderer(
                scene,
                technique=variant.make(),
                size=goals.size,
                map_size=goals.map_size,
                compositing="opaque",
                strand_look_up="along_strands" if name == ALONG_STRANDS else "auto",
            )
            works[name] = _frames(stack.enter_context(renderer), scene)
        return run.plan.clock.in_turns(works)


def _variants(run: Run) -> dict[str, Variant]:
    layers = run.plan.goals.layers
    found = {v.technique: v for v in comparison.Plan(layers=(layers,)).variants()}
    fixed = {"layers": layers, **ways.FIXED_SPLIT}
    return found | {
        ways.BOUNDING_FIXED: Variant(ways.BOUNDING, fixed),
        ALONG_STRANDS: Variant(ways.BOUNDING, fixed),
        LINEAR: Variant(ways.BOUNDING, fixed | ways.LINEAR),
    }


def _frames(renderer: Renderer, scene: Scene) -> Callable[[], Parts]:
    """All casters moved, then the camera alone, then nothing."""
    frame = 0
    touch = touching(scene)

    def passes(wanted: Callable[[str], bool]) -> float:
        return sum(row.ms for row in renderer.report if wanted(row.name)) / 1000.0

    def draw() -> Parts:
        nonlocal frame
        touch()
        found = {WHOLE: seconds_of(renderer.render)}
        found[MAPS] = passes(makes_maps)
        found[SEARCH] = passes(lambda name: name.rpartition("/")[2].startswith(_OF_A_SEARCH))
        frame += 1
        renderer.camera = _camera(scene, frame)
        found[CAMERA] = seconds_of(renderer.render)
        found[NOTHING] = seconds_of(renderer.render)
        return found

    return draw


def touching(scene: Scene) -> Callable[[], None]:
    """What makes every caster one that moved: its points, which stay what they are, set again."""
    casters = [(s, s.points) for s in scene.shapes if s.casts and isinstance(s, PointShape)]

    def touch() -> None:
        for shape, points in casters:
            shape.points = points

    return touch


def _camera(scene: Scene, frame: int) -> Camera:
    """One that moves a little to the side."""
    low, high = scene.bounds.min, scene.bounds.max
    x, y, z = ((a + b) / 2.0 for a, b in zip(low, high, strict=True))
    reach = max(b - a for a, b in zip(low, high, strict=True))
    eye = (x + (0.3 + _TURN * frame) * reach, y - 1.6 * reach, z + 0.4 * reach)
    return Camera.look_at(eye, (x, y, z))
