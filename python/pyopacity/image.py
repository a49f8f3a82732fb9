"""Pictures to files."""

import os
import pathlib
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from pyopacity import _arrays, _native
from pyopacity._files import whole_file
from pyopacity.errors import ParameterError

Writer = Callable[[pathlib.Path, npt.NDArray[Any]], None]


def save_image(path: str | os.PathLike[str], image: npt.NDArray[Any]) -> None:
    """Saves a picture; no half file is ever left.

    - ``.png``: 8-bit sRGB with straight alpha, from a linear premultiplied picture, as
      :meth:`pyopacity.Renderer.render` returns it: (H, W, 4) float32 or float64, or (H, W, 3) for
      an opaque one. Values are clamped to 0 .. 1.
    - ``.npy``: any array, exactly.

    Raises:
        ParameterError: another suffix, array or shape; a path that cannot be written.
    """
    target = check_path(path)
    if not isinstance(image, np.ndarray):
        raise _arrays.wrong("image", image, "a numpy array, as Renderer.render() returns it")
    _WRITERS[target.suffix.lower()](target, image)


def check_path(path: str | os.PathLike[str]) -> pathlib.Path:
    """The path of a picture that can be saved, as far as that shows without saving one."""
    target = pathlib.Path(path)
    if target.suffix.lower() not in _WRITERS:
        raise ParameterError(
            f'{target} has a suffix that cannot be saved: "{target.suffix}"',
            f"end the name in {' or '.join(_WRITERS)}",
        )
    check_folder(target)
    return target


def check_folder(path: pathlib.Path) -> None:
    """Whether the folder is there that a file shall lie in."""
    if not path.parent.is_dir():
        raise ParameterError(
            f"{path} cannot be written: there is no folder {path.parent}",
            "make the folder first, or choose another",
        )


def _save_png(path: pathlib.Path, image: npt.NDArray[Any]) -> None:
    is_picture = image.ndim == 3 and image.shape[2] in (3, 4)
    if image.dtype not in (np.float32, np.float64) or not is_picture:
        raise _arrays.wrong("image", image, "a float32 array of shape (H, W, 4) or (H, W, 3)")
    rgba = np.ones((*image.shape[:2], 4), np.float32)
    rgba[..., : image.shape[2]] = image
    _native.save_png(os.fspath(path), rgba)


def _save_npy(path: pathlib.Path, image: npt.NDArray[Any]) -> None:
    with whole_file(path) as file:
        np.save(file, image, allow_pickle=False)


_WRITERS: dict[str, Writer] = {".png": _save_png, ".npy": _save_npy}
