"""What tests of layered techniques measure against exact lists of the same map."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

import pyopacity as po

LIGHT = (0.5, 0.3, -0.8)
Array = npt.NDArray[np.float32]


def hair(segments: int = 15000) -> tuple[po.Scene, po.Shape]:
    """The demo's hair with the width and opacity of a denser one."""
    scene = po.Scene(po.load(f"demo:hair?segments={segments}"), po.DirectionalLight(LIGHT))
    strands = scene.shapes[0]
    strands.opacity, strands.width = 0.3, 0.15
    return scene, strands


class Errors:
    """T of techniques at a shape's vertices, and of `exact`; without OpenGL."""

    def __init__(self, scene: po.Scene, shape: po.Shape, map_size: int = 128) -> None:
        self.scene, self.shape, self.map_size = scene, shape, map_size
        self.exact = self.ask("exact")

    def ask(self, name: str, **parameters: Any) -> Array:
        technique = po.technique(name, **parameters)
        with po.Renderer(
            self.scene, device="cpu", technique=technique, map_size=self.map_size
        ) as renderer:
            T = renderer.transmittance(self.shape)
            self.light_from_world = renderer.light_from_world
        return T

    def of(self, name: str, **parameters: Any) -> Array:
        return self.ask(name, **parameters) - self.exact

    @property
    def depth_range(self) -> float:
        """From the first caster to the last, in world units."""
        return float(1.0 / np.linalg.norm(self.light_from_world[2, :3]))

    @property
    def is_lit(self) -> npt.NDArray[np.bool_]:
        """The lit surface, where an error shows most."""
        return self.exact >= 0.95

    def bands(self, slices: int, name: str, **parameters: Any) -> float:
        """How much darker the lit surface is inside of so many even slices than at their planes.

        Inside, a look-up counts casters of the slice that lie behind the surface; at a plane none.
        """
        error = self.of(name, **parameters)
        points = np.asarray(self.shape.points, np.float64)
        depth = points @ self.light_from_world[2, :3] + self.light_from_world[2, 3]
        along = (slices * depth) % 1.0
        is_inside = (along > 0.4) & (along < 0.8)
        at_planes = (along < 0.1) | (along > 0.95)
        return float(error[self.is_lit & at_planes].mean() - error[self.is_lit & is_inside].mean())


def rmse(error: Array) -> float:
    return float(np.sqrt(np.mean(np.square(error, dtype=np.float64))))
