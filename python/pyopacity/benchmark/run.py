"""A plan under way, and what its sections share: scenes, and what was measured already."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from pyopacity.benchmark.machine import Machine, this_machine
from pyopacity.benchmark.plan import Plan
from pyopacity.errors import ParameterError
from pyopacity.io import load
from pyopacity.light import DirectionalLight
from pyopacity.scene import Scene
from pyopacity.shapes import Mesh, Particles, PointShape, Strands, Volume

LIGHT = (0.5, 0.3, -0.8)
Found = TypeVar("Found")
Progress = Callable[[str], object]


class Run:
    """What is measured once, however many sections ask for it."""

    def __init__(self, plan: Plan, tell: Progress = lambda _: None) -> None:
        """
        Args:
            plan: what to measure.
            tell: told in words what is being done.
        """
        self.plan, self.tell = plan, tell
        self.machine: Machine = this_machine()
        self._found: dict[Any, Any] = {}

    def once(self, measure: Callable[..., Found], *arguments: Any) -> Found:
        """What ``measure(self, *arguments)`` finds; measured when it is asked for first."""
        key = (measure, *arguments)
        if key not in self._found:
            self._found[key] = measure(self, *arguments)
        found: Found = self._found[key]
        return found

    def scene(self, name: str) -> Scene:
        """Of a file or a generated one, under the light of all benchmarks."""
        return self.once(_scene, name)

    def hair(self, segments: int) -> Scene:
        """demo:hair with so many segments."""
        return self.scene(hair_of(segments))


def hair_of(segments: int) -> str:
    """The name of demo:hair with so many segments."""
    return f"demo:hair?segments={segments}"


def primitives(scene: Scene) -> int:
    """Segments, triangles, particles and voxels of what casts."""
    return sum(_primitives(shape) for shape in scene.shapes if shape.casts)


def has_strands(scene: Scene) -> bool:
    """Whether :func:`strands_of` finds any."""
    return any(isinstance(shape, Strands) for shape in scene.shapes)


def strands_of(scene: Scene) -> Strands:
    """The first strands.

    Raises:
        ParameterError: there are none.
    """
    for shape in scene.shapes:
        if isinstance(shape, Strands):
            return shape
    raise ParameterError("the scene has no strands", "measure the goals on a file with strands")


def _scene(run: Run, name: str) -> Scene:
    run.tell(f"loading {name}")
    shapes = load(name)
    for shape in shapes:
        if isinstance(shape, Strands):
            for attribute, value in run.plan.changes.items():
                setattr(shape, attribute, value)
    return Scene(shapes, DirectionalLight(LIGHT))


def _primitives(shape: object) -> int:
    if isinstance(shape, Strands):
        return len(shape.points) - (len(shape.offsets) - 1)
    if isinstance(shape, Mesh):
        return len(shape.triangles)
    if isinstance(shape, Volume):
        z, y, x = shape.extinction.shape[:3]
        return int(z * y * x)
    assert isinstance(shape, Particles | PointShape)
    return len(shape.points)
