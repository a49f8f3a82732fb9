"""What techniques are measured against: the same map's exact lists, and rays."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from pyopacity.camera import Camera
from pyopacity.comparison.plan import Plan, Variant
from pyopacity.comparison.surfaces import F32, F64, trace_on_surfaces
from pyopacity.errors import ParameterError
from pyopacity.reference_picture import PictureParts, picture_parts, traced
from pyopacity.renderer import Renderer
from pyopacity.scene import Scene
from pyopacity.shapes import Mesh, Shape
from pyopacity.technique import EXACT, techniques
from pyopacity.trace import trace_transmittance

Bias = float | None  # of a technique, world units; None: automatic
Progress = Callable[[str], object]

# What judges one map (docs/accuracy.md).
FOOTPRINT_TEXELS = 2.0


@dataclass(frozen=True, eq=False, slots=True)
class Receivers:
    """Vertices at which T is compared, one shape after the other.

    Attributes:
        chosen: (shape, indices of its vertices, ascending).
        points: (N, 3) float64, world units.
        normals: (N, 3) float64, of any length; 0 on a strand.
        bias: (N,) float64, world units: the automatic bias of each vertex's shape.
    """

    chosen: list[tuple[Shape, npt.NDArray[np.int64]]]
    points: F64
    normals: F64
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
    chosen, points, normals, bias = [], [], [], []
    for shape, end in zip(shapes, ends, strict=True):
        first = end - len(shape.points)
        own = kept[(kept >= first) & (kept < end)] - first
        if not len(own):
            continue
        matrix = shape.transform
        chosen.append((shape, own))
        points.append(shape.points[own].astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3])
        normals.append(np.zeros((len(own), 3)))
        if isinstance(shape, Mesh):
            normals[-1] = shape.normals[own] @ np.linalg.inv(matrix[:3, :3])
        bias.append(np.full(len(own), scene._handle.automatic_bias(shape._handle)))
    return Receivers(chosen, *(np.concatenate(part) for part in (points, normals, bias)))


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

    def transmittance(self, footprint: float, bias: Bias) -> F32:
        """(N,) float32 at the receivers: the mean over a square of this side in world units."""
        key = (footprint, bias)
        if key not in self._transmittance:
            self._transmittance[key] = self._trace(footprint, bias)
        return self._transmittance[key]

    def picture(self, bias: Bias) -> F32:
        """(H, W, 4) float32: the camera's picture, shaded with T by rays."""
        if bias not in self._pictures:
            plan = self._plan
            if self._parts is None:
                self._parts = picture_parts(
                    self._scene, self._camera, plan.image_size, plan.image_samples, **plan.settings
                )
            self._pictures[bias] = traced(
                self._scene, self._parts, bias, self._tell("tracing rays from the picture")
            )
        return self._pictures[bias]

    def _trace(self, footprint: float, bias: Bias) -> F32:
        receivers, samples = self._receivers, self._plan.samples
        biases = receivers.bias if bias is None else np.full_like(receivers.bias, bias)
        on_surface = receivers.normals.any(axis=1) & (footprint > 0.0)
        T = np.empty(len(biases), np.float32)
        if (~on_surface).any():
            points = receivers.points[~on_surface]
            tell = self._tell("tracing rays from strands")
            T[~on_surface] = trace_transmittance(
                self._scene, points, 0, footprint, samples, bias=biases[~on_surface], progress=tell
            )
        if on_surface.any():
            points, normals = receivers.points[on_surface], receivers.normals[on_surface]
            tell = self._tell("tracing rays from surfaces")
            T[on_surface] = trace_on_surfaces(
                self._scene, points, normals, biases[on_surface], footprint, samples, tell
            )
        return T

    def _tell(self, what: str) -> Callable[[float], object]:
        self._progress(what)
        return lambda part: self._progress(f"{what}: {100.0 * part:.0f} %")
