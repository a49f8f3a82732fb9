"""T without a renderer to keep: one call, and no OpenGL."""

from typing import Literal

import numpy as np
import numpy.typing as npt

from pyopacity._arrays import Floats
from pyopacity.renderer import Renderer
from pyopacity.scene import Scene
from pyopacity.shapes import Shape
from pyopacity.technique import Technique


def transmittance(
    scene: Scene,
    points: Floats | Shape,
    technique: str | Technique = "bounding_opacity_maps",
    map_size: int | Literal["auto"] = 512,
    light: int = 0,
) -> npt.NDArray[np.float32]:
    """The part of a light that arrives at points, by the same maps on the CPU: no OpenGL at all.

    To ask more than once keep a ``Renderer(scene, device="cpu")``, which skips what has not
    changed.

    Args:
        scene: what casts, and the lights.
        points: world positions, (N, 3) float32 or float64; or a shape: its own points.
        technique: a name, or what :func:`pyopacity.technique` makes.
        map_size: texels along each side of the light's map, 1..16384, or "auto".
        light: index into ``scene.lights``.

    Returns:
        (N,) float32 in [0, 1], or (N, 3); see :meth:`Renderer.transmittance`.

    Raises:
        ParameterError: as :meth:`Renderer.transmittance`; or a technique that has no form in C++.
    """
    with Renderer(scene, technique=technique, device="cpu", map_size=map_size) as renderer:
        return renderer.transmittance(points, light)
