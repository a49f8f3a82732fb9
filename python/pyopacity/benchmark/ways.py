"""The techniques of the four papers, and ours: what the goals compare.

Nothing else of the benchmark names one: its sections go through the registry.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from pyopacity.comparison import Variant
from pyopacity.technique import EXACT, technique

BOUNDING = "bounding_opacity_maps"
ADAPTIVE = "adaptive_opacity_maps"
FIXED_SPLIT: dict[str, Any] = {"split": "hybrid"}
BOUNDING_FIXED = f"{BOUNDING}, fixed split"

# Of the engine, those that none of the four papers describes as they are by default here.
OURS = (ADAPTIVE, BOUNDING, EXACT)

_LEAST_COEFFICIENTS = 3
LINEAR: dict[str, Any] = {"interpolation": "linear", "own_correction": False}
_WITHOUT_OUR_DEPOSIT: dict[str, Any] = {"deposit_rule": "paper", "deposit": "blend"}


@dataclass(frozen=True, slots=True)
class Way:
    """A technique as a paper describes it.

    Attributes:
        technique: its name.
        parameters: that make it so.
        takes_coefficients: instead of layers: an odd number below that of layers.
    """

    technique: str
    parameters: dict[str, Any] = field(default_factory=dict)
    takes_coefficients: bool = False

    def variant(self, layers: int, **more: Any) -> Variant:
        """With so many layers, and what else its parameters are."""
        odd = max(layers - 1 - layers % 2, _LEAST_COEFFICIENTS)
        count = {"coefficients": odd} if self.takes_coefficients else {"layers": layers}
        return Variant(self.technique, {**count, **self.parameters, **more})


# Kim and Neumann 2001; Yuksel and Keyser 2008; Voicu 2011, three splits; Jansen and Bavoil 2010.
PAPERS: dict[str, Way] = {
    "opacity shadow maps": Way("opacity_shadow_maps", LINEAR),
    "deep opacity maps": Way("deep_opacity_maps", {"own_correction": False}),
    "bounding, linear": Way(BOUNDING, LINEAR | {"split": "linear"}),
    "bounding, ratio .5": Way(BOUNDING, LINEAR | FIXED_SPLIT),
    "bounding, logarithmic": Way(BOUNDING, LINEAR | {"split": "logarithmic"}),
    "Fourier": Way("fourier_opacity_maps", {"own_correction": False}, takes_coefficients=True),
}

# A look-up in K of our layers reads from three arrays: sums, moments and places; in those of the
# papers from one. So many layers of theirs take the bytes of one of ours.
PUBLISHED_A_LAYER = 3


def papers(layers: int, **more: Any) -> Iterator[tuple[str, Variant]]:
    """The papers' techniques with our deposit, and more parameters."""
    for name, way in PAPERS.items():
        yield name, way.variant(layers, **more)


def published(layers: int) -> Iterator[tuple[str, Variant]]:
    """The papers' techniques with their own deposit and look-up."""
    for name, way in PAPERS.items():
        takes = {parameter.name for parameter in technique(way.technique).parameters}
        more = {key: value for key, value in _WITHOUT_OUR_DEPOSIT.items() if key in takes}
        yield name, way.variant(layers, **more)
