"""What a frame did, and why; and what it holds."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, TypeAlias

Status: TypeAlias = Literal["ran", "cached", "culled"]


@dataclass(frozen=True, slots=True)
class PassReport:
    """One pass of a frame.

    ``status`` is "ran", "cached" (nothing that it reads has moved) or "culled" (nothing needs it,
    or there is nothing to draw); ``why`` names the reads that moved, or the reason; ``ms`` is the
    time on the wall, in milliseconds, until the device was done; ``note`` is what it found when it
    ran last, such as the split ratio; ``calls`` is how many draw calls and dispatches it took, 0
    with ``device="cpu"``.
    """

    name: str
    status: Status
    why: str
    ms: float
    note: str = ""
    calls: int = 0


@dataclass(frozen=True, slots=True)
class ResourceMemory:
    """A texture or buffer, as "bounding_opacity_maps/opacity".

    ``bytes`` is what its content takes: not the samples of oversampled colours, which do not
    outlive their pass, nor what a driver adds. ``texels`` is how many it has in one layer; 0 for a
    buffer.
    """

    name: str
    bytes: int
    texels: int


class Report(list[PassReport]):
    """A row for each pass, in the order in which they ran. ``print(report)`` shows a table."""

    __slots__ = ("_table",)

    def __init__(self, rows: Iterable[PassReport], table: str) -> None:
        super().__init__(rows)
        self._table = table

    def __str__(self) -> str:
        return self._table.rstrip("\n")
