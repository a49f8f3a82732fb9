"""Random cases without end: shapes, lights, techniques with random parameters.

No right answer is known of most of them; what is, are relations that no input breaks.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from pyopacity._arrays import Floats, Value
from pyopacity._native import Parameter
from pyopacity.errors import Error, ParameterError
from pyopacity.light import DirectionalLight, Light, PointLight, SpotLight
from pyopacity.scene import Scene
from pyopacity.shapes import Mesh, Shape, Strands
from pyopacity.stress.bench import Bench
from pyopacity.stress.case import words_of
from pyopacity.stress.devices import OF_ORACLE, apart_from_oracle
from pyopacity.stress.exceptions import exception_of
from pyopacity.stress.order import OF_TEXELS, hardly_rises
from pyopacity.stress.relations import permuted, permuted_shape
from pyopacity.stress.shapes import random_shapes
from pyopacity.stress.skips import differences
from pyopacity.stress.way import ALL, Device, Way
from pyopacity.technique import technique

F64 = npt.NDArray[np.float64]
TECHNIQUES = 3  # of a case
MAP_SIZES = (1, 2, 3, 4, 5, 16, 33, 64, 100)
# Where a triangle's edge passes through a texel's middle, one device may cover it.
EDGES = 0.01
OF_DEVICES = 1e-3
# Moments multiply what float32 rounds: most in a map of one texel, which holds everything.
OF_ORDER, OF_ORDER_OF_MOMENTS = 1e-4, 0.03
# Parameters that a relation below is not about: what other frames, another camera, or a fit of the
# same points would change.
_LEFT_ALONE = {"bias", "search_frames", "refine", "splits", "memory"}


@dataclass(frozen=True, slots=True)
class Draw:
    """A random case; the same for the same seed.

    Attributes:
        seed: of all of it.
        shapes, light: the scene.
        map_size: texels along each side.
        asked: points, (N, 3).
        lines: points along the light, (lines, steps, 3).
        techniques: with parameters.
    """

    seed: int
    shapes: list[Shape]
    light: Light
    map_size: int
    asked: F64
    lines: F64
    techniques: tuple[tuple[str, tuple[tuple[str, Value], ...]], ...]

    def __str__(self) -> str:
        kinds = ", ".join(type(shape).__name__.lower() for shape in self.shapes)
        return f"seed {self.seed}: {kinds}; {self.light!r}; map {self.map_size}"


def draw(seed: int) -> Draw:
    """The case of a seed."""
    random = np.random.default_rng(seed)
    every = random_shapes(seed)
    chosen = random.permutation(len(every))[: random.integers(1, len(every) + 1)]
    shapes = [every[i] for i in chosen]
    for shape in shapes:
        if isinstance(shape, Strands | Mesh) and random.random() < 0.3:
            shape.opacity = float(random.choice([0.0, 2.0**-24, 1e-8, 0.999, 1.0 - 2.0**-24, 1.0]))
    light = _light(random)
    asked = random.uniform(-3, 3, (400, 3))
    names = [ALL[i] for i in random.permutation(len(ALL))[:TECHNIQUES]]
    return Draw(
        seed,
        shapes,
        light,
        int(random.choice(MAP_SIZES)),
        asked,
        _lines(random, light),
        tuple((name, _parameters(random, name)) for name in names),
    )


def _light(random: np.random.Generator) -> Light:
    kind = random.integers(4)
    direction = random.normal(size=3)
    far = tuple(float(v) for v in random.uniform(6, 20) * direction / np.linalg.norm(direction))
    if kind == 0:
        return DirectionalLight(tuple(float(v) for v in direction))
    if kind == 1:
        return PointLight(far)
    if kind == 2:
        return PointLight(tuple(float(v) for v in random.uniform(-1, 1, 3)))
    return SpotLight(far, tuple(-v for v in far), float(random.uniform(1, 170)))


def _lines(random: np.random.Generator, light: Light) -> F64:
    steps = np.linspace(0.0, 1.0, 31)[None, :, None]
    to = random.uniform(-2, 2, (40, 1, 3))
    if isinstance(light, DirectionalLight):
        return np.asarray(to + (24.0 * steps - 12.0) * np.array(light.direction))
    place = np.array(light.position)  # type: ignore[attr-defined]
    return np.asarray(place + 2.0 * steps * (to - place))


def _parameters(random: np.random.Generator, name: str) -> tuple[tuple[str, Value], ...]:
    """Some, at random values, that the technique takes together."""
    found: list[tuple[str, Value]] = []
    for parameter in technique(name).parameters:
        if parameter.name not in _LEFT_ALONE and random.random() < 0.3:
            found.append((parameter.name, _value(random, parameter)))
    return tuple(found)


def _value(random: np.random.Generator, parameter: Parameter) -> Value:
    """In the range that the parameter names for people."""
    if parameter.type == "bool":
        return bool(random.random() < 0.5)
    words = [word.strip('" ') for word in parameter.range.split(", ")]
    if parameter.type.startswith("choice"):
        return str(random.choice([word for word in words if not word.startswith("or ")]))
    if ".." not in parameter.range:
        return int(random.choice(words))
    low, high = (float(end) for end in parameter.range.removeprefix('"auto" or ').split(".."))
    if parameter.type == "int":
        return int(random.integers(int(low), min(int(high), 64) + 1))
    return float(random.uniform(low, min(high, 4.0)))


Check = Callable[[Bench, Draw, Way], list[str]]


def bounded(bench: Bench, of: Draw, way: Way) -> list[str]:
    """T is finite and in [0, 1] at points, at shapes and along lines, and does not rise there."""
    scene = Scene(of.shapes, of.light)
    problems = []
    asked: list[Floats | Shape] = [of.asked, *of.shapes]
    for where in asked:
        T = bench.T(way, scene, where, of.map_size)
        if not (np.isfinite(T).all() and T.min(initial=1) >= 0 and T.max(initial=0) <= 1):
            problems.append(f"T is {T.min()} .. {T.max()}")
    T = bench.T(way, scene, of.lines.reshape(-1, 3), of.map_size).reshape(of.lines.shape[:2])
    exception = exception_of(hardly_rises.name, str(Way(way.device, way.technique)))
    rise = float(np.diff(T, axis=1).max())
    if exception is None and not rise <= _most_rise(of, way):
        problems.append(f"T rises by {rise:.3g}")
    return problems


def _most_rise(of: Draw, way: Way) -> float:
    """What rounded places may change: T runs from one texel to the next over a filter's width."""
    if way.given("filter") == "none":
        return 1.0  # a jump
    if way.given("filter_width") is not None:
        return 1.0  # fewer texels the farther it is from a light at a place, and perhaps a jump
    radius = min(float(way.given("filter_radius") or 0.5), 0.5)
    return OF_TEXELS * max(of.map_size / 64.0, 1.0) * 0.5 / max(radius, 1.0 / 1024.0)


def forced(bench: Bench, of: Draw, way: Way) -> list[str]:
    """Skipped passes change no bit."""
    own = draw(of.seed)  # which it changes
    scene = Scene(own.shapes, own.light)
    return differences(bench, way, scene, np.random.default_rng(of.seed), 2)


def reordered(bench: Bench, of: Draw, way: Way) -> list[str]:
    """Another order of shapes and primitives gives the same T."""
    order = np.random.default_rng(of.seed)
    other = [permuted_shape(shape, order) for shape in of.shapes][::-1]
    T, right = (
        bench.T(way, Scene(shapes, of.light), of.asked, of.map_size)
        for shapes in (other, of.shapes)
    )
    is_exception = exception_of(permuted.name, str(Way(way.device, way.technique))) is not None
    allowed = OF_ORDER_OF_MOMENTS if is_exception else OF_ORDER
    apart = np.mean(np.abs(T - right) > allowed)
    return [f"{apart:.2%} of T depend on the order"] if apart > EDGES else []


CHECKS: tuple[Check, ...] = (bounded, forced, reordered)


def on_both(bench: Bench, of: Draw, ways: list[Way]) -> list[str]:
    """The devices agree, but at edges of surfaces."""
    scene = Scene(of.shapes, of.light)
    T = [bench.T(way, scene, of.asked, of.map_size) for way in ways]
    apart = np.mean(np.abs(T[0] - T[-1]) > OF_DEVICES)
    return [f"the devices differ at {apart:.2%} of the points"] if apart > 2 * EDGES else []


def by_oracle(bench: Bench, of: Draw, device: Device) -> list[str]:
    """The exact lists of strands are those of a float64 brute force."""
    apart = np.mean(apart_from_oracle(bench, of.seed, device) > OF_ORACLE)
    return [f"{apart:.2%} of T are not the oracle's"] if apart > EDGES else []


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of a random case.

    Attributes:
        problems: (what, problem) of everything that does not hold, errors of the engine too.
        refused: techniques' words of parameters that exclude each other. Many of one kind, or one
            that is not so, would be a wrong refusal.
    """

    problems: list[tuple[str, str]]
    refused: list[str]


def judge(bench: Bench, of: Draw) -> Outcome:
    """Asks every technique of a case on every device, and the oracle."""
    found = Outcome([], [])
    for name, parameters in of.techniques:
        ways = [Way(device, name, parameters) for device in bench.devices]
        try:
            found.problems.extend(_problems(bench, of, ways))
        except ParameterError as error:
            found.refused.append(f"{name}: {error.what}")
        except (Error, MemoryError) as error:
            found.problems.append((_told(bench.asked or ways[0]), words_of(error)))
        finally:
            bench.clear()
    for device in bench.devices:
        try:
            told = f"{device} exact"
            found.problems.extend((told, problem) for problem in by_oracle(bench, of, device))
        except (Error, MemoryError) as error:
            found.problems.append((told, words_of(error)))
        finally:
            bench.clear()
    return found


def _problems(bench: Bench, of: Draw, ways: list[Way]) -> Iterator[tuple[str, str]]:
    for way in ways:
        for check in CHECKS:
            yield from ((_told(way), problem) for problem in check(bench, of, way))
    both = f"{ways[0].technique} {dict(ways[0].parameters)}"
    yield from ((both, problem) for problem in on_both(bench, of, ways))


def _told(way: Way) -> str:
    return f"{way.device} {way.technique} {dict(way.parameters)}"
