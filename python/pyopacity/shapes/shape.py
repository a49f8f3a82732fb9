"""What all shapes share."""

from typing import Self

import numpy as np
import numpy.typing as npt

from pyopacity import _arrays, _native
from pyopacity._arrays import Color, Floats, Opacity
from pyopacity._attributes import Guarded
from pyopacity.bounds import Bounds


def one_or_all(values: npt.NDArray[np.float32]) -> float | npt.NDArray[np.float32]:
    """An attribute that is one for all as a number, else as an array."""
    if values.size == 1:
        return _arrays.shortest(values[0])
    array: npt.NDArray[np.float32] = _arrays.read_only(values)
    return array


def one_or_all_colors(
    values: npt.NDArray[np.float32],
) -> tuple[float, float, float] | npt.NDArray[np.float32]:
    """The same of one that has a value a colour: (1, 3) as three numbers."""
    if len(values) == 1:
        r, g, b = (_arrays.shortest(value) for value in values[0])
        return r, g, b
    array: npt.NDArray[np.float32] = _arrays.read_only(values)
    return array


class Shape(Guarded):
    """What strands, meshes, particles and volumes share.

    Make one of those, or :func:`pyopacity.load` them.

    Everything is settable at any time, for animation: a change redoes only what depends on it.
    Arrays come back as read-only copies, because the engine keeps its own: assign a whole array
    instead of writing into one.
    """

    __slots__ = ("_handle",)
    _handle: _native.Shape

    def __init__(self, native: _native.Shape) -> None:
        self._handle = native

    @property
    def color(self) -> tuple[float, float, float] | npt.NDArray[np.float32]:
        """Linear RGB, each in [0, 1e9]: three numbers for all, or (N, 3) float. Kept as float32.

        Raises:
            ParameterError: a value outside its range, or NaN; a wrong number of them.
        """
        return one_or_all_colors(self._handle.color())

    @color.setter
    def color(self, color: Color) -> None:
        self._handle.set_color(_arrays.colors("color", color))

    @property
    def transform(self) -> npt.NDArray[np.float64]:
        """Shape to world, (4, 4) float64 by rows, for column vectors: ``[:3, 3]`` translates.

        Raises:
            ParameterError: a matrix that is not affine, not invertible, or not finite.
        """
        matrix: npt.NDArray[np.float64] = _arrays.read_only(self._handle.transform())
        return matrix

    @transform.setter
    def transform(self, transform: Floats) -> None:
        matrix = _arrays.floats("transform", transform, (4, 4))
        self._handle.set_transform(matrix.astype(np.float64, copy=False))

    @property
    def casts(self) -> bool:
        """Whether it casts shadows; it is seen either way."""
        return self._handle.casts()

    @casts.setter
    def casts(self, casts: bool) -> None:
        self._handle.set_casts(_arrays.flag("casts", casts))

    @property
    def receives(self) -> bool:
        """Whether shadows fall on it."""
        return self._handle.receives()

    @receives.setter
    def receives(self, receives: bool) -> None:
        self._handle.set_receives(_arrays.flag("receives", receives))

    @property
    def bounds(self) -> Bounds:
        """The axis-aligned box around it in world space, the width of strands included."""
        return Bounds.of(self._handle.bounds())

    def instance(self, transform: Floats | None = None) -> Self:
        """Another shape that shares this one's content, with a transform and flags of its own.

        A thousand trees then take the memory of one, here and on the GPU, until one of them gets
        other points, opacity or colour.

        Args:
            transform: as :attr:`transform`; None keeps this shape's.
        """
        copy = type(self).__new__(type(self))
        Shape.__init__(copy, self._handle.instance())
        if transform is not None:
            copy.transform = transform
        return copy


class PointShape(Shape):
    """A shape made of points that the caller gives, each with an opacity."""

    __slots__ = ()

    def __init__(self, native: _native.Shape, opacity: Opacity) -> None:
        super().__init__(native)
        self.opacity = opacity

    @property
    def points(self) -> Floats:
        """Vertices in the shape's own coordinates, (N, 3), float32 or float64 as they were given.

        The number of points stays what it is.

        Raises:
            ParameterError: another dtype, shape or order; a coordinate that is not finite, or
                beyond 1e18 in size.
        """
        points: Floats = _arrays.read_only(self._handle.points())
        return points

    @points.setter
    def points(self, points: Floats) -> None:
        self._handle.set_points(_arrays.floats("points", points, ("N", 3)))

    @property
    def opacity(self) -> float | tuple[float, float, float] | npt.NDArray[np.float32]:
        """The part of the light that one layer stops, in [0, 1]: a number for all, or (N,) float.

        Three numbers for all, or (N, 3) float, are parts of red, green and blue light; T is then
        (N, 3) too. An array of three is one a point where the shape has three points, else RGB. Its
        optical depth is ``-log1p(-opacity)``. Kept as float32.

        Raises:
            ParameterError: a value outside [0, 1] or NaN, named by its index; a wrong number of
                them.
        """
        rgb = self._handle.opacity_rgb()
        if rgb is None:
            return one_or_all(self._handle.opacity())
        return one_or_all_colors(rgb)

    @opacity.setter
    def opacity(self, opacity: Opacity) -> None:
        values, is_rgb = _arrays.opacity(opacity, self._handle.point_count())
        if is_rgb:
            self._handle.set_opacity_rgb(values)
        else:
            self._handle.set_opacity(values)
