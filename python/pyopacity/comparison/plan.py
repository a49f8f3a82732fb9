"""What a comparison measures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from pyopacity import _native
from pyopacity._arrays import Value
from pyopacity.errors import ParameterError
from pyopacity.technique import Technique, technique, techniques


@dataclass(frozen=True, slots=True)
class Variant:
    """A technique with the parameters that are not at their default."""

    technique: str
    parameters: dict[str, Value]

    def make(self) -> Technique:
        """The technique; a ParameterError where it does not take a value."""
        return technique(self.technique, **self.parameters)

    @property
    def label(self) -> str:
        """For people: ``deep_opacity_maps, layers 8``."""
        return ", ".join([self.technique, *(f"{k} {v}" for k, v in self.parameters.items())])


@dataclass(frozen=True, slots=True)
class Plan:
    """Which techniques, on which maps, and how finely their errors are measured.

    Attributes:
        techniques: names; the default is the registry.
        layers: one variant for each, of techniques that have that parameter.
        parameters: for every technique that has a parameter of that name.
        map_sizes: texels along each side of the light's maps, or "auto".
        device: "gpu"; or "cpu", without OpenGL and so without pictures.
        receivers: how many vertices of the shapes that receive, chosen by ``seed``.
        samples: rays over each footprint.
        footprint: its side in world units, of all maps alike; None for two texels of each map.
        image_size: pixels.
        image_samples: n of n x n samples a pixel, of the traced picture, with a ray from each, and
            of the others.
        repeats: frames of which the seconds are the median.
        settings: of the renderer, such as ``ambient`` and ``background``.
    """

    techniques: tuple[str, ...] = ()
    layers: tuple[int, ...] = (16,)
    parameters: Mapping[str, Value] = field(default_factory=dict)
    map_sizes: tuple[int | str, ...] = (512,)
    device: Literal["gpu", "cpu"] = "gpu"
    receivers: int = 20_000
    seed: int = 0
    samples: int = 64
    footprint: float | None = None
    image_size: tuple[int, int] = (256, 192)
    image_samples: int = 4
    repeats: int = 3
    settings: Mapping[str, Any] = field(default_factory=dict)

    def variants(self) -> list[Variant]:
        """Every technique with every number of layers, in the order of the registry.

        Raises:
            ParameterError: a technique, or a parameter, that there is not; a value outside its
                range.
        """
        names = dict.fromkeys(self.techniques) or techniques()
        takes = {name: _parameters_of(name) for name in names}
        every = sorted(set().union(*takes.values()))
        for key in self.parameters:
            if key not in every:
                raise ParameterError(
                    f'none of the techniques has a parameter "{key}"',
                    f'did you mean "{_native.nearest_name(key, every)}"? They have '
                    f"{', '.join(every)}",
                )
        found = []
        for name in names:
            own = {k: v for k, v in self.parameters.items() if k in takes[name]}
            counts = dict.fromkeys(self.layers) if "layers" in takes[name] - set(own) else ()
            found += [Variant(name, {"layers": n, **own}) for n in counts] or [Variant(name, own)]
        for variant in found:
            variant.make()
        return found


def _parameters_of(name: str) -> set[str]:
    return {parameter.name for parameter in technique(name).parameters}
