"""The logger "pyopacity": what the engine has to say without failing."""

import logging
from collections.abc import Iterable

_LEVELS = {
    "debug": logging.DEBUG,
    "info": logging.INFO,
    "warning": logging.WARNING,
    "error": logging.ERROR,
}


def pass_on(messages: Iterable[tuple[str, str]], logger: str = "pyopacity") -> None:
    """Logs what the engine noted: (level, message) each."""
    for level, message in messages:
        logging.getLogger(logger).log(_LEVELS[level], message)
