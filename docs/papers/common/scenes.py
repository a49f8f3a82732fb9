"""Generated scenes as the papers light them, and techniques as the papers publish them."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

import pyopacity as po

Vector = tuple[float, float, float]
Points = npt.NDArray[np.float64]

LIGHT = (0.5, 0.3, -0.8)
ABOVE, SIDEWAYS = (0.15, 0.1, -1.0), (1.0, 0.3, -0.25)
FRONT, LEFT = (0.3, 1.0, -0.25), (0.4, -1.0, -0.3)  # in which a camera looks
SKY = (0.42, 0.54, 0.68, 1.0)

# The papers interpolate linearly, know no shadow of a receiver's own, and blend; the thesis draws
# the last depths in a pass of their own, with near and far plane swapped.
PUBLISHED: dict[str, dict[str, Any]] = {
    "opacity_shadow_maps": {"own_correction": False, "deposit": "blend"},
    "deep_opacity_maps": {"own_correction": False, "deposit": "blend"},
    "bounding_opacity_maps": {
        "own_correction": False,
        "deposit": "blend",
        "interpolation": "linear",
        "split": "hybrid",
        "bounds": "swapped_planes",
    },
    "fourier_opacity_maps": {"own_correction": False},
    "density_clustering": {"own_correction": False},
}


def published(name: str, **parameters: Any) -> po.Technique:
    """As in its paper."""
    return po.technique(name, **{**PUBLISHED.get(name, {}), **parameters})


def lit(file: str, *directions: Vector, intensity: float = 1.3) -> po.Scene:
    """A generated scene under directional lights; more of them are dimmer each."""
    scene = po.Scene(po.load(file))
    for direction in directions or (LIGHT,):
        scene.add(po.DirectionalLight(direction, intensity=intensity / max(len(directions), 1)))
    return scene


def casters(scene: po.Scene) -> list[po.Shape]:
    """All but the ground."""
    return [shape for shape in scene.shapes if shape.casts]


def strands(scene: po.Scene) -> po.Strands:
    """The first."""
    return next(shape for shape in scene.shapes if isinstance(shape, po.Strands))


def camera(scene: po.Scene, direction: Vector = FRONT, zoom: float = 1.0) -> po.Camera:
    """Sees what casts, or its middle from nearer."""
    fitted = po.Camera.fit(casters(scene), direction)
    x, y, z = np.add(fitted.target, np.subtract(fitted.eye, fitted.target) / zoom)
    return po.Camera.look_at((x, y, z), fitted.target, fitted.up, fitted.fov_deg)


def renderer(
    scene: po.Scene, view: po.Camera, size: tuple[int, int], map_size: int, **settings: Any
) -> po.Renderer:
    """Of opaque pictures, so that only the shadow differs, which each sample looks up."""
    defaults: dict[str, Any] = {"compositing": "opaque", "strand_look_up": "per_sample"}
    defaults |= {"background": SKY, "antialiasing": 2}
    return po.Renderer(scene, view, size=size, map_size=map_size, **{**defaults, **settings})


def seen(pictures: po.Renderer) -> Points:
    """(N, 3): the points at which its picture looks T up."""
    receivers = pictures.receivers()
    return receivers.points[receivers.mask]


# Half the side of a sheet. Behind surfaces a map leaves some texels of depth free, which should be
# small beside depths of 0 to 1.
HALF = 0.02


def sheets(depths: Points, opacities: Points) -> po.Mesh:
    """Squares across the light (0, 0, -1), at depths behind z = 0, each of an opacity."""
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float64) * HALF
    corners = (square - np.asarray(depths)[:, None, None] * (0, 0, 1)).reshape(-1, 3)
    quad = np.array([[0, 1, 2], [0, 2, 3]])
    faces = (4 * np.arange(len(depths))[:, None, None] + quad).reshape(-1, 3)
    return po.Mesh(corners, faces, opacity=np.repeat(opacities, 4))


def along_a_ray(
    technique: po.Technique, casting: po.Mesh, depths: Points, map_size: int = 16
) -> npt.NDArray[np.float32]:
    """T at depths of one ray through sheets; maps of the CPU, which are the GPU's."""
    scene = po.Scene(casting, po.DirectionalLight((0, 0, -1)))
    aside = np.full(len(depths), 0.1 * HALF)
    points = np.stack([aside, aside, -depths], axis=1)
    technique.bias = 0.0
    with po.Renderer(scene, technique=technique, device="cpu", map_size=map_size) as used:
        return used.transmittance(points)


def real_model(name: str) -> list[po.Shape] | None:
    """One of benchmarks/real_models.py, or None where PYOPACITY_DATA has no such file."""
    sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "benchmarks"))
    import real_models

    try:
        return real_models.model(name).make()
    except po.FileFormatError:
        return None
