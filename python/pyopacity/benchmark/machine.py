"""On what it was measured: without this a time means nothing."""

from __future__ import annotations

import datetime
import os
from dataclasses import asdict, dataclass

from pyopacity import _native
from pyopacity.errors import ContextError


@dataclass(frozen=True, slots=True)
class Machine:
    """Stands beside every table.

    Attributes:
        renderer: what OpenGL calls itself, or "none".
        driver: its version, as the driver writes it.
        cores: that this process may use.
        date: of the start, UTC.
        version: of pyopacity.
    """

    renderer: str
    driver: str
    cores: int
    date: str
    version: str

    @property
    def facts(self) -> dict[str, str | int]:
        """By name."""
        return asdict(self)

    def __str__(self) -> str:
        return (
            f"{self.renderer}; {self.driver}; {self.cores} cores; {self.date}; "
            f"pyopacity {self.version}"
        )


def this_machine() -> Machine:
    """The one that this process runs on."""
    try:
        context = _native.Context.headless()
        renderer, driver = context.renderer, context.version
    except ContextError:
        renderer, driver = "none", "no OpenGL"
    return Machine(
        renderer=renderer,
        driver=driver,
        cores=len(os.sched_getaffinity(0)),
        date=f"{datetime.datetime.now(datetime.UTC):%Y-%m-%d}",
        version=_native.version(),
    )
