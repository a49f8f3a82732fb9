"""What techniques are measured against: the same map's exact lists, and rays."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from pyopacity import _native
from pyopacity.camera import Camera
from pyopacity.comparison.plan import Plan, Variant
from pyopacity.comparison.surfaces import F32, F64, trace_on_surfaces
from pyopacity.errors import ParameterError
from pyopacity.reference_picture import PictureParts, can_be_traced, picture_parts, traced
from pyopacity.renderer import Renderer
from pyopacity.scene import Scene
from pyopacity.shapes import Mesh, Particles, Shape, Strands, Volume
from pyopacity.technique import EXACT, techniques
from pyopacity.trace import trace_transmittance

Bias = float | None  # of a technique, world units; None: automatic
Progress = Callable[[str], object]

_PLURAL = {Strands: "strands", Mesh: "surfaces", Particles: "particles", Volume: "voxels"}

# What judges one map (docs/accuracy.md).
FOOTPRINT_TEXELS = 2.0


@dataclass(frozen=True, eq=False, slots=True)
class Receivers:
    """Where T is compared: vertices, centres of particles and voxels, one shape after the other.

    Attributes:
        chosen: (shape, indices of its points, ascending).
        points: (N, 3) float64, world units.
        normals: (N, 3) float64, of any length; 0 but on a surface.
        bias: (N,) float64, world units: the automatic bias of each point's shape.
        lights: of the scene. What follows is (lights, N).
    """

    chosen: list[tuple[Shape, npt.NDArray[np.int64]]]
    points: F64
    normals: F64
    bias: F64
    lights: int = 1

    def transmittance(self, renderer: Renderer) -> F32:
        """T by the renderer's technique, each with its own shape's bias; flat."""
        return np.concatenate(
            [
                renderer.transmittance(shape, light)[indices]
                for light in range(self.lights)
                for shape, indices in self.chosen
            ]
        )

    def texel_sides(self, renderer: Renderer) -> F64:
        """Of the last frame's maps, in world units, where each point lies."""
        sides = renderer._engine.texel_sides
        return np.stack([sides(self.points, light) for light in range(self.lights)])


def sample_receivers(scene: Scene, count: int, seed: int) -> Receivers:
    """A random subset of the points of all shapes that receive; all, where they are fewer.

    Raises:
        ParameterError: no shape receives.
    """
    receiving = [(s, _native.receivers_on(s._handle)) for s in scene.shapes if s.receives]
    places = [(shape, points) for shape, points in receiving if len(points) > 0]
    if not places:
        raise ParameterError("no shape of the scene receives shadows", "add one, or set .receives")
    ends = np.cumsum([len(points) for _, points in places])
    total = int(ends[-1])
    random = np.random.default_rng(seed)
    kept = np.sort(random.choice(total, min(count, total), replace=False))
    chosen, points, normals, bias = [], [], [], []
    for (shape, world), end in zip(places, ends, strict=True):
        first = end - len(world)
        own = kept[(kept >= first) & (kept < end)] - first
        if not len(own):
            continue
        chosen.append((shape, own))
        points.append(world[own])
        normals.append(np.zeros((len(own), 3)))
        if isinstance(shape, Mesh):
            normals[-1] = shape.normals[own] @ np.linalg.inv(shape.transform[:3, :3])
        bias.append(np.full(len(own), scene._handle.automatic_bias(shape._handle)))
    at, n, b = (np.concatenate(part) for part in (points, normals, bias))
    return Receivers(chosen, at, n, b, len(scene.lights))


def texel_side(renderer: Renderer) -> float:
    """Of the last frame's map of a directional light, in world units."""
    return 1.0 / float(np.linalg.norm(renderer.light_from_world[0, :3]))


def box_width(footprint: float, texel: float) -> float:
    """Of the box filter that judges a footprint, in the unit of both.

    Texels have an extent of their own, whose variance adds to the box's, and one of them is the
    least (docs/accuracy.md).
    """
    return float(np.sqrt(max(footprint**2 - texel**2, texel**2)))


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
        self._transmittance: dict[tuple[bytes, Bias], F32] = {}

    def transmittance(self, footprint: F64, bias: Bias) -> F32:
        """At the receivers, flat: means over squares of these sides, (lights, N), world units."""
        key = (footprint.tobytes(), bias)
        if key not in self._transmittance:
            lit = [self._trace(light, sides, bias) for light, sides in enumerate(footprint)]
            self._transmittance[key] = np.concatenate(lit)
        return self._transmittance[key]

    def picture(self, bias: Bias) -> F32 | None:
        """(H, W, 4) float32: the camera's picture, shaded with T by rays; None of media."""
        if not can_be_traced(self._scene):
            return None
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

    def _trace(self, light: int, sides: F64, bias: Bias) -> F32:
        """(N,) of one light, shape after shape."""
        receivers, samples = self._receivers, self._plan.samples
        own_bias = receivers.bias if bias is None else np.full_like(receivers.bias, bias)
        found, first = [], 0
        for shape, indices in receivers.chosen:
            part = slice(first, first + len(indices))
            first = part.stop
            tell = self._tell(f"tracing rays from {_PLURAL[type(shape)]}")
            at, biases, footprint = receivers.points[part], own_bias[part], sides[part]
            if isinstance(shape, Mesh) and footprint.all():
                normals = receivers.normals[part]
                T = trace_on_surfaces(
                    self._scene, at, normals, biases, footprint, samples, tell, light
                )
            else:
                T = trace_transmittance(
                    self._scene,
                    shape,
                    light,
                    footprint,
                    samples,
                    bias=biases,
                    indices=indices,
                    progress=tell,
                )
            found.append(T)
        return np.concatenate(found)

    def _tell(self, what: str) -> Callable[[float], object]:
        self._progress(what)
        return lambda part: self._progress(f"{what}: {100.0 * part:.0f} %")
