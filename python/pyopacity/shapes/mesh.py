"""Triangles: bodies, grounds, leaves."""

from typing import Any, Literal, TypeAlias, get_args

import numpy as np
import numpy.typing as npt

from pyopacity import _arrays, _native
from pyopacity._arrays import Color, Floats, Image, Number, Opacity
from pyopacity.shapes.shape import PointShape

AlphaMode: TypeAlias = Literal["opaque", "mask", "blend"]


class Mesh(PointShape):
    """Triangles. Opacity 1 everywhere makes an opaque mesh: behind it there is no light at all.

    With an alpha map and a mode other than "opaque" it is foliage: light passes beside its leaves.

    Args:
        positions: (N, 3) float32 or float64, C order; kept as given.
        triangles: (M, 3) of any integer dtype: indices into ``positions``.
        normals: (N, 3) float, of any length; a zero, or None, stands for a smooth one, which is
            made from the triangles.
        opacity: the part of the light that the surface stops, in [0, 1]: a number, or (N,) float;
            three numbers, or (N, 3), for parts of red, green and blue.
        color: linear RGB in [0, 1e9]: three numbers for all, or (N, 3) float.
        uvs: (N, 2) float: where each point lies on the maps, whose top left corner is (0, 0); they
            repeat beyond 0 .. 1.
        alpha_map: (H, W) float32 in [0, 1], top row first: a factor of the opacity.
        alpha_mode: what it means: "opaque" nothing; "mask" that texels count as 1 from
            ``alpha_cutoff`` on, else as 0; "blend" itself. Seen from afar, alpha is averaged as the
            light that passes, so that a cut-out neither thins nor thickens.
        alpha_cutoff: in [0, 1].
        color_map: (H, W, 3) float32 in [0, 1e9], linear RGB: a factor of the colour.

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
        opacity: Opacity = 1.0,
        color: Color = (0.7, 0.7, 0.7),
        uvs: Floats | None = None,
        alpha_map: Image | None = None,
        alpha_mode: AlphaMode = "opaque",
        alpha_cutoff: Number = 0.5,
        color_map: Image | None = None,
    ) -> None:
        super().__init__(
            _native.Mesh(
                _arrays.floats("positions", positions, ("N", 3)),
                _arrays.integers("triangles", triangles, ("M", 3), np.uint32),
                _normals(normals),
                _arrays.colors("color", color),
            ),
            opacity,
        )
        self.uvs = uvs
        self._set_alpha(alpha_map, alpha_mode, alpha_cutoff)
        self.color_map = color_map

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
    def uvs(self) -> npt.NDArray[np.float32] | None:
        """Where each point lies on the maps, (N, 2) float32; None without maps.

        Raises:
            ParameterError: a wrong dtype, shape or order; a value that is not finite.
        """
        uvs: npt.NDArray[np.float32] = _arrays.read_only(self._handle.uvs())
        return uvs if uvs.size else None

    @uvs.setter
    def uvs(self, uvs: Floats | None) -> None:
        none = np.empty((0, 2), np.float32)
        self._handle.set_uvs(none if uvs is None else _arrays.floats("uvs", uvs, ("N", 2)))

    @property
    def alpha_map(self) -> Image | None:
        """The factor of the opacity, (H, W) float32 in [0, 1], or None."""
        image = self._handle.alpha()[0]
        return None if image is None else _arrays.read_only(image)

    @alpha_map.setter
    def alpha_map(self, alpha_map: Image | None) -> None:
        self._set_alpha(alpha_map, self.alpha_mode, self.alpha_cutoff)

    @property
    def alpha_mode(self) -> AlphaMode:
        """What the alpha map means: "opaque", "mask" or "blend"."""
        return self._handle.alpha()[1]

    @alpha_mode.setter
    def alpha_mode(self, alpha_mode: AlphaMode) -> None:
        self._set_alpha(self.alpha_map, alpha_mode, self.alpha_cutoff)

    @property
    def alpha_cutoff(self) -> float:
        """From where on a texel of a mask covers, in [0, 1]."""
        return _arrays.shortest(self._handle.alpha()[2])

    @alpha_cutoff.setter
    def alpha_cutoff(self, alpha_cutoff: Number) -> None:
        self._set_alpha(self.alpha_map, self.alpha_mode, alpha_cutoff)

    @property
    def color_map(self) -> Image | None:
        """The factor of the colour, (H, W, 3) float32, linear RGB, or None."""
        image = self._handle.color_map()
        return None if image is None else _arrays.read_only(image)

    @color_map.setter
    def color_map(self, color_map: Image | None) -> None:
        self._handle.set_color_map(_arrays.image("color_map", color_map, ("H", "W", 3)))

    def _set_alpha(self, image: Image | None, mode: str, cutoff: Number) -> None:
        _arrays.choice("alpha_mode", mode, get_args(AlphaMode))
        self._handle.set_alpha(
            _arrays.image("alpha_map", image, ("H", "W")),
            mode,
            _arrays.number("alpha_cutoff", cutoff),
        )

    @property
    def opaque(self) -> bool:
        """Whether its opacity is 1 everywhere, without alpha."""
        return self._handle.opaque()

    def __repr__(self) -> str:
        return f"<Mesh: {len(self.points)} points, {len(self.triangles)} triangles>"


def _normals(normals: Floats | None) -> Floats:
    if normals is None:
        return np.empty((0, 3), np.float32)
    return _arrays.floats("normals", normals, ("N", 3))
