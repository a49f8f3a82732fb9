"""What lights a scene."""

from pyopacity import _arrays, _native
from pyopacity._arrays import Number, Vector
from pyopacity._attributes import Guarded
from pyopacity.errors import ParameterError
from pyopacity.technique import Technique
from pyopacity.technique import technique as make_technique

_WHITE = (1.0, 1.0, 1.0)


class Light(Guarded):
    """What all lights share. Make one of the kinds below.

    Everything is settable at any time: a change redoes only what depends on it.
    """

    __slots__ = ("_handle", "_technique")
    _handle: _native.Light
    _technique: Technique | None

    def __init__(
        self, native: _native.Light, technique: str | Technique | None, map_size: object
    ) -> None:
        self._handle = native
        self.technique = technique
        self.map_size = map_size

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

    @property
    def technique(self) -> Technique | None:
        """Its own shadow method: a name, or a technique; None for that of the renderer."""
        return self._technique

    @technique.setter
    def technique(self, technique: str | Technique | None) -> None:
        own = make_technique(technique) if isinstance(technique, str) else technique
        if own is not None and not isinstance(own, Technique):
            raise _arrays.wrong("technique", technique, "a name, a technique, or None")
        self._handle.set_technique(None if own is None else own._handle)
        self._technique = own

    @property
    def map_size(self) -> int | None:
        """Texels along each side of its maps, 1..16384; None for that of the renderer."""
        return self._handle.map_size() or None

    @map_size.setter
    def map_size(self, map_size: object) -> None:
        if map_size is None:
            self._handle.set_map_size(0)
            return
        texels = _arrays.whole("map_size", map_size)
        if texels == 0:
            raise ParameterError("map_size = 0 is outside 1..16384", "choose one inside it")
        self._handle.set_map_size(texels)


class _Directed(Light):
    """What lights with a direction share."""

    __slots__ = ()
    _handle: _native.DirectionalLight | _native.SpotLight

    @property
    def direction(self) -> tuple[float, float, float]:
        """In which the light travels, of a spot its middle; comes back with length 1."""
        x, y, z = self._handle.direction()
        return x, y, z

    @direction.setter
    def direction(self, direction: Vector) -> None:
        self._handle.set_direction(_arrays.vector("direction", direction))


class DirectionalLight(_Directed):
    """A light at infinity.

    Args:
        direction: in which the light travels, three numbers, any length but 0.
        color: linear RGB, each in [0, 1e9].
        intensity: the factor of the colour, in [0, 1e9].
        technique: its own shadow method, a name or a technique; None for that of the renderer.
        map_size: texels along each side of its maps; None for that of the renderer.

    Raises:
        ParameterError: a value outside its range.
    """

    __slots__ = ()
    _handle: _native.DirectionalLight

    def __init__(
        self,
        direction: Vector = (0.5, 0.3, -0.8),
        color: Vector = _WHITE,
        intensity: Number = 1.0,
        *,
        technique: str | Technique | None = None,
        map_size: int | None = None,
    ) -> None:
        native = _native.DirectionalLight(
            _arrays.vector("direction", direction),
            _arrays.vector("color", color),
            _arrays.number("intensity", intensity),
        )
        super().__init__(native, technique, map_size)

    def __repr__(self) -> str:
        return f"<DirectionalLight: direction {_text(self.direction)}>"


class PositionalLight(Light):
    """What lights at a place share."""

    __slots__ = ()
    _handle: _native.PositionalLight

    @property
    def position(self) -> tuple[float, float, float]:
        """In world units."""
        x, y, z = self._handle.position()
        return x, y, z

    @position.setter
    def position(self, position: Vector) -> None:
        self._handle.set_position(_arrays.vector("position", position))

    @property
    def attenuation(self) -> tuple[float, float, float]:
        """(c, l, q): at a distance d what arrives is divided by c + l d + q d^2.

        None is below 0, and not all are 0. (1, 0, 0) is no attenuation, (0, 0, 1) that of nature.
        It does not change T, which tells shadows alone.
        """
        c, l, q = self._handle.attenuation()  # noqa: E741
        return c, l, q

    @attenuation.setter
    def attenuation(self, attenuation: Vector) -> None:
        self._handle.set_attenuation(_arrays.vector("attenuation", attenuation))

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: at {_text(self.position)}>"


class PointLight(PositionalLight):
    """A light that shines in all directions from a point.

    Args:
        position: in world units.
        color: linear RGB, each in [0, 1e9].
        intensity: the factor of the colour, in [0, 1e9].
        attenuation: see :attr:`attenuation`.
        technique: its own shadow method, a name or a technique; None for that of the renderer.
        map_size: texels along each side of each of its maps; None for that of the renderer. Where
            the casters lie around it there are six, the faces of a cube.

    Raises:
        ParameterError: a value outside its range.
    """

    __slots__ = ()

    def __init__(
        self,
        position: Vector,
        color: Vector = _WHITE,
        intensity: Number = 1.0,
        *,
        attenuation: Vector = (1.0, 0.0, 0.0),
        technique: str | Technique | None = None,
        map_size: int | None = None,
    ) -> None:
        native = _native.PointLight(
            _arrays.vector("position", position),
            _arrays.vector("color", color),
            _arrays.number("intensity", intensity),
        )
        super().__init__(native, technique, map_size)
        self.attenuation = attenuation


class SpotLight(PositionalLight, _Directed):
    """A light that shines from a point into a cone.

    Args:
        position: in world units.
        direction: the middle of the cone, three numbers, any length but 0.
        angle_deg: the cone's full angle in degrees, 1..170.
        color: linear RGB, each in [0, 1e9].
        intensity: the factor of the colour, in [0, 1e9].
        softness: the part of the cone's half angle over which its edge fades, 0..1.
        attenuation: see :attr:`attenuation`.
        technique: its own shadow method, a name or a technique; None for that of the renderer.
        map_size: texels along each side of its map; None for that of the renderer.

    Raises:
        ParameterError: a value outside its range.
    """

    __slots__ = ()
    _handle: _native.SpotLight

    def __init__(
        self,
        position: Vector,
        direction: Vector,
        angle_deg: Number = 45.0,
        color: Vector = _WHITE,
        intensity: Number = 1.0,
        *,
        softness: Number = 0.1,
        attenuation: Vector = (1.0, 0.0, 0.0),
        technique: str | Technique | None = None,
        map_size: int | None = None,
    ) -> None:
        native = _native.SpotLight(
            _arrays.vector("position", position),
            _arrays.vector("direction", direction),
            _arrays.number("angle_deg", angle_deg),
            _arrays.vector("color", color),
            _arrays.number("intensity", intensity),
        )
        super().__init__(native, technique, map_size)
        self.softness = softness
        self.attenuation = attenuation

    @property
    def angle_deg(self) -> float:
        """The cone's full angle in degrees, 1..170."""
        return self._handle.angle_deg()

    @angle_deg.setter
    def angle_deg(self, angle_deg: Number) -> None:
        self._handle.set_angle_deg(_arrays.number("angle_deg", angle_deg))

    @property
    def softness(self) -> float:
        """The part of the cone's half angle over which its edge fades, 0..1."""
        return self._handle.softness()

    @softness.setter
    def softness(self, softness: Number) -> None:
        self._handle.set_softness(_arrays.number("softness", softness))


class AreaLight(PositionalLight):
    """A parallelogram that casts soft shadows: the mean of n x n points on it.

    Args:
        position: its middle, in world units.
        edge_u, edge_v: its sides, whole, in world units.
        samples: n of n x n points, 1..8, in the middles of as many equal parts. Each has a map.
        color: linear RGB, each in [0, 1e9].
        intensity: the factor of the colour, in [0, 1e9], of the whole area.
        attenuation: see :attr:`attenuation`.
        technique: its own shadow method, a name or a technique; None for that of the renderer.
        map_size: texels along each side of each of its maps; None for that of the renderer.

    Raises:
        ParameterError: a value outside its range.
    """

    __slots__ = ()
    _handle: _native.AreaLight

    def __init__(
        self,
        position: Vector,
        edge_u: Vector,
        edge_v: Vector,
        samples: int = 4,
        color: Vector = _WHITE,
        intensity: Number = 1.0,
        *,
        attenuation: Vector = (1.0, 0.0, 0.0),
        technique: str | Technique | None = None,
        map_size: int | None = None,
    ) -> None:
        native = _native.AreaLight(
            _arrays.vector("position", position),
            _arrays.vector("edge_u", edge_u),
            _arrays.vector("edge_v", edge_v),
            _arrays.whole("samples", samples),
            _arrays.vector("color", color),
            _arrays.number("intensity", intensity),
        )
        super().__init__(native, technique, map_size)
        self.attenuation = attenuation

    @property
    def edge_u(self) -> tuple[float, float, float]:
        """One of its sides, in world units."""
        x, y, z = self._handle.edge_u()
        return x, y, z

    @edge_u.setter
    def edge_u(self, edge_u: Vector) -> None:
        self._handle.set_edges(_arrays.vector("edge_u", edge_u), self.edge_v)

    @property
    def edge_v(self) -> tuple[float, float, float]:
        """The other side, in world units."""
        x, y, z = self._handle.edge_v()
        return x, y, z

    @edge_v.setter
    def edge_v(self, edge_v: Vector) -> None:
        self._handle.set_edges(self.edge_u, _arrays.vector("edge_v", edge_v))

    @property
    def samples(self) -> int:
        """n of n x n points, 1..8."""
        return self._handle.samples()

    @samples.setter
    def samples(self, samples: int) -> None:
        self._handle.set_samples(_arrays.whole("samples", samples))


def _text(vector: tuple[float, float, float]) -> str:
    return f"({', '.join(f'{value:.3g}' for value in vector)})"
