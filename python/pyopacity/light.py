"""What lights a scene."""

from pyopacity import _arrays, _native
from pyopacity._arrays import Number, Vector
from pyopacity._attributes import Guarded


class DirectionalLight(Guarded):
    """A light at infinity.

    Args:
        direction: in which the light travels, three numbers, any length but 0.
        color: linear RGB, each in [0, 1e9].
        intensity: the factor of the colour, in [0, 1e9].

    Raises:
        ParameterError: a value outside its range.
    """

    __slots__ = ("_handle",)
    _handle: _native.DirectionalLight

    def __init__(
        self,
        direction: Vector = (0.5, 0.3, -0.8),
        color: Vector = (1.0, 1.0, 1.0),
        intensity: Number = 1.0,
    ) -> None:
        self._handle = _native.DirectionalLight(
            _arrays.vector("direction", direction),
            _arrays.vector("color", color),
            _arrays.number("intensity", intensity),
        )

    @property
    def direction(self) -> tuple[float, float, float]:
        """In which the light travels; comes back with length 1."""
        x, y, z = self._handle.direction()
        return x, y, z

    @direction.setter
    def direction(self, direction: Vector) -> None:
        self._handle.set_direction(_arrays.vector("direction", direction))

    @property
    def color(self) -> tuple[float, float, float]:
        """Linear RGB, each in [0, 1e9]."""
        r, g, b = (_arrays.shortest(value) for value in self._handle.color())
        return r, g, b

    @color.setter
    def color(self, color: Vector) -> None:
        self._handle.set_color(_arrays.vector("color", color))

    @property
    def intensity(self) -> float:
        """The factor of the colour, in [0, 1e9]."""
        return _arrays.shortest(self._handle.intensity())

    @intensity.setter
    def intensity(self, intensity: Number) -> None:
        self._handle.set_intensity(_arrays.number("intensity", intensity))

    def __repr__(self) -> str:
        direction = ", ".join(f"{value:.3g}" for value in self.direction)
        return f"<DirectionalLight: direction ({direction})>"
