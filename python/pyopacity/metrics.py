"""How far a result is from the truth, in the result's own units: of T, or of linear colour.

Every figure takes what was *measured* first and the *reference* second: arrays of any equal shape,
real numbers, also of different dtypes. Differences are *measured - reference*, in float64. All of
them raise a ParameterError for shapes that differ, for arrays without elements, and for a value
that is not finite, named by its first index.

:func:`flip` alone is about pictures as people see them.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from pyopacity import _arrays
from pyopacity.errors import Error, ParameterError

__all__ = ["Errors", "bias", "errors", "flip", "has_flip", "mae", "maximum", "p99", "rmse"]

_F64 = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Errors:
    """Every figure of one comparison, in the units of what was compared."""

    rmse: float
    mae: float
    bias: float
    p99: float
    maximum: float


def errors(measured: npt.ArrayLike, reference: npt.ArrayLike) -> Errors:
    """All figures at once, from one look at the arrays."""
    d = _difference(measured, reference)
    return Errors(_rmse(d), _mae(d), _bias(d), _p99(d), _maximum(d))


def rmse(measured: npt.ArrayLike, reference: npt.ArrayLike) -> float:
    """Root of the mean squared difference."""
    return _rmse(_difference(measured, reference))


def mae(measured: npt.ArrayLike, reference: npt.ArrayLike) -> float:
    """Mean of \\|difference\\|."""
    return _mae(_difference(measured, reference))


def bias(measured: npt.ArrayLike, reference: npt.ArrayLike) -> float:
    """Mean difference: below 0 where the measured is too low, of T: too dark."""
    return _bias(_difference(measured, reference))


def p99(measured: npt.ArrayLike, reference: npt.ArrayLike) -> float:
    """99th percentile of \\|difference\\|, linear between the two nearest ranks."""
    return _p99(_difference(measured, reference))


def maximum(measured: npt.ArrayLike, reference: npt.ArrayLike) -> float:
    """Largest \\|difference\\|."""
    return _maximum(_difference(measured, reference))


def flip(reference: npt.NDArray[Any], image: npt.NDArray[Any]) -> float:
    """Mean FLIP of two pictures, in [0, 1]: what a person sees who switches between them.

    The pictures are those of :meth:`pyopacity.Renderer.render`: linear, premultiplied, shown over
    black and clamped to 0 .. 1 as a display does. The viewing distance is NVIDIA's default, 67
    pixels a degree.

    Source: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild, "FLIP: A Difference
    Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020;
    computed by NVIDIA's package flip-evaluator.

    Args:
        reference, image: (H, W, 3) or (H, W, 4) float32 or float64, of one size.

    Raises:
        ParameterError: another array, sizes that differ, a value that is not finite.
        Error: flip-evaluator is not installed.
    """
    expected, shown = _displayed("reference", reference), _displayed("image", image)
    if expected.shape != shown.shape:
        raise _shapes_differ("image", shown.shape, expected.shape)
    if not has_flip():
        raise Error(
            "flip-evaluator, NVIDIA's package for FLIP, is not installed",
            "pip install 'pyopacity[compare]'",
        )
    import flip_evaluator

    # Low dynamic range, not sRGB but linear, no colour map.
    _, mean, _ = flip_evaluator.evaluate(expected, shown, "LDR", False, False, True, {})
    return float(mean)


def has_flip() -> bool:
    """Whether flip-evaluator is installed, without which :func:`flip` is an error."""
    try:
        import flip_evaluator  # noqa: F401
    except ImportError:
        return False
    return True


def _rmse(difference: _F64) -> float:
    return float(np.sqrt(np.mean(difference * difference)))


def _mae(difference: _F64) -> float:
    return float(np.mean(np.abs(difference)))


def _bias(difference: _F64) -> float:
    return float(np.mean(difference))


def _p99(difference: _F64) -> float:
    return float(np.percentile(np.abs(difference), 99.0))


def _maximum(difference: _F64) -> float:
    return float(np.max(np.abs(difference)))


def _difference(measured: npt.ArrayLike, reference: npt.ArrayLike) -> _F64:
    a, b = _finite("measured", measured), _finite("reference", reference)
    if a.shape != b.shape:
        raise _shapes_differ("measured", a.shape, b.shape)
    if a.size == 0:
        raise ParameterError("there is nothing to compare: the arrays are empty", "pass elements")
    return a - b


def _finite(name: str, values: npt.ArrayLike) -> _F64:
    """The values in float64; where masked arrays would hide some, or text holds none, an error."""
    try:
        array = np.asarray(values)
    except ValueError:  # rows of different lengths
        array = np.empty(0, object)
    if array.dtype.kind not in "fiub" or isinstance(values, np.ma.MaskedArray):
        raise _arrays.wrong(name, values, "an array of real numbers")
    array = array.astype(np.float64)
    bad = ~np.isfinite(array)
    if bad.any():
        index = tuple(int(i) for i in np.argwhere(bad)[0])
        position = f"[{', '.join(str(i) for i in index)}]" if index else ""
        raise ParameterError(
            f"{name}{position} = {array[index]} is not finite", "leave out what has no value"
        )
    return array


def _shapes_differ(name: str, shape: tuple[int, ...], reference: tuple[int, ...]) -> ParameterError:
    return ParameterError(
        f"{name} has shape {shape}, the reference {reference}", "pass arrays of the same shape"
    )


def _displayed(name: str, picture: npt.NDArray[Any]) -> npt.NDArray[np.float32]:
    """What a display shows of a linear premultiplied picture over black."""
    is_picture = (
        isinstance(picture, np.ndarray)
        and picture.ndim == 3
        and picture.shape[2] in (3, 4)
        and picture.dtype in (np.float32, np.float64)
        and picture.size > 0
    )
    if not is_picture:
        raise _arrays.wrong(name, picture, "a float32 array of shape (H, W, 4) or (H, W, 3)")
    rgb = np.clip(_finite(name, picture)[..., :3], 0.0, 1.0)
    return np.ascontiguousarray(rgb, np.float32)
