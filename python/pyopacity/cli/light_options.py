"""What `--light` says: light from a direction, or a light at a place, as often as it is given."""

from collections.abc import Callable

import numpy as np

import pyopacity as po
from pyopacity.cli import text
from pyopacity.cli.text import Vector

# How each kind is written, and an example of it.
_FORMS = {
    "": ("X,Y,Z", ".5,.3,-.8"),
    "point": ("point:X,Y,Z", "point:0,-5,9"),
    "spot": ("spot:X,Y,Z:TX,TY,TZ[:ANGLE]", "spot:0,-5,9:0,0,1:40"),
    "area": ("area:X,Y,Z:TX,TY,TZ:SIDE[:SAMPLES]", "area:0,-5,9:0,0,1:2:4"),
}

HELP = (
    "X,Y,Z, the direction in which light travels; or a light at a place: "
    f"{_FORMS['point'][0]}; {_FORMS['spot'][0]}, toward a target, its full angle in degrees; "
    f"{_FORMS['area'][0]}, a square that faces a target, as SAMPLES x SAMPLES points; "
    "again for more lights"
)


def read(given: str) -> po.Light:
    """The light that one `--light` asks for.

    Raises:
        ParameterError: what is of no such form, or a value outside its range.
    """
    kind, colon, rest = given.partition(":")
    if not colon:
        return po.DirectionalLight(text.vector("--light", given, _example("")))
    read_kind, counts = _KINDS.get(kind, (None, ()))
    if read_kind is None:
        forms = ", ".join(form for form, _ in _FORMS.values())
        raise po.ParameterError(f'--light "{given}" is of no kind', f"write one of {forms}")
    parts = rest.split(":")
    if len(parts) not in counts:
        raise po.ParameterError(f'--light "{given}" is not understood', f"write {_example(kind)}")
    return read_kind(parts)


def _example(kind: str) -> str:
    return ", such as ".join(_FORMS[kind])


def _point(parts: list[str]) -> po.Light:
    return po.PointLight(_vector("point", parts[0]))


def _spot(parts: list[str]) -> po.Light:
    position = _vector("spot", parts[0])
    light = po.SpotLight(position, _way("spot", position, parts[1]))
    for angle in parts[2:]:
        light.angle_deg = _number("spot", angle)
    return light


def _area(parts: list[str]) -> po.Light:
    position = _vector("area", parts[0])
    way = np.array(_way("area", position, parts[1]))
    side = _number("area", parts[2])
    if side < 0.0:
        raise po.ParameterError(f'--light area: SIDE "{parts[2]}" is below 0', "write its length")
    # Level, as seen along the way: the axis that the way is farthest from gives the first side.
    u = np.cross(way, np.eye(3)[np.argmin(np.abs(way))])
    u *= side / np.linalg.norm(u)
    light = po.AreaLight(position, u, np.cross(way / np.linalg.norm(way), u))
    for samples in parts[3:]:
        light.samples = text.whole("--light area: SAMPLES", samples, 1, 8)
    return light


def _vector(kind: str, part: str) -> Vector:
    return text.vector("--light", part, _example(kind))


def _number(kind: str, part: str) -> float:
    return text.numbers("--light", part, (1,), _example(kind))[0]


def _way(kind: str, position: Vector, target: str) -> Vector:
    end = _vector(kind, target)
    if end == position:
        raise po.ParameterError(
            f'--light {kind}: the target "{target}" is the light\'s own place', "name another"
        )
    x, y, z = (b - a for a, b in zip(position, end, strict=True))
    return x, y, z


# How each is read, and of how many parts.
_KINDS: dict[str, tuple[Callable[[list[str]], po.Light], tuple[int, ...]]] = {
    "point": (_point, (1,)),
    "spot": (_spot, (2, 3)),
    "area": (_area, (3, 4)),
}
