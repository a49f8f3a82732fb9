"""The logger "pyopacity": what the engine has to say without failing."""

import logging
from collections.abc import Iterable

_LOG = logging.getLogger("pyopacity")
_LEVELS = {
    "debug": logging.DEBUG,
    "info": logging.INFO,
    "warning": logging.WARNING,
    "error": logging.ERROR,
}


def pass_on(messages: Iterable[tuple[str, str]]) -> None:
    """Logs what the engine noted: (level, message) each."""
    for level, message in messages:
        _LOG.log(_LEVELS[level], message)
