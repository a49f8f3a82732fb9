"""The picture that shadows without error would give: rasterised as ever, T from rays.

Shading is linear in the T of each light, so a sample of a picture is *dark*, the one without a
light, plus *T (lit - dark)* for each light, with *lit* the one under it alone and without shadows.
All of them come from the renderer, and so does the point at which T is looked up
(:meth:`pyopacity.Renderer.receivers`); only T is traced. What is left between the two pictures is
the error of T, as a person sees it.

Particles and volumes take T all along a view, not at one point: there is no such picture of them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from pyopacity import _arrays
from pyopacity._arrays import Attribute, Floats, Number
from pyopacity.camera import Camera
from pyopacity.errors import ParameterError
from pyopacity.picture_receivers import PictureReceivers
from pyopacity.renderer import Renderer
from pyopacity.scene import Scene
from pyopacity.shapes import Particles, Volume
from pyopacity.technique import UNSHADOWED
from pyopacity.trace import trace_transmittance

_F32 = npt.NDArray[np.float32]

# Of the renderer's `antialiasing`, which draws the same samples.
_MOST_SAMPLES = 8


@dataclass(frozen=True, eq=False, slots=True)
class PictureParts:
    """A picture apart from its shadows, at ``samples`` x ``samples`` a pixel.

    Attributes:
        dark: (n H, n W, 4) float32, linear, premultiplied: without a light.
        lit: the same for each light alone, without shadows.
        receivers: where each sample looks T up.
        samples: n.
    """

    dark: _F32
    lit: list[_F32]
    receivers: PictureReceivers
    samples: int

    @property
    def points(self) -> npt.NDArray[np.float64]:
        """(M, 3) float64, world units: of the samples on which shadows can fall."""
        return self.receivers.points[self.receivers.mask]

    @property
    def bias(self) -> _F32:
        """(M,) float32, world units: the automatic bias at each of ``points``."""
        return self.receivers.bias[self.receivers.mask]

    def shaded(self, *transmittance: Floats) -> _F32:
        """The picture with this T of each light at ``points``: (H, W, 4) float32.

        T is (M,) in [0, 1], or (M, 3) with a value a colour.
        Samples are averaged in linear light, in float64.
        """
        picture = self.dark.astype(np.float64)
        for lit, seen in zip(self.lit, transmittance, strict=True):
            T = np.ones(picture.shape)
            T[self.receivers.mask, :3] = seen.reshape(len(seen), -1)
            picture += T * (lit.astype(np.float64) - self.dark)
        n = self.samples
        height, width, channels = picture.shape
        blocks = picture.reshape(height // n, n, width // n, n, channels)
        averaged: _F32 = blocks.mean(axis=(1, 3)).astype(np.float32)
        return averaged


def can_be_traced(scene: Scene) -> bool:
    """Whether each sample of its picture takes T at one point."""
    return not any(isinstance(shape, Particles | Volume) for shape in scene.shapes)


def picture_parts(
    scene: Scene, camera: Camera, size: tuple[int, int], samples: int, **settings: Any
) -> PictureParts:
    """What :func:`traced_picture` puts together; takes and raises the same."""
    if not can_be_traced(scene):
        raise ParameterError(
            "the scene has particles or a volume, which take T all along a view",
            "remove them, or compare T at points: pyopacity.trace_transmittance",
        )
    n = _arrays.whole("samples", samples)
    if not 1 <= n <= _MOST_SAMPLES:
        raise ParameterError(f"samples = {n} is outside 1..{_MOST_SAMPLES}", "choose one inside it")
    if "antialiasing" in settings:
        raise ParameterError("a traced picture has no antialiasing", "set samples instead")
    if not isinstance(size, tuple | list) or len(size) != 2:
        raise _arrays.wrong("size", size, "(width, height) in pixels")
    large = (_arrays.whole("size[0]", size[0]) * n, _arrays.whole("size[1]", size[1]) * n)
    # One point a sample, and T in no other place than once in the picture.
    fixed = {"antialiasing": 1, "technique": UNSHADOWED, "compositing": "opaque"}
    settings |= {"size": large, **fixed, "shadow_intensity": 1.0}
    alone = Scene(scene.shapes)
    with Renderer(alone, camera, **settings) as renderer:
        dark = renderer.render()
        receivers = renderer.receivers()
        lit = []
        for light in scene.lights:
            alone.add(light)
            lit.append(renderer.render())
            alone.remove(light)
    return PictureParts(dark, lit, receivers, n)


def traced(
    scene: Scene,
    parts: PictureParts,
    bias: Attribute | None = None,
    progress: Callable[[float], object] | None = None,
) -> _F32:
    """The picture of ``parts`` with a ray from each sample; ``bias`` None is the automatic one."""
    biases = parts.bias if bias is None else bias
    T = [
        trace_transmittance(scene, parts.points, light, bias=biases, progress=progress)
        for light in range(len(scene.lights))
    ]
    return parts.shaded(*T)


def traced_picture(
    scene: Scene,
    camera: Camera | None = None,
    size: tuple[int, int] = (256, 192),
    samples: int = 4,
    *,
    bias: Number | str = "auto",
    progress: Callable[[float], object] | None = None,
    **settings: Any,
) -> _F32:
    """The picture with ray-traced shadows: what every technique's picture is measured against.

    Args:
        scene: as for :class:`pyopacity.Renderer`. What is translucent looks opaque, as with
            ``compositing="opaque"``.
        camera: the default sees all of the scene.
        size: width and height in pixels.
        samples: n of n x n samples a pixel, 1 .. 8, each with a ray of its own. The renderer draws
            the same samples at ``antialiasing=n``.
        bias: world units toward the light within which casters do not count; "auto" is the
            renderer's own: the width of the strand, at least 1e-4 of the casters' radius.
        progress: called with the part of the rays that is done, 0 .. 1.
        settings: of the renderer: ``background``, ``ambient``, ``specular``, ``shininess``.

    Returns:
        (H, W, 4) float32, linear, premultiplied, top row first.

    Raises:
        ContextError: no OpenGL: the picture is rasterised, and only its T traced.
        ParameterError: a value outside its range; particles, or a volume.
    """
    parts = picture_parts(scene, camera or Camera.fit(scene), size, samples, **settings)
    if isinstance(bias, str):
        _arrays.choice("bias", bias, ("auto",))
        return traced(scene, parts, progress=progress)
    return traced(scene, parts, _arrays.number("bias", bias), progress)
