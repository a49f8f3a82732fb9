"""Skipped passes, forced."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from pyopacity.light import DirectionalLight, PointLight
from pyopacity.scene import Scene
from pyopacity.shapes import Mesh, Particles, Shape, Strands, Volume
from pyopacity.stress.bench import Bench
from pyopacity.stress.case import Finding, case, wrong
from pyopacity.stress.shapes import random_shapes
from pyopacity.stress.way import ALL, Way

Change = Callable[[np.random.Generator, Scene], object]


def _one(random: np.random.Generator, scene: Scene) -> Shape:
    return scene.shapes[random.integers(len(scene.shapes))]


def _move(random: np.random.Generator, scene: Scene) -> None:
    matrix = np.eye(4)
    matrix[:3, :3] += random.normal(0.0, 0.2, (3, 3))
    matrix[:3, 3] = random.uniform(-0.3, 0.3, 3)
    _one(random, scene).transform = matrix


def _bend(random: np.random.Generator, scene: Scene) -> None:
    shape = _one(random, scene)
    if isinstance(shape, Strands | Mesh | Particles):
        shape.points = shape.points + random.normal(0.0, 0.05, shape.points.shape)


def _fade(random: np.random.Generator, scene: Scene) -> None:
    shape = _one(random, scene)
    if isinstance(shape, Volume):
        shape.extinction = shape.extinction * float(random.uniform(0.2, 1.5))
    elif isinstance(shape, Strands | Mesh | Particles):
        shape.opacity = float(random.choice([0.0, 0.3, 0.8, 1.0]))


def _hide(random: np.random.Generator, scene: Scene) -> None:
    _one(random, scene).casts = bool(random.random() < 0.6)


def _widen(random: np.random.Generator, scene: Scene) -> None:
    shape = _one(random, scene)
    if isinstance(shape, Strands):
        shape.width = float(random.choice([0.0, 0.05, 0.3]))
    elif isinstance(shape, Particles):
        shape.radius = float(random.choice([0.0, 0.1, 0.4]))


def _relight(random: np.random.Generator, scene: Scene) -> None:
    light = scene.lights[0]
    if isinstance(light, DirectionalLight):
        light.direction = random.uniform(-1, 1), random.uniform(-1, 1), -1.0
    elif isinstance(light, PointLight):
        light.position = random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 9)


CHANGES: tuple[Change, ...] = (_move, _bend, _fade, _hide, _widen, _relight)


def differences(
    bench: Bench, way: Way, scene: Scene, random: np.random.Generator, changes: int
) -> list[str]:
    """Where T after a change, with what has not moved skipped, is not T with everything forced."""
    renderer = bench.renderer(way, scene, 48)
    asked = random.uniform(-2, 2, (300, 3))
    problems = []
    for _ in range(changes):
        change = CHANGES[random.integers(len(CHANGES))]
        change(random, scene)
        for where in (asked, scene.shapes[0]):
            skipped = renderer.transmittance(where)
            renderer.invalidate()
            forced = renderer.transmittance(where)
            if skipped.tobytes() != forced.tobytes():
                problems.append(f"{change.__name__}: off by {np.abs(skipped - forced).max():.3g}")
    return problems


@case(
    "skip",
    input="ten random changes of shapes, opacities, lights, one after the other",
    right="T of skipped passes is T of forced ones, bit for bit",
    tolerance=0,
    of="wrong answers",
)
def skipped_equals_forced(bench: Bench) -> Iterator[Finding]:
    """A pass that no declared read of has moved would write what it wrote."""
    lights = DirectionalLight((0.4, 0.3, -0.8)), PointLight((0.2, 0.1, 6.0))
    count = 10 if bench.is_thorough else 2
    for number, way in enumerate(bench.ways(ALL, papers=bench.is_thorough)):
        scene = Scene(random_shapes(bench.seed + 5), lights[number % 2])
        yield wrong(way, differences(bench, way, scene, bench.random(number), count))
        bench.clear()


@case(
    "skip",
    input="the same; pictures",
    right="a picture of skipped passes is that of forced ones, bit for bit",
    tolerance=0,
    of="wrong answers",
)
def skipped_pictures(bench: Bench) -> Iterator[Finding]:
    """As with T; a picture adds the passes of the camera."""
    for number, way in enumerate(bench.ways(ALL)):
        if way.device == "cpu":
            continue
        random = bench.random(number)
        scene = Scene(random_shapes(bench.seed + 5), DirectionalLight((0.4, 0.3, -0.8)))
        renderer = bench.renderer(way, scene, 48)
        problems = []
        for change in CHANGES[::2]:
            change(random, scene)
            skipped = renderer.render()
            renderer.invalidate()
            if skipped.tobytes() != renderer.render().tobytes():
                problems.append(change.__name__)
        yield wrong(way, problems)
        bench.clear()
