"""Truth by rays: how much light reaches a point through the real geometry."""

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from pyopacity import _arrays, _native
from pyopacity._arrays import Attribute, Floats
from pyopacity.errors import ParameterError
from pyopacity.scene import Scene
from pyopacity.shapes import Shape


def trace_transmittance(
    scene: Scene,
    points: Floats | Shape,
    light: int = 0,
    footprint: Attribute = 0.0,
    samples: int = 64,
    *,
    bias: Attribute | str = "auto",
    indices: npt.NDArray[np.integer[Any]] | None = None,
    backend: str = "auto",
    progress: Callable[[float], object] | None = None,
) -> npt.NDArray[np.float32]:
    """The part of a light that arrives at points, in [0, 1], by rays: what maps are measured by.

    T is the product of 1 - opacity over what lies between the point and the light; 0 behind an
    opaque mesh, and 1 where the scene has no light. Of an area light it is the mean over its
    points; neither attenuation nor the cone of a spot light changes it. Strands are ribbons of
    their width that face the light. A strand is crossed once by each connected stretch of it that
    stays within half its width of the ray, so that a joint neither counts twice nor leaves a gap. A
    ray through an edge that triangles share crosses one of them; an alpha map multiplies their
    opacity. Particles and voxels are intervals of the ray, and count as far as they are in front.
    All in float64, on all cores, without OpenGL; the result depends on neither the number of
    threads nor the backend. Ctrl-C stops it.

    Args:
        scene: its shapes that cast, as they are now.
        points: world positions, (N, 3) float32 or float64; or a shape: its own points, moved by its
            transform in float64, of a volume the centres of its voxels, x fastest. At its own
            centre a particle does not count, nor half of a voxel.
        light: index into ``scene.lights``.
        footprint: side, in world units and at least 0, of a square about each point and across its
            ray; under a directional light, along the axes of its map. T is its mean over the
            square. A number, or (N,) float. With 0 there is one ray, through the point, whatever
            ``samples`` is.
        samples: rays to a footprint, 1 to 65536, one at a random place in each of as many parts of
            equal area. The places follow from the indices of point and ray alone.
        bias: casters nearer than this toward the light do not count, so that a strand does not
            shadow itself. World units, at least 0: a number, or (N,) float. "auto" is the mean
            width of a shape's strands, for points that of the scene's, and at least 1e-4 of the
            radius of the translucent casters.
        indices: (N,) of any integer dtype: of a shape's points, those that are asked about, in this
            order; None for all.
        backend: "embree", "builtin", or "auto", the first of :func:`trace_backends`.
        progress: called with the fraction done, some twenty times a second and with 1 at the end.

    Returns:
        (N,) float32; (N, 3), red, green and blue, where a shape of the scene has an opacity or
        extinction a colour.

    Raises:
        ParameterError: another dtype, shape or order; a point that is not finite, named by its
            index; a number outside its range; a light that is not there; a backend that this build
            does not have.

    Source: docs/accuracy.md, "Truth by rays"; sections 1 to 3 of the definitions there.
    """
    if not isinstance(scene, Scene):
        raise _arrays.wrong("scene", scene, "a pyopacity.Scene")
    if progress is not None and not callable(progress):
        raise _arrays.wrong(
            "progress", progress, "a function that takes the fraction done, or None"
        )
    if not isinstance(backend, str):
        raise _arrays.wrong("backend", backend, '"auto", or one of pyopacity.trace_backends()')
    asks_none = not isinstance(points, Shape) and np.size(points) == 0
    settings = (
        _arrays.whole("light", light),
        _lengths("footprint", footprint, asks_none),
        _arrays.whole("samples", samples),
        _bias(bias, asks_none),
        None if indices is None else _arrays.integers("indices", indices, ("N",), np.uint32),
        backend,
        progress,
    )
    if isinstance(points, Shape):
        return _native.trace_transmittance_of(scene._handle, points._handle, *settings)
    xyz = _arrays.floats("points", points, ("N", 3))
    return _native.trace_transmittance(scene._handle, xyz, *settings)


def trace_backends() -> tuple[str, ...]:
    """What can find the casters near a ray in this build, the faster first.

    "builtin" is always there; "embree" where Embree 3 or 4 was found when this was built. Both give
    the same bits.
    """
    return tuple(_native.trace_backends())


def _bias(bias: Attribute | str, asks_none: bool) -> npt.NDArray[np.float64]:
    """As the engine takes it: none for "auto"."""
    if isinstance(bias, str):
        _arrays.choice("bias", bias, ("auto",))
        return np.empty(0)
    return _lengths("bias", bias, asks_none)


def _lengths(name: str, lengths: Attribute, asks_none: bool) -> npt.NDArray[np.float64]:
    values = _arrays.attribute(name, lengths).astype(np.float64, copy=False)
    if values.size == 0 and not asks_none:
        raise ParameterError(f"{name} is empty", "pass a number, or one a point")
    return values
