"""Hair, fur, grass."""

from typing import Any

import numpy as np
import numpy.typing as npt

from pyopacity import _arrays, _native
from pyopacity._arrays import Attribute, Color, Floats, Opacity
from pyopacity.shapes.shape import PointShape, one_or_all


class Strands(PointShape):
    """Hair, fur, grass: polylines with a width, seen as ribbons that face the light or the eye.

    Strand ``k`` is ``points[offsets[k]:offsets[k + 1]]``, root to tip.

    Args:
        points: (N, 3) float32 or float64, C order; kept as given.
        offsets: (S + 1,) of any integer dtype: from 0, never falling, to N.
        width: diameter in the shape's units, at least 0: a number for all, or (N,) float.
        opacity: the part of the light that a strand stops, in [0, 1]: a number for all, or (N,)
            float; three numbers, or (N, 3), for parts of red, green and blue. A strand thinner
            than a texel stops less, by the part of the texel it covers.
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
        opacity: Opacity = 0.3,
        color: Color = (0.6, 0.4, 0.25),
    ) -> None:
        super().__init__(
            _native.Strands(
                _arrays.floats("points", points, ("N", 3)),
                _arrays.integers("offsets", offsets, ("S+1",), np.int64),
                _arrays.attribute("width", width),
                _arrays.colors("color", color),
            ),
            opacity,
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
        return one_or_all(self._handle.width())

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
