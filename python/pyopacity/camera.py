"""From where a picture is taken."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from pyopacity import _arrays, _native
from pyopacity._arrays import Number, Vector
from pyopacity._attributes import Guarded
from pyopacity.bounds import Bounds
from pyopacity.scene import Scene
from pyopacity.shapes import Shape


class Camera(Guarded):
    """A perspective camera, made by :meth:`look_at` or :meth:`fit`; a value that never changes."""

    __slots__ = ("_handle",)
    _handle: _native.Camera

    def __init__(self, native: _native.Camera) -> None:
        self._handle = native

    @classmethod
    def look_at(
        cls,
        eye: Vector,
        target: Vector,
        up: Vector = (0.0, 0.0, 1.0),
        fov_deg: Number = 35.0,
    ) -> Camera:
        """A camera at ``eye`` that looks at ``target``.

        Args:
            eye, target: world positions, three numbers each, not the same.
            up: any direction that is not parallel to the view.
            fov_deg: vertical field of view in degrees, 1 .. 170.

        Raises:
            ParameterError: one of these does not hold.
        """
        return cls(
            _native.Camera.look_at(
                _arrays.vector("eye", eye),
                _arrays.vector("target", target),
                _arrays.vector("up", up),
                _arrays.number("fov_deg", fov_deg),
            )
        )

    @classmethod
    def fit(
        cls,
        what: Scene | Shape | Iterable[Shape],
        direction: Vector = (0.3, 1.0, -0.25),
        up: Vector = (0.0, 0.0, 1.0),
        fov_deg: Number = 35.0,
    ) -> Camera:
        """A camera that sees all of a scene, or all of some shapes.

        Args:
            what: a scene, a shape, or shapes; where a wide ground need not be in view, the others.
            direction: in which it looks, any length but 0.
            up: any direction that is not parallel to the view.
            fov_deg: vertical field of view in degrees, 1 .. 170.

        Raises:
            ParameterError: one of these does not hold.
        """
        bounds = _bounds_of(what)
        x, y, z = bounds.min.tolist()
        to_x, to_y, to_z = bounds.max.tolist()
        return cls(
            _native.Camera.fit(
                (x, y, z),
                (to_x, to_y, to_z),
                _arrays.vector("direction", direction),
                _arrays.vector("up", up),
                _arrays.number("fov_deg", fov_deg),
            )
        )

    @property
    def eye(self) -> tuple[float, float, float]:
        """Where it stands, in world space."""
        x, y, z = self._handle.eye()
        return x, y, z

    @property
    def target(self) -> tuple[float, float, float]:
        """The point in the middle of the picture, in world space."""
        x, y, z = self._handle.target()
        return x, y, z

    @property
    def up(self) -> tuple[float, float, float]:
        """The direction that points up in the picture, as it was given."""
        x, y, z = self._handle.up()
        return x, y, z

    @property
    def fov_deg(self) -> float:
        """The vertical field of view in degrees."""
        return self._handle.fov_deg()

    @property
    def view_from_world(self) -> npt.NDArray[np.float64]:
        """World to view, (4, 4) float64 by rows: x right, y up, looking along -z."""
        matrix: npt.NDArray[np.float64] = _arrays.read_only(self._handle.view_from_world())
        return matrix

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Camera) and self._handle.equals(other._handle)

    def __hash__(self) -> int:
        return hash((self.eye, self.target, self.up, self.fov_deg))

    def __repr__(self) -> str:
        return f"<Camera: eye {self.eye}, target {self.target}, {self.fov_deg:g} degrees>"


def _bounds_of(what: object) -> Bounds:
    if isinstance(what, Scene | Shape):
        return what.bounds
    boxes = []
    for shape in what if isinstance(what, Iterable) else [what]:
        if not isinstance(shape, Shape):
            raise _arrays.wrong("what the camera fits", shape, "a scene, a shape, or shapes")
        boxes.append(shape.bounds)
    return Bounds.union(boxes)
