"""Shapes from files."""

import os

from pyopacity import _log, _native
from pyopacity.errors import ParameterError
from pyopacity.shapes import Shape, wrap

__all__ = ["load"]


def load(path: str | os.PathLike[str]) -> list[Shape]:
    """The shapes in a file, or generated ones.

    - ``.hair`` (cyHair): strands, with what arrays it has for width, opacity and colour.
    - ``.obj`` and its ``.mtl``: a mesh for each material, with its colour and constant opacity.
    - ``demo:hair``, or ``demo:hair?segments=1000000&seed=7``: hair over a head on a ground.

    Raises:
        FileFormatError: a file that is missing, truncated, not what its name says, or of a format
            that is not read. Memory never grows far beyond the file's size.
        ParameterError: a demo or an option that does not exist.
    """
    name = os.fsencode(path)
    if b"\0" in name:
        raise ParameterError(f"the path {path!r} holds a zero byte", "pass the path of a file")
    shapes, messages = _native.load(name)
    _log.pass_on(messages)
    return [wrap(native) for native in shapes]
