"""Every failure that a caller can do something about: what was wrong, and how to fix it.

The engine raises these classes too. Each is also the built-in exception that fits, so that
``except ValueError`` and ``except MemoryError`` catch what they should.
"""


class Error(Exception):
    """The base of all: ``what`` was wrong, and the ``fix``.

    ``str(error)`` is both, the fix on a line of its own.
    """

    what: str
    fix: str

    def __init__(self, what: str, fix: str) -> None:
        super().__init__(what, fix)  # as args, so that an error crosses process borders
        self.what = what
        self.fix = fix

    def __str__(self) -> str:
        return f"{self.what}\n  fix: {self.fix}"


class ParameterError(Error, ValueError):
    """A value, a name or an array that the call cannot take."""


class UnknownNameError(ParameterError, AttributeError):
    """An attribute or a keyword that the object does not have; the fix suggests the nearest.

    It is an AttributeError as well, so that ``hasattr`` answers instead of raising.
    """


class FileFormatError(Error, ValueError):
    """A file that is missing, truncated, inconsistent, or not what its name says."""


class ContextError(Error, RuntimeError):
    """No OpenGL context on this machine, or one used from the wrong thread or after its end."""


class ForkedContextError(ContextError):
    """A renderer used in a forked process. Start processes with the "spawn" method."""


class DeviceLostError(ContextError):
    """The driver reset the device: every renderer on it is gone. Make a new one."""


class ShaderError(Error):
    """A shader that does not compile or link, or that reads what its pass did not declare."""


class PluginError(Error, ImportError):
    """A plugin that does not open, was built against another engine, or takes a taken name."""


class OutOfMemoryError(Error, MemoryError):
    """The driver or the machine has no memory left for what was asked."""
