"""A row for each technique and map: its three errors, and what it costs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass, fields
from typing import Any, Literal

import numpy as np

from pyopacity import _arrays, _native, metrics
from pyopacity.camera import Camera
from pyopacity.comparison.cost import Cost, cost_of
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
)
from pyopacity.errors import ContextError, ParameterError
from pyopacity.metrics import Errors
from pyopacity.renderer import Renderer
from pyopacity.scene import Scene
from pyopacity.technique import EXACT


@dataclass(frozen=True, eq=False, slots=True)
class Result:
    """One technique on one map.

    Attributes:
        variant: the technique and its parameters.
        map_size: texels along each side.
        map_size_reason: why map_size="auto" took so many; None where the plan says how many.
        footprint: side in world units of the square over which T by rays is averaged; the median,
            where texels are larger far from a light.
        receivers: how many, counted again for each light.
        depth: of T at the receivers, against the exact lists of the same map.
        total: of T at the receivers, against rays.
        image: of linear RGB over black, against the picture with T by rays; None, as all that is
            about pictures, on a device that makes none, and where none can be traced.
        flip: mean FLIP of these two pictures; None where flip-evaluator is not installed.
        cost: time, passes, memory.
        renderer: what OpenGL calls itself, or "cpu".
        picture, traced: (H, W, 4) float32, linear, premultiplied.
    """

    variant: Variant
    map_size: int
    map_size_reason: str | None
    footprint: float
    receivers: int
    depth: Errors
    total: Errors
    image: Errors | None
    flip: float | None
    cost: Cost
    renderer: str
    picture: F32 | None
    traced: F32 | None

    def figures(self) -> dict[str, Any]:
        """The errors and costs, flat: ``depth_rmse`` and so on."""
        errors = {"depth": self.depth, "total": self.total, "image": self.image}
        flat = {
            f"{kind}_{name}": figure
            for kind, found in errors.items()
            for name, figure in _figures(found).items()
        }
        return {**flat, "flip": self.flip, **asdict(self.cost)}


def compare(
    scene: Scene, camera: Camera, plan: Plan, progress: Progress = lambda _: None
) -> Iterator[Result]:
    """Measures what the plan says, one result after the other, maps of one size together.

    Args:
        scene: with one light, or several, of which T is compared one by one.
        camera: of the pictures.
        plan: what to measure.
        progress: told in words what is being done.

    Raises:
        ContextError: no OpenGL, where the plan's device is not "cpu".
        ParameterError: a scene without a light or without receivers; a plan that does not hold.
    """
    if not scene.lights:
        raise ParameterError("the scene has 0 lights", "add one")
    variants = plan.variants()
    receivers = sample_receivers(scene, plan.receivers, plan.seed)
    settings = {
        **plan.settings,
        "size": plan.image_size,
        "antialiasing": plan.image_samples,
        "compositing": "opaque",  # as in traced pictures
    }
    with Renderer(scene, camera, device=plan.device, **settings) as renderer:
        truth = Truth(scene, camera, plan, receivers, progress)
        bench = Bench(plan, renderer, receivers, truth, DepthReference(receivers))
        for map_size in dict.fromkeys(plan.map_sizes):
            renderer.map_size = map_size
            for variant in variants:
                progress(f"{variant.label}, map {map_size}")
                yield bench.measure(variant)


@dataclass(frozen=True, slots=True)
class ErrorsOfT:
    """Of one technique on one map, without a picture; as in :class:`Result`."""

    map_size: int
    map_size_reason: str | None
    footprint: float
    receivers: int
    depth: Errors
    total: Errors


@dataclass(frozen=True, slots=True)
class Bench:
    """What all rows are measured on."""

    plan: Plan
    renderer: Renderer
    receivers: Receivers
    truth: Truth
    depth_reference: DepthReference

    def errors(self, variant: Variant) -> ErrorsOfT:
        """On a map of the size that the renderer has; the technique is the renderer's then."""
        renderer = self.renderer
        exact = self.depth_reference.of(renderer, variant)
        renderer.technique = variant.make()
        measured = self.receivers.transmittance(renderer)
        sides = FOOTPRINT_TEXELS * self.receivers.texel_sides(renderer)
        map_size, reason = _map_size_of(renderer)
        if self.plan.footprint is not None:
            sides = np.full_like(sides, self.plan.footprint)
        traced = self.truth.transmittance(sides, _bias_of(renderer))
        return ErrorsOfT(
            map_size=map_size,
            map_size_reason=reason,
            footprint=float(np.median(sides)),
            receivers=len(measured),
            depth=metrics.errors(measured, exact),
            total=metrics.errors(measured, traced),
        )

    def measure(self, variant: Variant) -> Result:
        """One row: the errors, those of the picture, and what it costs."""
        renderer = self.renderer
        found = self.errors(variant)
        picture = traced = image = flip = None
        if self.plan.device != "cpu":
            picture, traced = renderer.render(), self.truth.picture(_bias_of(renderer))
        if picture is not None and traced is not None:
            image = metrics.errors(picture[..., :3], traced[..., :3])
            flip = metrics.flip(traced, picture) if metrics.has_flip() else None
        return Result(
            variant=variant,
            map_size=found.map_size,
            map_size_reason=found.map_size_reason,
            footprint=found.footprint,
            receivers=found.receivers,
            depth=found.depth,
            total=found.total,
            image=image,
            flip=flip,
            cost=cost_of(renderer, self.receivers, self.plan.repeats),
            renderer=renderer.device,
            picture=picture,
            traced=traced,
        )


def available_device() -> Literal["gpu", "cpu"]:
    """ "gpu" where a context can be made."""
    try:
        _native.Context.headless()
    except ContextError:
        return "cpu"
    return "gpu"


def _figures(found: Errors | None) -> dict[str, float | None]:
    return dict(asdict(found)) if found else {one.name: None for one in fields(Errors)}


def _map_size_of(renderer: Renderer) -> tuple[int, str | None]:
    """Texels along each side of the last frame's map, and why, where it was "auto"."""
    if renderer.map_size != "auto":
        return int(renderer.map_size), None
    note = next(row.note for row in renderer.report if row.name == "map_size")
    size, _, reason = note.partition(" texels: ")
    if reason:
        return int(size), reason
    # Nothing is translucent: the pass that would say it did not run. Some technique has a map.
    variant = renderer.technique
    renderer.technique = EXACT
    renderer.transmittance(np.zeros((1, 3)))
    size_px = len(renderer.read("opaque_depth"))
    renderer.technique = variant
    return size_px, "no strands to go by"


def _bias_of(renderer: Renderer) -> Bias:
    """The technique's, in world units; None where it is automatic."""
    bias = getattr(renderer.technique, "bias", "auto")
    return float(bias) if _arrays.is_number(bias) else None
