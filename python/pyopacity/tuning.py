"""How many layers: as many as a frame's time allows, or as few as an error does.

The thesis leaves the number to the user, since correlation rises with it and cannot choose, and
thinks of a fly-through whose layers grow while it stays real-time (Voicu 2011, sections 5.2.3 and
7). Here the exact lists of the same map tell the error, too.
"""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from pyopacity import _arrays, metrics
from pyopacity._arrays import Number
from pyopacity.camera import Camera
from pyopacity.comparison import DepthReference, Receivers, Variant, sample_receivers
from pyopacity.errors import ParameterError
from pyopacity.renderer import Renderer
from pyopacity.technique import Technique

_WARM_UP = 1
_LAYERS_A_TARGET = 4  # of a texture that passes write: fewer cost as much
_RECEIVERS, _SEED = 20_000, 0


@dataclass(frozen=True, slots=True)
class LayerTrial:
    """A number of layers, and what it was found to take.

    Attributes:
        layers: of the technique.
        ms: the median time of a frame in milliseconds, everything moving; or None.
        error: the RMSE of T against the exact lists of the same map; or None.
        fits: whether that is within the budget.
    """

    layers: int
    ms: float | None
    error: float | None
    fits: bool


@dataclass(frozen=True, slots=True)
class LayerChoice:
    """What :func:`tune` has chosen, and what it tried for that.

    Attributes:
        layers: the choice; where none fits, the one nearest to the budget.
        fits: whether it is within the budget.
        trials: in the order in which they were made.
    """

    layers: int
    fits: bool
    trials: tuple[LayerTrial, ...]


def tune(
    renderer: Renderer,
    *,
    budget_ms: Number | None = None,
    error: Number | None = None,
    frames: int = 9,
    progress: Callable[[LayerTrial], object] = lambda trial: None,
) -> LayerChoice:
    """Chooses ``renderer.technique.layers`` for one of two budgets, and sets it.

    With ``budget_ms`` the camera flies once around its target while everything is drawn anew in
    each frame, and layers grow as long as the median frame stays within the budget; with
    ``device="cpu"`` a frame is a look-up at the receivers. With ``error`` they grow until the RMSE
    of T at up to 20,000 receivers of the scene, against the exact lists of the same map, is no more
    than that; then the fewest are chosen.

    Args:
        renderer: whose technique has ``layers``. Its camera is what it was afterwards.
        budget_ms: milliseconds a frame, more than 0.
        error: of T, 0 .. 1.
        frames: of the flight, 1 .. 1000.
        progress: called with each trial.

    Raises:
        ParameterError: not one of the two budgets, or one out of its range; a technique without
            ``layers``; a scene in which nothing receives.
    """
    if (budget_ms is None) == (error is None):
        raise ParameterError("tune takes one budget", "give budget_ms, or error")
    _check("budget_ms", budget_ms, math.inf)
    _check("error", error, 1.0)
    if not 1 <= _arrays.whole("frames", frames) <= 1000:
        raise ParameterError(f"frames = {frames} is outside 1..1000", "choose 1..1000")
    most = _most_layers(renderer.technique)
    before = renderer.technique.layers
    trials: list[LayerTrial] = []

    def told(trial: LayerTrial) -> LayerTrial:
        trials.append(trial)
        progress(trial)
        return trial

    try:
        receivers = sample_receivers(renderer.scene, _RECEIVERS, _SEED)
        if error is not None:
            measure = _errors(renderer, receivers, float(error))
            chosen = _fewest(lambda layers: told(measure(layers)), most)
        else:
            assert budget_ms is not None
            clock = _Clock(renderer, receivers, frames)
            chosen = _most(lambda layers: told(clock.trial(layers, float(budget_ms))), most)
    except BaseException:
        renderer.technique.layers = before
        raise
    renderer.technique.layers = chosen.layers
    return LayerChoice(chosen.layers, chosen.fits, tuple(trials))


def _check(name: str, budget: Number | None, most: float) -> None:
    if budget is not None and not 0.0 < _arrays.number(name, budget) <= most:
        raise ParameterError(
            f"{name} = {budget} is no budget",
            "give milliseconds above 0" if name == "budget_ms" else "give an error in 0..1",
        )


def _most_layers(technique: Technique) -> int:
    for parameter in technique.parameters:
        if parameter.name == "layers":
            return int(parameter.range.rpartition("..")[2])
    raise ParameterError(
        f"{technique.name} has no layers to choose", "choose a technique with layers"
    )


# ---- which numbers are tried ----

Trial = Callable[[int], LayerTrial]


def _doubled(most: int) -> Iterator[int]:
    layers = 1
    while layers < most:
        yield layers
        layers *= 2
    yield most


def _most(trial: Trial, most: int) -> LayerTrial:
    """The most that fit, up to what one texture holds."""
    best, miss = None, None
    for layers in _doubled(most):
        tried = trial(layers)
        if not tried.fits:
            miss = tried
            break
        best = tried
    if best is None:
        assert miss is not None
        return miss
    while miss is not None and miss.layers - best.layers > _LAYERS_A_TARGET:
        tried = trial((best.layers + miss.layers) // 2)
        best, miss = (tried, miss) if tried.fits else (best, tried)
    return best


def _fewest(trial: Trial, most: int) -> LayerTrial:
    """The fewest that fit."""
    miss = 0
    for layers in _doubled(most):
        best = trial(layers)
        if best.fits:
            break
        miss = layers
    while best.fits and best.layers - miss > 1:
        tried = trial((best.layers + miss) // 2)
        best, miss = (tried, miss) if tried.fits else (best, tried.layers)
    return best


# ---- what is measured ----


def _errors(renderer: Renderer, receivers: Receivers, budget: float) -> Trial:
    """Trials of the error of T."""
    technique = renderer.technique
    shared = {p.name: getattr(technique, p.name) for p in technique.parameters}
    exact = DepthReference(receivers).of(renderer, Variant(technique.name, shared))
    renderer.technique = technique

    def trial(layers: int) -> LayerTrial:
        technique.layers = layers
        found = metrics.rmse(receivers.transmittance(renderer), exact)
        return LayerTrial(layers, None, found, found <= budget)

    return trial


class _Clock:
    """Times frames in which everything is drawn anew."""

    def __init__(self, renderer: Renderer, receivers: Receivers, frames: int) -> None:
        self._renderer, self._receivers, self._frames = renderer, receivers, frames

    def trial(self, layers: int, budget_ms: float) -> LayerTrial:
        self._renderer.technique.layers = layers
        camera = self._renderer.camera
        times = []
        try:
            for i in range(-_WARM_UP, self._frames):
                self._renderer.camera = _flown(camera, max(i, 0) / self._frames)
                self._renderer.invalidate()
                start = time.perf_counter()
                self._frame()
                times.append(1000.0 * (time.perf_counter() - start))
        finally:
            self._renderer.camera = camera
        ms = statistics.median(times[_WARM_UP:])
        return LayerTrial(layers, ms, None, ms <= budget_ms)

    def _frame(self) -> None:
        if self._renderer.device == "cpu":
            self._receivers.transmittance(self._renderer)
        else:
            self._renderer.render()


def _flown(camera: Camera, part: float) -> Camera:
    """The camera, so far around its target; its up direction is the axis."""
    axis = np.array(camera.up) / np.linalg.norm(camera.up)
    offset = np.array(camera.eye) - camera.target
    turn = 2.0 * math.pi * part
    # Rodrigues: what is across the axis turns.
    turned = (
        offset * math.cos(turn)
        + np.cross(axis, offset) * math.sin(turn)
        + axis * (axis @ offset) * (1.0 - math.cos(turn))
    )
    eye = (np.array(camera.target) + turned).tolist()
    return Camera.look_at(eye, camera.target, camera.up, camera.fov_deg)
