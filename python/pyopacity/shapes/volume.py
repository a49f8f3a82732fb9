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
            that scales the shape keeps what it lets through as a whole. (Z, Y, X, 3) for red, green
            and blue light; T is then (N, 3).
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
        checked = _extinction(extinction, ("Z", "Y", "X"))
        super().__init__(
            _native.Volume(
                np.zeros(checked.shape[:3], np.float32),
                _arrays.vector("origin", origin),
                _spacing(spacing),
                _arrays.vector("color", color),
            )
        )
        self.extinction = checked

    @property
    def extinction(self) -> npt.NDArray[np.float32]:
        """(Z, Y, X) float32, optical depth per unit of length; the number of voxels stays.

        (Z, Y, X, 3) for red, green and blue light.

        Raises:
            ParameterError: a wrong dtype, shape or order; a value outside [0, 1e18], or NaN.
        """
        rgb = self._handle.extinction_rgb()
        extinction: npt.NDArray[np.float32] = _arrays.read_only(
            self._handle.extinction() if rgb is None else rgb
        )
        return extinction

    @extinction.setter
    def extinction(self, extinction: Floats) -> None:
        checked = _extinction(extinction, tuple(self._handle.size_zyx()))
        if checked.ndim > 3:
            self._handle.set_extinction_rgb(checked)
        else:
            self._handle.set_extinction(checked)

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


def _extinction(extinction: object, size_zyx: tuple[str | int, ...]) -> Floats:
    is_rgb = isinstance(extinction, np.ndarray) and extinction.ndim == 4
    return _arrays.floats("extinction", extinction, (*size_zyx, 3) if is_rgb else size_zyx)


def _spacing(spacing: float | Vector) -> tuple[float, float, float]:
    if _arrays.is_number(spacing):
        same = _arrays.number("spacing", spacing)
        return same, same, same
    return _arrays.vector("spacing", spacing)
