"""Smoke, dust, foliage from afar."""

from typing import Literal, TypeAlias, get_args

import numpy as np
import numpy.typing as npt

from pyopacity import _arrays, _native
from pyopacity._arrays import Attribute, Color, Floats, Opacity
from pyopacity.shapes.shape import PointShape, one_or_all

Profile: TypeAlias = Literal["sphere", "metaball"]


class Particles(PointShape):
    """Round clouds, of constant density or denser toward their middle.

    A ray along a chord of length c meets the optical depth ``-log1p(-opacity) h`` of a sphere and
    ``-log1p(-opacity) h**5`` of a metaball, with ``h = c / (2 radius)``.

    Args:
        centers: (N, 3) float32 or float64, C order; kept as given. They are its :attr:`points`.
        radius: in the shape's units, at least 0: a number for all, or (N,) float.
        opacity: the part of the light that a particle stops through its centre, in [0, 1]: a number
            for all, or (N,) float; three numbers, or (N, 3), for parts of red, green and blue.
        color: linear RGB in [0, 1e9]: three numbers for all, or (N, 3) float.
        profile: how dense they are at the distance r from their middle, in radii: "sphere" the same
            everywhere; "metaball" as (1 - r^2)^2, which leaves no edge.

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
        opacity: Opacity = 0.1,
        color: Color = (0.8, 0.8, 0.8),
        profile: Profile = "sphere",
    ) -> None:
        _arrays.choice("profile", profile, get_args(Profile))
        super().__init__(
            _native.Particles(
                _arrays.floats("centers", centers, ("N", 3)),
                _arrays.attribute("radius", radius),
                _arrays.colors("color", color),
                profile,
            ),
            opacity,
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

    @property
    def profile(self) -> Profile:
        """How their density falls toward their surface: "sphere" or "metaball".

        Raises:
            ParameterError: another word.
        """
        return self._handle.profile()

    @profile.setter
    def profile(self, profile: Profile) -> None:
        _arrays.choice("profile", profile, get_args(Profile))
        self._handle.set_profile(profile)

    def __repr__(self) -> str:
        return f"<Particles: {len(self.points)} particles>"
