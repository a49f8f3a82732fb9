"""Techniques written in Python and GLSL alone: passes as data, the shader as text.

docs/plugins.md writes one.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal, TypeVar

from pyopacity import _arrays, _native
from pyopacity._attributes import Guarded
from pyopacity.errors import ParameterError
from pyopacity.technique import forget_classes

Format = Literal["depth32f", "r32f", "rgba32f", "rgba16f", "rgba8", "r32ui", "rgba32ui"]


@dataclass(frozen=True)
class Param(Guarded):
    """A parameter: a number, or True or False. In GLSL ``u_<name>``.

    Args:
        name: of the attribute, the option, the uniform.
        default: an int, a float or a bool makes the parameter one.
        range: the least and the largest value, both allowed; a bool has none.
        doc: what it does, in a sentence.
    """

    name: str
    default: bool | int | float
    range: tuple[float, float] = (0.0, 1.0)
    doc: str = ""
    choices: ClassVar[tuple[str, ...]] = ()

    def __post_init__(self) -> None:
        _text("a parameter's name", self.name)
        _text(f"parameter {self.name}: doc", self.doc)
        field = f"parameter {self.name}: default"
        if not isinstance(self.default, bool):
            _arrays.number(field, self.default)
        object.__setattr__(self, "default", _arrays.parameter(field, self.default))
        ends = _arrays.numbers(f"parameter {self.name}: range", self.range, (2,))
        object.__setattr__(self, "range", ends)


@dataclass(frozen=True)
class Choice(Guarded):
    """A parameter that is one of several words, the default first. In GLSL its index, ``u_<name>``.

    Args:
        name: of the attribute, the option, the uniform.
        choices: the words.
        doc: what they mean.
    """

    name: str
    choices: Sequence[str]
    doc: str = ""
    range: ClassVar[tuple[float, float]] = (0.0, 0.0)

    def __post_init__(self) -> None:
        _text("a parameter's name", self.name)
        _text(f"parameter {self.name}: doc", self.doc)
        _names(self, f"parameter {self.name}: choices", "choices")

    @property
    def default(self) -> str:
        """The first of the choices."""
        return next(iter(self.choices), "")


@dataclass(frozen=True)
class Texture(Guarded):
    """A texture as large as the light's maps. In GLSL ``t_<name>``, or stored ``i_<name>``.

    Args:
        name: of the sampler, and of :meth:`Renderer.read`'s ``"<technique>/<name>"``.
        format: what a texel holds.
        layers: 0 for a plain texture, ``sampler2D``; 1 to 64 for an array, ``sampler2DArray``.
    """

    name: str
    format: Format = "rgba32f"
    layers: int = 0

    def __post_init__(self) -> None:
        _text("a texture's name", self.name)
        _text(f"texture {self.name}: format", self.format)
        _arrays.whole(f"texture {self.name}: layers", self.layers)


class _Pass(Guarded):
    """What both kinds of passes check, and the defaults of what only one of them has."""

    name: str
    writes: Sequence[str]
    reads: Sequence[str]

    def __post_init__(self) -> None:
        _text("a pass's name", self.name)
        _names(self, f"pass {self.name}: writes", "writes")
        _names(self, f"pass {self.name}: reads", "reads")


@dataclass(frozen=True)
class CasterPass(_Pass):
    """A pass that draws all casters from the light, by the deposit rule (docs/accuracy.md).

    Args:
        name: of its row in the report, and of its stage: ``#ifdef PASS_<name>``.
        writes: textures: colour targets in this order, an array by its layers, and at most one
            ``depth32f``. They are cleared to 0, depths to what the test never keeps.
        reads: textures of passes before it, and parameters.
        fragment: one of the engine's fragment shaders instead of the technique's own, such as
            ``"bounds.frag.glsl"``, which writes nothing but depth.
        optical_depth: False where only depths matter, so that opacities may change without it.
        depth: ``"less"`` keeps what is nearest to the light, ``"greater"`` what is farthest.
        blend: ``"add"`` sums over all fragments; ``"off"`` leaves the last one.
    """

    name: str
    writes: Sequence[str]
    reads: Sequence[str] = ()
    fragment: str = ""
    optical_depth: bool = True
    depth: Literal["off", "less", "greater"] = "off"
    blend: Literal["off", "add"] = "off"
    over: ClassVar[str] = "casters"

    def __post_init__(self) -> None:
        _Pass.__post_init__(self)
        for field in ("fragment", "depth", "blend"):
            _text(f"pass {self.name}: {field}", getattr(self, field))
        _arrays.flag(f"pass {self.name}: optical_depth", self.optical_depth)


@dataclass(frozen=True)
class TexelPass(_Pass):
    """A pass that computes every texel of the textures that it writes, layer by layer.

    Args:
        name: of its row in the report, and of its stage: ``#ifdef PASS_<name>``, a compute shader
            that includes ``lib/invocation.glsl``.
        writes: textures, which the shader stores into as images ``i_<name>``.
        reads: textures of passes before it, and parameters.
    """

    name: str
    writes: Sequence[str]
    reads: Sequence[str] = ()
    over: ClassVar[str] = "texels"
    fragment: ClassVar[str] = ""
    optical_depth: ClassVar[bool] = False
    depth: ClassVar[str] = "off"
    blend: ClassVar[str] = "off"


@dataclass(frozen=True)
class _Description:
    name: str
    summary: str
    paper: str
    shader: str
    parameters: tuple[Param | Choice, ...]
    textures: tuple[Texture, ...]
    passes: tuple[CasterPass | TexelPass, ...]
    look_up: Sequence[str]
    own_correction: bool

    def __post_init__(self) -> None:
        for field in ("name", "summary", "paper", "shader"):
            _text(field, getattr(self, field))
        _names(self, "look_up", "look_up")
        _arrays.flag("own_correction", self.own_correction)


def register_technique(
    name: str,
    *,
    summary: str,
    paper: str,
    shader: str,
    passes: Iterable[CasterPass | TexelPass],
    textures: Iterable[Texture],
    look_up: Sequence[str],
    parameters: Iterable[Param | Choice] = (),
    own_correction: bool = False,
) -> None:
    """Registers a technique that is data and a shader, in the place of one of the same kind.

    From then on it is like those that are built in: ``technique(name)``, its parameters, its rows
    in every report, :meth:`Renderer.read`. It runs on the GPU only.

    Args:
        name: a-z, 0-9 and _. One that was registered so is replaced; renderers that hold it say so.
        summary: what it does, in a sentence.
        paper: where it comes from.
        shader: GLSL, as docs/add_a_technique.md has it: each stage in ``#ifdef PASS_<name>``, then
            the look-up, ``texel_optical_depth`` and ``lib/lookup.glsl`` or
            ``shadow_transmittance``. It may include the engine's ``lib/*.glsl``.
        passes: in the order in which they run.
        textures: what they write.
        look_up: the names of the textures and parameters that the look-up reads.
        parameters: beside those that all techniques have.
        own_correction: the look-up's ``own`` holds what the receiver itself casts; else nothing.

    Raises:
        ParameterError: that names the field: a texture that no pass writes, a read of a name that
            is not known, a format that does not exist, a name that belongs to the engine or to a
            plugin, and so on.
        ShaderError: a file of the engine that does not exist, with the nearest name. What the
            compiler of GLSL finds is one too, of the first frame.
    """
    description = _Description(
        name,
        summary,
        paper,
        shader,
        _all("parameters", parameters, Param, Choice),
        _all("textures", textures, Texture),
        _all("passes", passes, CasterPass, TexelPass),
        look_up,
        own_correction,
    )
    _native.register_technique(description)
    forget_classes()


def _text(name: str, value: object) -> None:
    if not isinstance(value, str):
        raise _arrays.wrong(name, value, "a string")
    try:
        value.encode()
    except UnicodeEncodeError:
        raise ParameterError(f"{name} is no Unicode text", "decode it as what it is") from None


def _names(owner: object, name: str, field: str) -> None:
    """Makes a tuple of what is a list of words, and no word itself."""
    value = getattr(owner, field)
    if isinstance(value, str) or not isinstance(value, Sequence):
        raise _arrays.wrong(name, value, "a list of names")
    for word in value:
        _text(f"one of {name}", word)
    object.__setattr__(owner, field, tuple(value))


Item = TypeVar("Item")


def _all(name: str, items: Iterable[Item], *kinds: type) -> tuple[Item, ...]:
    wanted = " or ".join(f"pyopacity.{kind.__name__}" for kind in kinds)
    if not isinstance(items, Iterable):
        raise _arrays.wrong(name, items, f"a list of {wanted}")
    found = tuple(items)
    for index, item in enumerate(found):
        if not isinstance(item, kinds):
            raise ParameterError(f"{name}[{index}] is {_arrays.describe(item)}", f"pass a {wanted}")
    return found
