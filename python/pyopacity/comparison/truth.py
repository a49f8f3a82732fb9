"""What techniques are measured against: the same map's exact lists, and rays."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from pyopacity.camera import Camera
from pyopacity.comparison.plan import Plan, Variant
from pyopacity.errors import ParameterError
from pyopacity.reference_picture import PictureParts, picture_parts
from pyopacity.renderer import Renderer
from pyopacity.scene import Scene
from pyopacity.shapes import Shape
from pyopacity.technique import EXACT, UNSHADOWED, techniques
from pyopacity.trace import trace_transmittance

F32 = npt.NDArray[np.float32]
F64 = npt.NDArray[np.float64]
Bias = float | None  # of a technique, world units; None: automatic
Progress = Callable[[str], object]

# What compares maps of several sizes takes one footprint for all: two texels of this one.
MAP_SIZE_OF_THE_FOOTPRINT = 512
FOOTPRINT_TEXELS = 2.0


@dataclass(frozen=True, eq=False, slots=True)
class Receivers:
    """Vertices at which T is compared, one shape after the other.

    Attributes:
        chosen: (shape, indices of its vertices, ascending).
        points: (N, 3) float64, world units.
        bias: (N,) float64, world units: the automatic bias of each vertex's shape.
    """

    chosen: list[tuple[Shape, npt.NDArray[np.int64]]]
    points: F64
    bias: F64

    def transmittance(self, renderer: Renderer) -> F32:
        """(N,) float32: T at them by the renderer's technique, each with its own shape's bias."""
        return np.concatenate(
            [renderer.transmittance(shape)[indices] for shape, indices in self.chosen]
        )


def sample_receivers(scene: Scene, count: int, seed: int) -> Receivers:
    """A random subset of the vertices of all shapes that receive; all, where they are fewer.

    Raises:
        ParameterError: no shape receives.
    """
    shapes = [shape for shape in scene.shapes if shape.receives and len(shape.points) > 0]
    if not shapes:
        raise ParameterError("no shape of the scene receives shadows", "add one, or set .receives")
    ends = np.cumsum([len(shape.points) for shape in shapes])
    total = int(ends[-1])
    random = np.random.default_rng(seed)
    kept = np.sort(random.choice(total, min(count, total), replace=False))
    chosen, points, bias = [], [], []
    for shape, end in zip(shapes, ends, strict=True):
        first = end - len(shape.points)
        own = kept[(kept >= first) & (kept < end)] - first
        if not len(own):
            continue
        matrix = shape.transform
        chosen.append((shape, own))
        points.append(shape.points[own].astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3])
        bias.append(np.full(len(own), scene._handle.automatic_bias(shape._handle)))
    return Receivers(chosen, np.concatenate(points), np.concatenate(bias))


def texel_side(renderer: Renderer) -> float:
    """Of the last frame's map, in world units."""
    return 1.0 / float(np.linalg.norm(renderer.light_from_world[0, :3]))


class DepthReference:
    """T of the exact lists of the renderer's map, with the parameters that both have."""

    def __init__(self, receivers: Receivers) -> None:
        self._receivers = receivers
        self._known: dict[object, F32] = {}
        self._parameters = {p.name for p in techniques()[EXACT].parameters}

    def of(self, renderer: Renderer, variant: Variant) -> F32:
        """(N,) float32. The renderer's technique is another one afterwards."""
        shared = {k: v for k, v in variant.parameters.items() if k in self._parameters}
        key = (renderer.map_size, *sorted(shared.items()))
        if key not in self._known:
            renderer.technique = Variant(EXACT, shared).make()
            self._known[key] = self._receivers.transmittance(renderer)
        return self._known[key]


class Truth:
    """T by rays, at receivers and in the picture; each is traced once."""

    def __init__(
        self, scene: Scene, camera: Camera, plan: Plan, receivers: Receivers, progress: Progress
    ) -> None:
        self._scene, self._camera, self._plan = scene, camera, plan
        self._receivers, self._progress = receivers, progress
        self._parts: PictureParts | None = None
        self._pictures: dict[Bias, F32] = {}
        self._transmittance: dict[tuple[float, Bias], F32] = {}
        self.image_footprint = self._footprint_of_pictures()

    def transmittance(self, footprint: float, bias: Bias) -> F32:
        """(N,) float32 at the receivers: the mean over a square of this side in world units."""
        key = (footprint, bias)
        if key not in self._transmittance:
            biases = self._receivers.bias if bias is None else bias
            points, rays = self._receivers.points, self._plan.samples
            self._transmittance[key] = self._trace("receivers", points, biases, footprint, rays)
        return self._transmittance[key]

    def picture(self, bias: Bias) -> F32:
        """(H, W, 4) float32: the camera's picture, shaded with T by rays."""
        if bias not in self._pictures:
            parts = self._picture_parts()
            biases = parts.bias if bias is None else bias
            footprint, rays = self.image_footprint, self._plan.image_rays
            T = self._trace("the picture", parts.points, biases, footprint, rays)
            self._pictures[bias] = parts.shaded(T)
        return self._pictures[bias]

    def _picture_parts(self) -> PictureParts:
        if self._parts is None:
            plan = self._plan
            self._parts = picture_parts(
                self._scene, self._camera, plan.image_size, plan.image_samples, **plan.settings
            )
        return self._parts

    def _trace(
        self, where: str, points: F64, bias: F64 | F32 | float, footprint: float, rays: int
    ) -> F32:
        def tell(part: float) -> None:
            self._progress(f"tracing rays from {where}: {100.0 * part:.0f} %")

        tell(0.0)
        return trace_transmittance(
            self._scene, points, 0, footprint, rays, bias=bias, progress=tell
        )

    def _footprint_of_pictures(self) -> float:
        if self._plan.footprint is not None:
            return self._plan.footprint
        with Renderer(
            self._scene,
            self._camera,
            (8, 8),
            UNSHADOWED,
            map_size=MAP_SIZE_OF_THE_FOOTPRINT,
        ) as renderer:
            renderer.render()
            return FOOTPRINT_TEXELS * texel_side(renderer)
