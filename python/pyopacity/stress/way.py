"""A way to ask for T: a device, a technique, a way of depositing."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from pyopacity._arrays import Value
from pyopacity.stress.exceptions import OPAQUE_ONLY
from pyopacity.technique import EXACT, UNSHADOWED, Technique, technique, techniques

Device = Literal["gpu", "cpu"]


@dataclass(frozen=True, slots=True)
class Way:
    """One of the ways in which T is had.

    Attributes:
        device: "gpu" is whatever OpenGL there is.
        technique: its name.
        parameters: by name, what is not at its default.
    """

    device: Device
    technique: str
    parameters: tuple[tuple[str, Value], ...] = ()

    def make(self, **more: Value) -> Technique:
        """The technique; of ``more``, what it has a parameter for. The bias is 0 unless named."""
        known = parameters_of(self.technique)
        wanted = {"bias": 0.0, **more, **dict(self.parameters)}
        return technique(self.technique, **{k: v for k, v in wanted.items() if k in known})

    def given(self, name: str) -> Value | None:
        """A parameter of this way, or None where it is at its default."""
        return dict(self.parameters).get(name)

    def __str__(self) -> str:
        values = (str(value) for _, value in self.parameters)
        return " ".join([self.device, self.technique, *values])


def parameters_of(name: str) -> set[str]:
    """What a technique has parameters for."""
    return {parameter.name for parameter in technique(name).parameters}


ALL = tuple(techniques())
CASTING = tuple(name for name in ALL if name != UNSHADOWED)
TRANSLUCENT = tuple(name for name in CASTING if name != OPAQUE_ONLY)


def ways(
    devices: Iterable[Device], among: Iterable[str] = TRANSLUCENT, papers: bool = False
) -> list[Way]:
    """Every way: each technique on each device, with each way of depositing that it has there.

    On the CPU all of them sum in one order, so that ``deposit`` means nothing there.

    Args:
        devices: those to ask.
        among: the techniques.
        papers: also with ``deposit_rule="paper"``, under which T depends on the map's size.
    """
    found = []
    for device in devices:
        for name in among:
            known = parameters_of(name)
            deposits = ("blend", "scatter") if device == "gpu" and "deposit" in known else ()
            found += [Way(device, name, (("deposit", d),)) for d in deposits] or [Way(device, name)]
            if papers and "deposit_rule" in known:
                found.append(Way(device, name, (("deposit_rule", "paper"),)))
    return found


def exact(device: Device) -> Way:
    """The reference: every fragment."""
    return Way(device, EXACT)


def accumulators(devices: Iterable[Device]) -> list[Way]:
    """What sums in fewer bits: the papers' 8 and 16, with everything else at its default."""
    return [
        Way(device, name, (("accumulator", bits),))
        for device in devices
        for name in TRANSLUCENT
        for bits in accumulators_of(name)
    ]


def accumulators_of(name: str) -> list[str]:
    """Those of a technique that are not float32."""
    for parameter in technique(name).parameters:
        if parameter.name == "accumulator":
            words = [word.strip('" ') for word in parameter.range.split(",")]
            return [word for word in words if word != parameter.default]
    return []
