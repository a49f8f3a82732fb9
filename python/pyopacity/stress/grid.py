"""The texels of a light's map, for cases that put casters into them."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from pyopacity.scene import Scene
from pyopacity.shapes import Shape
from pyopacity.stress.bench import Bench
from pyopacity.stress.shapes import down, stack
from pyopacity.stress.way import exact

F64 = npt.NDArray[np.float64]
FAINT = 1e-9  # of opacity: less than float32 keeps of T


class Grid:
    """A map under a light from above, held in its place by two faint sheets.

    Attributes:
        size: texels along each side.
        texel: the side of one, in world units.
        shapes: the sheets, for every scene that is to have this map; 2 x 2 world units, depth 1.
        last: the depth of the lower one, in 0 .. 1: nothing else may lie below it.
    """

    def __init__(self, bench: Bench, size: int) -> None:
        self.size = size
        self.shapes: list[Shape] = [stack([0.0, -1.0], FAINT)]
        renderer = bench.renderer(exact(bench.devices[0]), Scene(*self.shapes, down()), size)
        renderer.transmittance(np.zeros((1, 3)))
        matrix = renderer.light_from_world
        self._to_world = np.linalg.inv(matrix)
        self.texel = 1.0 / float(np.linalg.norm(matrix[0, :3]))
        self.last = float(matrix[2, 3] - matrix[2, 2])

    def world(self, places: npt.ArrayLike) -> F64:
        """World positions of x and y in texels, depth in 0 .. 1: (N, 3)."""
        p = np.atleast_2d(np.asarray(places, np.float64))
        return np.ascontiguousarray(p @ self._to_world[:3, :3].T + self._to_world[:3, 3])

    def scene(self, *shapes: Shape) -> Scene:
        """These shapes in this map."""
        return Scene(*self.shapes, *shapes, down())
