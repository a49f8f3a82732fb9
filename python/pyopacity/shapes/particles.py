"""Smoke, dust, foliage from afar."""

import numpy as np
import numpy.typing as npt

from pyopacity import _arrays, _native
from pyopacity._arrays import Attribute, Color, Floats
from pyopacity.shapes.shape import PointShape, one_or_all


class Particles(PointShape):
    """Spheres of constant density.

    A ray along a chord of length c meets the optical depth ``-log1p(-opacity) c / (2 radius)``.

    Args:
        centers: (N, 3) float32 or float64, C order; kept as given. They are its :attr:`points`.
        radius: in the shape's units, at least 0: a number for all, or (N,) float.
        opacity: the part of the light that a particle stops through its centre, in [0, 1]: a number
            for all, or (N,) float.
        color: linear RGB in [0, 1e9]: three numbers for all, or (N, 3) float.

    Raises:
        ParameterError: a dtype, shape or order that is not taken; a value outside its range, named
            by its index.
    """

    __slots__ = ()
    _handle: _native.Particles

    def __init__(
        self,
        centers: Floats,
        radius: Attribute = 1.0,
        opacity: Attribute = 0.1,
        color: Color = (0.8, 0.8, 0.8),
    ) -> None:
        super().__init__(
            _native.Particles(
                _arrays.floats("centers", centers, ("N", 3)),
                _arrays.attribute("radius", radius),
                _arrays.attribute("opacity", opacity),
                _arrays.colors("color", color),
            )
        )

    @property
    def radius(self) -> float | npt.NDArray[np.float32]:
        """In the shape's units, at least 0: a number for all, or (N,) float. Kept as float32.

        Raises:
            ParameterError: a negative or infinite value, or NaN; a wrong number of them.
        """
        return one_or_all(self._handle.radius())

    @radius.setter
    def radius(self, radius: Attribute) -> None:
        self._handle.set_radius(_arrays.attribute("radius", radius))

    def __repr__(self) -> str:
        return f"<Particles: {len(self.points)} particles>"
