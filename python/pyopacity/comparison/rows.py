"""A row for each technique and map: its three errors, and the time that it takes."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from pyopacity import _arrays, metrics
from pyopacity.camera import Camera
from pyopacity.comparison.plan import Plan, Variant
from pyopacity.comparison.surfaces import F32
from pyopacity.comparison.truth import (
    FOOTPRINT_TEXELS,
    Bias,
    DepthReference,
    Progress,
    Receivers,
    Truth,
    sample_receivers,
    texel_side,
)
from pyopacity.errors import ParameterError
from pyopacity.metrics import Errors
from pyopacity.renderer import Renderer
from pyopacity.scene import Scene


@dataclass(frozen=True, eq=False, slots=True)
class Result:
    """One technique on one map.

    Attributes:
        variant: the technique and its parameters.
        map_size: texels along each side.
        footprint: side in world units of the square over which T by rays is averaged.
        receivers: how many.
        depth: of T at the receivers, against the exact lists of the same map.
        total: of T at the receivers, against rays.
        image: of linear RGB over black, against the picture with T by rays.
        flip: mean FLIP of these two pictures; None where flip-evaluator is not installed.
        seconds: for a whole frame with nothing kept from the last, the median of a few.
        map_seconds: the part of it that made the light's maps.
        renderer: what OpenGL calls itself.
        picture, traced: (H, W, 4) float32, linear, premultiplied.
    """

    variant: Variant
    map_size: int
    footprint: float
    receivers: int
    depth: Errors
    total: Errors
    image: Errors
    flip: float | None
    seconds: float
    map_seconds: float
    renderer: str
    picture: F32
    traced: F32

    def figures(self) -> dict[str, Any]:
        """The errors and times, flat: ``depth_rmse`` and so on."""
        errors = {"depth": self.depth, "total": self.total, "image": self.image}
        flat = {
            f"{kind}_{name}": figure
            for kind, found in errors.items()
            for name, figure in asdict(found).items()
        }
        times = {"seconds": self.seconds, "map_seconds": self.map_seconds}
        return {**flat, "flip": self.flip, **times}


def compare(
    scene: Scene, camera: Camera, plan: Plan, progress: Progress = lambda _: None
) -> Iterator[Result]:
    """Measures what the plan says, one result after the other, maps of one size together.

    Args:
        scene: with one light.
        camera: of the pictures.
        plan: what to measure.
        progress: told in words what is being done.

    Raises:
        ContextError: no OpenGL.
        ParameterError: a scene without a light or without receivers; a plan that does not hold.
    """
    if len(scene.lights) != 1:
        raise ParameterError(
            f"the scene has {len(scene.lights)} lights", "compare a scene with one"
        )
    variants = plan.variants()
    receivers = sample_receivers(scene, plan.receivers, plan.seed)
    settings = {**plan.settings, "size": plan.image_size, "antialiasing": plan.image_samples}
    with Renderer(scene, camera, **settings) as renderer:
        truth = Truth(scene, camera, plan, receivers, progress)
        bench = _Bench(plan, renderer, receivers, truth, DepthReference(receivers))
        for map_size in dict.fromkeys(plan.map_sizes):
            renderer.map_size = map_size
            for variant in variants:
                progress(f"{variant.label}, map {map_size}")
                yield bench.measure(variant)


@dataclass(frozen=True, slots=True)
class _Bench:
    """What all rows are measured on."""

    plan: Plan
    renderer: Renderer
    receivers: Receivers
    truth: Truth
    depth_reference: DepthReference

    def measure(self, variant: Variant) -> Result:
        """One row, on a map of the size that the renderer has."""
        renderer, truth = self.renderer, self.truth
        exact = self.depth_reference.of(renderer, variant)
        renderer.technique = variant.make()
        measured = self.receivers.transmittance(renderer)
        picture = renderer.render()
        side = FOOTPRINT_TEXELS * texel_side(renderer)
        footprint = side if self.plan.footprint is None else self.plan.footprint
        bias = _bias_of(renderer)
        traced = truth.picture(bias)
        seconds, map_seconds = _times(renderer, self.plan.repeats)
        return Result(
            variant=variant,
            map_size=renderer.map_size,
            footprint=footprint,
            receivers=len(measured),
            depth=metrics.errors(measured, exact),
            total=metrics.errors(measured, truth.transmittance(footprint, bias)),
            image=metrics.errors(picture[..., :3], traced[..., :3]),
            flip=metrics.flip(traced, picture) if metrics.has_flip() else None,
            seconds=seconds,
            map_seconds=map_seconds,
            renderer=renderer.context.renderer,
            picture=picture,
            traced=traced,
        )


def _bias_of(renderer: Renderer) -> Bias:
    """The technique's, in world units; None where it is automatic."""
    bias = getattr(renderer.technique, "bias", "auto")
    return float(bias) if _arrays.is_number(bias) else None


def _times(renderer: Renderer, repeats: int) -> tuple[float, float]:
    """Medians in seconds of a whole frame, and of its passes before the lighting."""
    frames, maps = [], []
    for _ in range(repeats):
        renderer.invalidate()
        start = time.perf_counter()
        renderer.render()
        frames.append(time.perf_counter() - start)
        before = [row.ms for row in renderer.report if row.name != "lighting"]
        maps.append(sum(before) / 1000.0)
    return float(np.median(frames)), float(np.median(maps))
