"""Files that are there whole, or not at all."""

import contextlib
import os
import pathlib
from collections.abc import Iterator
from typing import BinaryIO

from pyopacity.errors import ParameterError


@contextlib.contextmanager
def whole_file(path: pathlib.Path) -> Iterator[BinaryIO]:
    """A file to write, under another name until it is complete; after an error nothing is left.

    Raises:
        ParameterError: it cannot be written.
    """
    partial = path.with_name(f"{path.name}.{os.getpid()}.part")
    try:
        with partial.open("xb") as file:
            yield file
        partial.replace(path)
    except OSError as error:
        partial.unlink(missing_ok=True)
        raise ParameterError(
            f"{path} cannot be written: {error.strerror}",
            "choose a file in a folder that has room, and where you may write",
        ) from error
    except BaseException:  # Ctrl-C too
        partial.unlink(missing_ok=True)
        raise
