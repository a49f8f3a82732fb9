"""The shadow methods, enumerated from the engine's registry: a new one needs no line here."""

import functools
import os
from dataclasses import dataclass
from typing import Any

from pyopacity import _arrays, _native
from pyopacity._attributes import HasParameters, add_parameters
from pyopacity._native import Parameter as Parameter

# The two ends of every comparison, which no other technique can be: every fragment, and none.
EXACT, UNSHADOWED = "exact", "unshadowed"


class Technique(HasParameters):
    """A shadow method with its parameters, made by :func:`pyopacity.technique`.

    Parameters are attributes: ``technique.layers = 8``. ``help(technique)`` tells what each does.
    """

    __slots__ = ("_handle",)
    _handle: _native.Technique

    def __init__(self, native: _native.Technique) -> None:
        self._handle = native

    def _owner(self) -> _native.ParamOwner:
        return self._handle

    @property
    def name(self) -> str:
        """Its name in the registry."""
        return self._handle.name

    @property
    def summary(self) -> str:
        """What it does, in one sentence."""
        return self._handle.summary

    @property
    def paper(self) -> str:
        """Where it comes from: authors and year."""
        return self._handle.paper

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Name, type, range, default and documentation of each parameter."""
        return tuple(self._handle.parameters())

    def __repr__(self) -> str:
        values = (f"{p.name}={self._handle.get(p.name)!r}" for p in self.parameters)
        return f"technique({', '.join([repr(self.name), *values])})"


@dataclass(frozen=True, slots=True)
class TechniqueInfo:
    """What the registry knows about a technique."""

    name: str
    summary: str
    paper: str
    parameters: tuple[Parameter, ...]


@functools.cache
def _class_of(name: str) -> type[Technique]:
    """A subclass with a documented property for each parameter."""
    native = _native.make_technique(name)
    doc = f"{native.summary}\n\n    Paper: {native.paper}"
    members = {"__slots__": (), "__doc__": doc, "__module__": __name__}
    title = name.title().replace("_", "")
    return add_parameters(type(title, (Technique,), members), native.parameters())


def forget_classes() -> None:
    """A name may mean another technique now, with other parameters."""
    _class_of.cache_clear()


def technique(name: str, **parameters: Any) -> Technique:
    """A technique by name: ``technique("bounding_opacity_maps", layers=8)``.

    Args:
        name: one of :func:`techniques`.
        parameters: by the names, types and ranges that :func:`techniques` lists for it.

    Raises:
        ParameterError: a name that the registry or the technique does not have (the fix suggests
            the nearest), or a value outside the parameter's range.
    """
    if not isinstance(name, str):
        raise _arrays.wrong("technique", name, "a name; pyopacity.techniques() lists them")
    native = _native.make_technique(name)
    kinds = {parameter.name: parameter.type for parameter in native.parameters()}
    for key, value in parameters.items():
        native.set(key, _arrays.parameter(key, value, kinds.get(key, "")))
    return _class_of(name)(native)


def load_plugin(path: str | os.PathLike[str]) -> tuple[str, ...]:
    """Opens a shared library that was built against this engine, and registers its techniques.

    Each is made only when it is asked for, and is then like any other: ``technique(name)``, the
    command line (``--plugin``), every report. A library that is loaded already stays as it is; none
    is ever unloaded. docs/plugins.md makes one.

    Args:
        path: what the plugin's build made. Its code runs in this process: load what you trust.

    Returns:
        The names of its techniques.

    Raises:
        PluginError: the file is no shared library or has no entry point, it was built against the
            headers of another engine, or it brings a name that is taken. No technique of it is
            registered then.
    """
    if not isinstance(path, str | os.PathLike):
        raise _arrays.wrong("path", path, "the path of a shared library")
    return tuple(_native.load_plugin(_arrays.path(path)))


def techniques() -> dict[str, TechniqueInfo]:
    """Every technique of the registry, by name, in its order."""
    found = {}
    for name in _native.technique_names():
        native = _native.make_technique(name)
        found[name] = TechniqueInfo(name, native.summary, native.paper, tuple(native.parameters()))
    return found
