"""Smoke and clouds as voxels."""

import numpy as np
import numpy.typing as npt

from pyopacity import _arrays, _native
from pyopacity._arrays import Floats, Vector
from pyopacity.shapes.shape import Shape


class Volume(Shape):
    """A box of voxels that take light away.

    Args:
        extinction: (Z, Y, X) float32 or float64, C order, in [0, 1e18]: optical depth per unit of
            length in the shape's coordinates, constant within a voxel. Kept as float32. A transform
            that scales the shape keeps what it lets through as a whole.
        origin: the middle of voxel ``[0, 0, 0]``: x, y, z in the shape's coordinates.
        spacing: from one voxel's middle to the next: a number, or three along x, y and z, above 0.
        color: linear RGB in [0, 1e9]: the part of the light that is scattered, not absorbed.

    Raises:
        ParameterError: a dtype, shape or order that is not taken; a value outside its range, named
            by its index in C order; more than 2048 voxels along a side.
    """

    __slots__ = ()
    _handle: _native.Volume

    def __init__(
        self,
        extinction: Floats,
        origin: Vector = (0.0, 0.0, 0.0),
        spacing: float | Vector = 1.0,
        color: Vector = (0.8, 0.8, 0.8),
    ) -> None:
        super().__init__(
            _native.Volume(
                _arrays.floats("extinction", extinction, ("Z", "Y", "X")),
                _arrays.vector("origin", origin),
                _spacing(spacing),
                _arrays.vector("color", color),
            )
        )

    @property
    def extinction(self) -> npt.NDArray[np.float32]:
        """(Z, Y, X) float32, optical depth per unit of length; the number of voxels stays.

        Raises:
            ParameterError: a wrong dtype, shape or order; a value outside [0, 1e18], or NaN.
        """
        extinction: npt.NDArray[np.float32] = _arrays.read_only(self._handle.extinction())
        return extinction

    @extinction.setter
    def extinction(self, extinction: Floats) -> None:
        shape = self._handle.size_zyx()
        self._handle.set_extinction(_arrays.floats("extinction", extinction, tuple(shape)))

    @property
    def origin(self) -> tuple[float, float, float]:
        """The middle of voxel [0, 0, 0] in the shape's coordinates."""
        x, y, z = self._handle.origin()
        return x, y, z

    @origin.setter
    def origin(self, origin: Vector) -> None:
        self._handle.set_grid(_arrays.vector("origin", origin), self.spacing)

    @property
    def spacing(self) -> tuple[float, float, float]:
        """From one voxel's middle to the next along x, y and z; a number sets all three."""
        x, y, z = self._handle.spacing()
        return x, y, z

    @spacing.setter
    def spacing(self, spacing: float | Vector) -> None:
        self._handle.set_grid(self.origin, _spacing(spacing))

    def __repr__(self) -> str:
        z, y, x = self._handle.size_zyx()
        return f"<Volume: {x} x {y} x {z} voxels>"


def _spacing(spacing: float | Vector) -> tuple[float, float, float]:
    if _arrays.is_number(spacing):
        same = _arrays.number("spacing", spacing)
        return same, same, same
    return _arrays.vector("spacing", spacing)
