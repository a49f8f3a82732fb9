"""What a caller passes, checked before it reaches the engine: nothing is converted silently.

Each function takes the name that the caller knows the value by, and returns what the engine takes,
or raises a ParameterError that says what was passed and what to pass instead.
"""

import os
from collections.abc import Iterable, Sequence
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from pyopacity.errors import ParameterError

Floats: TypeAlias = npt.NDArray[np.float32] | npt.NDArray[np.float64]
Number: TypeAlias = float | np.floating[Any] | np.integer[Any]
Vector: TypeAlias = Sequence[Number] | Floats
Image: TypeAlias = npt.NDArray[np.float32]
Attribute: TypeAlias = Number | Floats
Color: TypeAlias = Vector
Opacity: TypeAlias = Attribute | Vector
Value: TypeAlias = bool | int | float | str

_FLOATING = (np.dtype(np.float32), np.dtype(np.float64))


def describe(value: object) -> str:
    """What was passed, in words: ``a float16 array of shape (3, 4)``, ``a list``, ``None``."""
    if isinstance(value, np.ma.MaskedArray):
        return "a masked array"
    if isinstance(value, np.ndarray):
        return f"{_with_article(str(value.dtype))} array of shape {value.shape}"
    if value is None or isinstance(value, bool | np.bool_):
        return str(value)
    return _with_article(type(value).__name__)


def _with_article(noun: str) -> str:
    return f"{'an' if noun[0].lower() in 'aeiou' else 'a'} {noun}"


def wrong(name: str, value: object, wanted: str) -> ParameterError:
    """The error for a value of a type that is not taken."""
    return ParameterError(f"{name} is {describe(value)}", f"pass {wanted}")


def _shape_text(shape: Iterable[str | int]) -> str:
    sizes = [str(size) for size in shape]
    return f"({', '.join(sizes)}{',' if len(sizes) == 1 else ''})"


def _check_layout(name: str, array: npt.NDArray[Any], shape: tuple[str | int, ...]) -> None:
    fits = array.ndim == len(shape) and all(
        isinstance(want, str) or want == size
        for want, size in zip(shape, array.shape, strict=False)
    )
    if not fits:
        raise wrong(name, array, f"shape {_shape_text(shape)}")
    if not (array.flags.c_contiguous and array.flags.aligned):
        raise ParameterError(
            f"{name} is {describe(array)} that is not C-contiguous",
            f"pass numpy.ascontiguousarray({name})",
        )


def floats(name: str, value: object, shape: tuple[str | int, ...]) -> Floats:
    """A float32 or float64 array in C order; a string in ``shape`` stands for any size."""
    wanted = f"a numpy array of float32 or float64 with shape {_shape_text(shape)}"
    if not isinstance(value, np.ndarray) or isinstance(value, np.ma.MaskedArray):
        raise wrong(name, value, wanted)
    if value.dtype not in _FLOATING:
        raise wrong(name, value, f"{wanted}, such as {name}.astype(numpy.float32)")
    _check_layout(name, value, shape)
    return value


def to_fill(name: str, value: object, shape: tuple[str | int, ...]) -> Image:
    """A float32 array in C order that can be written to."""
    array = floats(name, value, shape)
    if array.dtype != np.float32 or not array.flags.writeable:
        kind = "that cannot be written to" if array.dtype == np.float32 else "of float64"
        raise ParameterError(
            f"{name} is an array {kind}", f"pass numpy.empty({_shape_text(shape)}, numpy.float32)"
        )
    return array  # type: ignore[return-value]


def integers(name: str, value: object, shape: tuple[str | int, ...], dtype: npt.DTypeLike) -> Any:
    """An array of any integer dtype, as ``dtype``; an index that does not fit it is an error."""
    wanted = f"a numpy array of integers with shape {_shape_text(shape)}"
    if not isinstance(value, np.ndarray) or isinstance(value, np.ma.MaskedArray):
        raise wrong(name, value, wanted)
    if value.dtype.kind not in "iu" or not value.dtype.isnative:
        raise wrong(name, value, f"{wanted}, such as {name}.astype(numpy.int64)")
    _check_layout(name, value, shape)
    limits = np.iinfo(dtype)
    outside = (value < limits.min) | (value > limits.max)
    if outside.any():
        index = tuple(int(i) for i in np.argwhere(outside)[0])
        position = "".join(f"[{i}]" for i in index)
        raise ParameterError(
            f"{name}{position} = {value[index]} is outside {limits.min}..{limits.max}",
            "pass indices that are counted from 0",
        )
    return value.astype(dtype, order="C", copy=False)


def is_number(value: object) -> bool:
    """Whether this is a number of Python or numpy; a bool is none."""
    return isinstance(value, int | float | np.integer | np.floating) and not isinstance(value, bool)


def number(name: str, value: object) -> float:
    """A Python or numpy number, as a float."""
    if not isinstance(value, int | float | np.integer | np.floating) or isinstance(value, bool):
        raise wrong(name, value, "a number")
    try:
        return float(value)
    except OverflowError:  # an int beyond every float: the range check says the rest
        return float("inf") if value > 0 else float("-inf")


def whole(name: str, value: object) -> int:
    """A Python or numpy integer that an ``int`` of C++ can hold."""
    if not isinstance(value, int | np.integer) or isinstance(value, bool):
        raise wrong(name, value, "a whole number")
    if not -(2**31) <= value < 2**31:
        raise ParameterError(f"{name} = {value} is not possible", "pass a smaller number")
    return int(value)


def flag(name: str, value: object) -> bool:
    """True or False, and nothing that merely counts as such."""
    if not isinstance(value, bool | np.bool_):
        raise wrong(name, value, "True or False")
    return bool(value)


def numbers(name: str, value: object, counts: tuple[int, ...]) -> tuple[float, ...]:
    """As many numbers as one of ``counts``: a tuple, a list, or a one-dimensional array."""
    wanted = " or ".join(str(count) for count in counts) + " numbers"
    sized = isinstance(value, tuple | list) or (isinstance(value, np.ndarray) and value.ndim == 1)
    if not sized:
        raise wrong(name, value, wanted)
    items: list[object] = list(value)  # type: ignore[call-overload]
    if len(items) not in counts:
        raise ParameterError(f"{name} has {len(items)} numbers", f"pass {wanted}")
    return tuple(number(f"{name}[{i}]", item) for i, item in enumerate(items))


def vector(name: str, value: object) -> tuple[float, float, float]:
    """Three numbers."""
    x, y, z = numbers(name, value, (3,))
    return x, y, z


def attribute(name: str, value: object) -> Floats:
    """One number for all, or a float array of one a point; the engine checks how many."""
    if isinstance(value, np.ndarray):
        return floats(name, value, ("N",))
    if not is_number(value):
        raise wrong(name, value, "a number, or a float32 or float64 array of shape (N,)")
    return np.array([number(name, value)])


def colors(name: str, value: object) -> Floats:
    """One colour for all, or a float array of one a point; the engine checks how many."""
    if isinstance(value, np.ndarray) and value.ndim != 1:
        return floats(name, value, ("N", 3))
    if not isinstance(value, tuple | list | np.ndarray):
        raise wrong(name, value, "three numbers, or a float32 or float64 array of shape (N, 3)")
    return np.array([vector(name, value)])


def opacity(value: object, points: int) -> tuple[Floats, bool]:
    """One opacity for all or one a point, and whether it has a value a colour; then (N, 3)."""
    if isinstance(value, tuple | list):
        return np.array([vector("opacity", value)]), True
    if isinstance(value, np.ndarray):
        if value.ndim == 2:
            return floats("opacity", value, ("N", 3)), True
        is_rgb = value.shape == (3,) and points != 3
        return (colors if is_rgb else attribute)("opacity", value), is_rgb
    if not is_number(value):
        wanted = "a number, three, or a float32 or float64 array of shape (N,) or (N, 3)"
        raise wrong("opacity", value, wanted)
    return attribute("opacity", value), False


def image(name: str, value: object, shape: tuple[str | int, ...]) -> Image | None:
    """A picture that lies on a surface, float32, or None."""
    if value is None:
        return None
    return floats(name, value, shape).astype(np.float32, copy=False)


def parameter(name: str, value: object, kind: str = "") -> Value:
    """What a parameter may be: True or False, a number, a word, and if its kind says so a list."""
    is_list = isinstance(value, list | tuple) or (isinstance(value, np.ndarray) and value.ndim == 1)
    if is_list and kind.endswith("list"):
        return ",".join(repr(number(name, item)) for item in value)  # type: ignore[attr-defined]
    if isinstance(value, bool | np.bool_):
        return bool(value)
    if isinstance(value, str):
        return str(value)
    if isinstance(value, int | np.integer):
        return int(value) if -(2**63) <= value < 2**63 else number(name, value)
    if not is_number(value):
        raise wrong(name, value, "a number, a word, or True or False")
    return number(name, value)


def shortest(value: float | np.float32) -> float:
    """The shortest decimal that is kept as this float32: .3 comes back as .3."""
    return float(str(np.float32(value)))


def read_only(array: npt.NDArray[Any]) -> Any:
    """A copy that refuses to be written, as what is written to it would be lost."""
    array.flags.writeable = False
    return array


def path(value: str | os.PathLike[str]) -> bytes:
    """The path of a file, as the system has it."""
    name = os.fsencode(value)
    if b"\0" in name:
        raise ParameterError(f"the path {value!r} holds a zero byte", "pass the path of a file")
    return name


def choice(name: str, value: object, choices: tuple[str, ...]) -> None:
    """One of a few words."""
    if value not in choices:
        known = ", ".join(f'"{word}"' for word in choices)
        raise ParameterError(f"{name} = {value!r} is not one of {known}", f"choose {known}")
