"""Attributes that cannot be misspelt, and attributes that the engine's registry defines."""

import functools
import inspect
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, TypeVar

from pyopacity import _arrays, _native
from pyopacity.errors import ParameterError, UnknownNameError


def _unknown(owner: object, name: str) -> UnknownNameError:
    names = [known for known in dir(type(owner)) if not known.startswith("_")]
    nearest = _native.nearest_name(name, names)
    return UnknownNameError(
        f'{type(owner).__name__} has no attribute "{name}"',
        f'did you mean "{nearest}"? It has {", ".join(names)}',
    )


@functools.cache
def _keywords(cls: type) -> list[str] | None:
    """The keywords that a constructor takes; None where it takes any and checks them itself."""
    parameters = inspect.signature(cls).parameters.values()
    more: tuple[str, ...] | None = getattr(cls, "_more_keywords", None)
    if more is None and any(p.kind is p.VAR_KEYWORD for p in parameters):
        return None
    kinds = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
    return [p.name for p in parameters if p.kind in kinds] + list(more or ())


def _check_keywords(cls: type, given: Iterable[str]) -> None:
    known = _keywords(cls)
    unknown = [name for name in given if known is not None and name not in known]
    if not unknown:
        return
    fix = "it takes no keywords: pass its arguments by position"
    if known:
        nearest = _native.nearest_name(unknown[0], known)
        fix = f'did you mean "{nearest}"? It takes {", ".join(known)}'
    raise UnknownNameError(f'{cls.__name__} takes no "{unknown[0]}"', fix)


class Guarded:
    """An object without attributes of the caller's making: ``shape.poitns = ...`` is an error.

    So is ``Strands(..., widht=.3)``. Too many or too few arguments are Python's TypeError.
    """

    __slots__ = ("__weakref__",)

    if not TYPE_CHECKING:  # a type checker shall find the misspelt name by itself
        # Not in a metaclass or around __init__: there, inspect would no longer see the signatures.
        def __new__(cls, *_arguments: object, **keywords: object) -> Any:
            _check_keywords(cls, keywords)
            return super().__new__(cls)

        def __getattr__(self, name: str) -> Any:
            raise _unknown(self, name)

        def __setattr__(self, name: str, value: object) -> None:
            known = getattr(type(self), name, None)
            if known is None:
                raise _unknown(self, name)
            if isinstance(known, property) and known.fset is None:
                raise ParameterError(
                    f"{type(self).__name__}.{name} cannot be set",
                    f"make another {type(self).__name__}",
                )
            object.__setattr__(self, name, value)


class HasParameters(Guarded):
    """An object some of whose attributes are parameters that the engine describes."""

    __slots__ = ()

    def _owner(self) -> _native.ParamOwner:
        raise NotImplementedError

    if TYPE_CHECKING:  # the names are known at run time only

        def __getattr__(self, name: str) -> Any: ...

        def __setattr__(self, name: str, value: Any) -> None: ...


def describe(parameter: _native.Parameter) -> str:
    """Its documentation in one line."""
    return f"{parameter.doc} {parameter.type}: {parameter.range}; default {parameter.default!r}."


def _property(parameter: _native.Parameter) -> property:
    name = parameter.name

    def get(self: HasParameters) -> Any:
        return self._owner().get(name)

    def set_(self: HasParameters, value: object) -> None:
        self._owner().set(name, _arrays.parameter(name, value, parameter.type))

    return property(get, set_, doc=describe(parameter))


Class = TypeVar("Class", bound=type[HasParameters])


def add_parameters(cls: Class, parameters: Iterable[_native.Parameter]) -> Class:
    """Gives a class a property for each parameter, and a line in its documentation."""
    lines = []
    for parameter in parameters:
        setattr(cls, parameter.name, _property(parameter))
        lines.append(f"    {parameter.name}: {describe(parameter)}")
    cls.__doc__ = "\n".join(
        [cls.__doc__ or "", "", "    Parameters, settable at any time:", *lines]
    )
    return cls
