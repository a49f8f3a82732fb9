"""What casts shadows and receives them: strands and meshes."""

from typing import Any

import numpy as np
import numpy.typing as npt

from pyopacity import _arrays, _native
from pyopacity._arrays import Attribute, Color, Floats
from pyopacity._attributes import Guarded
from pyopacity.bounds import Bounds


def _one_or_all(values: npt.NDArray[np.float32]) -> float | npt.NDArray[np.float32]:
    if values.size == 1:
        return _arrays.shortest(values[0])
    array: npt.NDArray[np.float32] = _arrays.read_only(values)
    return array


class Shape(Guarded):
    """What strands and meshes share. Make one of those, or :func:`pyopacity.load` them.

    Everything is settable at any time, for animation: a change redoes only what depends on it.
    Arrays come back as read-only copies, because the engine keeps its own: assign a whole array
    instead of writing into one.
    """

    __slots__ = ("_handle",)
    _handle: _native.Shape

    def __init__(self, native: _native.Shape) -> None:
        self._handle = native

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
    def opacity(self) -> float | npt.NDArray[np.float32]:
        """The part of the light that one layer stops, in [0, 1]: a number for all, or (N,) float.

        Its optical depth is ``-log1p(-opacity)``. Kept as float32.

        Raises:
            ParameterError: a value outside [0, 1] or NaN, named by its index; a wrong number of
                them.
        """
        return _one_or_all(self._handle.opacity())

    @opacity.setter
    def opacity(self, opacity: Attribute) -> None:
        self._handle.set_opacity(_arrays.attribute("opacity", opacity))

    @property
    def color(self) -> tuple[float, float, float] | npt.NDArray[np.float32]:
        """Linear RGB, each in [0, 1e9]: three numbers for all, or (N, 3) float. Kept as float32.

        Raises:
            ParameterError: a value outside its range, or NaN; a wrong number of them.
        """
        colors = self._handle.color()
        if len(colors) == 1:
            r, g, b = (_arrays.shortest(value) for value in colors[0])
            return r, g, b
        array: npt.NDArray[np.float32] = _arrays.read_only(colors)
        return array

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


class Strands(Shape):
    """Hair, fur, grass: polylines with a width, seen as ribbons that face the light or the eye.

    Strand ``k`` is ``points[offsets[k]:offsets[k + 1]]``, root to tip.

    Args:
        points: (N, 3) float32 or float64, C order; kept as given.
        offsets: (S + 1,) of any integer dtype: from 0, never falling, to N.
        width: diameter in the shape's units, at least 0: a number for all, or (N,) float.
        opacity: the part of the light that a strand stops, in [0, 1]: a number for all, or (N,)
            float. A strand thinner than a texel stops less, by the part of the texel it covers.
        color: linear RGB in [0, 1e9]: three numbers for all, or (N, 3) float.

    Raises:
        ParameterError: a dtype, shape or order that is not taken; a value outside its range, named
            by its index; offsets that do not fit the points.
    """

    __slots__ = ()
    _handle: _native.Strands

    def __init__(
        self,
        points: Floats,
        offsets: npt.NDArray[np.integer[Any]],
        width: Attribute = 0.1,
        opacity: Attribute = 0.3,
        color: Color = (0.6, 0.4, 0.25),
    ) -> None:
        super().__init__(
            _native.Strands(
                _arrays.floats("points", points, ("N", 3)),
                _arrays.integers("offsets", offsets, ("S+1",), np.int64),
                _arrays.attribute("width", width),
                _arrays.attribute("opacity", opacity),
                _arrays.colors("color", color),
            )
        )

    @property
    def offsets(self) -> npt.NDArray[np.int64]:
        """Where each strand starts in ``points``, (S + 1,); fixed."""
        offsets: npt.NDArray[np.int64] = _arrays.read_only(self._handle.offsets())
        return offsets

    @property
    def width(self) -> float | npt.NDArray[np.float32]:
        """Diameter in the shape's units, at least 0: a number for all, or (N,) float.

        Kept as float32.

        Raises:
            ParameterError: a negative or infinite value, or NaN; a wrong number of them.
        """
        return _one_or_all(self._handle.width())

    @width.setter
    def width(self, width: Attribute) -> None:
        self._handle.set_width(_arrays.attribute("width", width))

    @property
    def segment_count(self) -> int:
        """How many straight pieces the strands have."""
        return self._handle.segment_count()

    def __repr__(self) -> str:
        return (
            f"<Strands: {len(self._handle.offsets()) - 1} strands, {self.segment_count} segments>"
        )


class Mesh(Shape):
    """Triangles. Opacity 1 everywhere makes an opaque mesh: behind it there is no light at all.

    Args:
        positions: (N, 3) float32 or float64, C order; kept as given.
        triangles: (M, 3) of any integer dtype: indices into ``positions``.
        normals: (N, 3) float, of any length; a zero, or None, stands for a smooth one, which is
            made from the triangles.
        opacity: the part of the light that the surface stops, in [0, 1]: a number, or (N,) float.
        color: linear RGB in [0, 1e9]: three numbers for all, or (N, 3) float.

    Raises:
        ParameterError: a dtype, shape or order that is not taken; a value outside its range, or an
            index without a point, each named.
    """

    __slots__ = ()
    _handle: _native.Mesh

    def __init__(
        self,
        positions: Floats,
        triangles: npt.NDArray[np.integer[Any]],
        normals: Floats | None = None,
        *,
        opacity: Attribute = 1.0,
        color: Color = (0.7, 0.7, 0.7),
    ) -> None:
        super().__init__(
            _native.Mesh(
                _arrays.floats("positions", positions, ("N", 3)),
                _arrays.integers("triangles", triangles, ("M", 3), np.uint32),
                _normals(normals),
                _arrays.attribute("opacity", opacity),
                _arrays.colors("color", color),
            )
        )

    @property
    def triangles(self) -> npt.NDArray[np.uint32]:
        """Three indices into ``points`` a triangle, (M, 3); fixed."""
        triangles: npt.NDArray[np.uint32] = _arrays.read_only(self._handle.triangles())
        return triangles

    @property
    def normals(self) -> npt.NDArray[np.float32]:
        """Unit normals, (N, 3) float32. Set None to have smooth ones made from the triangles.

        Raises:
            ParameterError: a wrong dtype, shape or order; a value that is not finite.
        """
        normals: npt.NDArray[np.float32] = _arrays.read_only(self._handle.normals())
        return normals

    @normals.setter
    def normals(self, normals: Floats | None) -> None:
        self._handle.set_normals(_normals(normals))

    @property
    def opaque(self) -> bool:
        """Whether its opacity is 1 everywhere."""
        return self._handle.opaque()

    def __repr__(self) -> str:
        return f"<Mesh: {len(self.points)} points, {len(self.triangles)} triangles>"


def _normals(normals: Floats | None) -> Floats:
    if normals is None:
        return np.empty((0, 3), np.float32)
    return _arrays.floats("normals", normals, ("N", 3))


def wrap(native: _native.Shape) -> Shape:
    """The public class around a shape that the engine made."""
    cls = Strands if isinstance(native, _native.Strands) else Mesh
    shape = cls.__new__(cls)
    Shape.__init__(shape, native)
    return shape
