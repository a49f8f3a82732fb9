"""What is drawn, and what lights it."""

from collections.abc import Iterable
from typing import TypeAlias

from pyopacity import _arrays, _native
from pyopacity._attributes import Guarded
from pyopacity.bounds import Bounds
from pyopacity.errors import ParameterError
from pyopacity.light import Light
from pyopacity.shapes import Shape

Item: TypeAlias = Shape | Light


class Scene(Guarded):
    """Shapes and lights. Both are shared: change them at any time, also after they were added.

    What is in it changes on the thread that renders it; a shape's own arrays on any.

    Args:
        items: what to add at once, as to :meth:`add`.
    """

    __slots__ = ("_lights", "_handle", "_shapes")
    _handle: _native.Scene
    _shapes: list[Shape]
    _lights: list[Light]

    def __init__(self, *items: Item | Iterable[Item]) -> None:
        self._handle = _native.Scene()
        self._shapes = []
        self._lights = []
        for item in items:
            self.add(item)

    def add(self, items: Item | Iterable[Item]) -> None:
        """Adds a shape, a light, or an iterable of them: all, or after an error none.

        Raises:
            ParameterError: something else; what is in the scene already, or twice in the list.
        """
        fix = "add each shape and light once; for a second copy make another"
        for item in self._checked(items, False, "is in the scene already", fix):
            self._handle.add(item._handle)
            self._list_of(item).append(item)

    def remove(self, items: Item | Iterable[Item]) -> None:
        """Takes a shape, a light, or an iterable of them out again: all, or after an error none.

        Raises:
            ParameterError: something else; what is not in the scene, or twice in the list.
        """
        fix = "remove only what was added, and once"
        for item in self._checked(items, True, "is not in the scene", fix):
            self._handle.remove(item._handle)
            self._list_of(item).remove(item)

    @property
    def shapes(self) -> tuple[Shape, ...]:
        """The shapes in the order in which they were added."""
        return tuple(self._shapes)

    @property
    def lights(self) -> tuple[Light, ...]:
        """The lights in the order in which they were added."""
        return tuple(self._lights)

    @property
    def is_tinted(self) -> bool:
        """Whether a shape stops red, green and blue light by parts of their own.

        T has then three values a point. Maps and pictures are made as of three scenes, one a
        colour: ``renderer.report`` and ``renderer.read`` have ``red/``, ``green/`` and ``blue/``
        before their names.
        """
        return self._handle.is_tinted()

    @property
    def bounds(self) -> Bounds:
        """The axis-aligned box around all shapes in world space; empty without any."""
        return Bounds.of(self._handle.bounds())

    def _checked(
        self, items: Item | Iterable[Item], inside: bool, problem: str, fix: str
    ) -> list[Item]:
        """One item or many, all checked to be inside, or outside, before the first one moves."""
        checked = _flat(items)
        current: list[Item] = [*self._shapes, *self._lights]
        held = {id(item._handle) for item in current}
        for index, item in enumerate(checked):
            if (id(item._handle) in held) != inside:
                raise ParameterError(f"item {index}, {item!r}, {problem}", fix)
            held ^= {id(item._handle)}  # has moved, if it comes again
        return checked

    def _list_of(self, item: Item) -> list[Item]:
        is_light = isinstance(item, Light)
        return self._lights if is_light else self._shapes  # type: ignore[return-value]

    def __repr__(self) -> str:
        return f"<Scene: {len(self._shapes)} shapes, {len(self._lights)} lights>"


def _flat(items: Item | Iterable[Item]) -> list[Item]:
    """One item or many, all checked before the first is used."""
    if isinstance(items, Shape | Light):
        return [items]
    if not isinstance(items, Iterable):
        raise _arrays.wrong("what a scene holds", items, "shapes, lights, or a list of them")
    flat = list(items)
    for index, item in enumerate(flat):
        if not isinstance(item, Shape | Light):
            raise _arrays.wrong(f"item {index} of a scene", item, "shapes and lights only")
    return flat
