"""Where the C++ library of this package lies."""

import importlib.util
import pathlib


def cmake_dir() -> pathlib.Path:
    """Where find_package(opacity) finds its files, beside the engine's library."""
    module = importlib.util.find_spec("pyopacity._native")  # an editable install has it elsewhere
    assert module is not None and module.origin is not None
    return pathlib.Path(module.origin).parent / "lib" / "cmake" / "opacity"
