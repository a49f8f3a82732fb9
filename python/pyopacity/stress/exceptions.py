"""What cannot hold for a technique by its nature, and how far from holding it is.

A way that an exception is about is held to the measured size there, not to the case's tolerance.
docs/stress.md lists them.
"""

from __future__ import annotations

from dataclasses import dataclass
from fnmatch import fnmatch
from typing import Literal

# Every caster is opaque to it, so that no case about what is translucent has a right answer there.
OPAQUE_ONLY = "shadow_map"


@dataclass(frozen=True, slots=True)
class NamedException:
    """Of some techniques in one case.

    Attributes:
        case: its name.
        ways: patterns of what :class:`pyopacity.stress.way.Way` calls itself, any device in front.
        size: the largest error, in the case's measure, with the default seed, with a little room.
        why: the nature of it.
        only_on: the device, where the other one has nothing of it.
    """

    case: str
    ways: tuple[str, ...]
    size: float
    why: str
    only_on: Literal["gpu", "cpu"] | None = None

    def is_about(self, case: str, way: str) -> bool:
        """Whether it is about this way of this case."""
        device, _, own = way.partition(" ")
        if case != self.case or self.only_on not in (None, device):
            return False
        return any(fnmatch(own, pattern) for pattern in self.ways)


BOM, AOM, AUTO = "bounding_opacity_maps*", "adaptive_opacity_maps*", "auto*"
DOM, OSM = "deep_opacity_maps*", "opacity_shadow_maps*"
FOM, MOMENTS = "fourier_opacity_maps*", "moment_opacity_maps*"
CLUSTERS, LISTS = "density_clustering*", "deep_shadow_maps*"

_OWN_LAYER = "what lies in the receiver's own layer counts in part"
_HALF = "a series has half of a caster at its own depth"
_OUTLIERS = "layers between casters far apart are as thick as the gap"
_BOUND = "its lists are exact within error_bound, .01 of T"
_SLICES = "slices of the whole map: all surfaces lie in one"
_BEHIND_FIRST = "the extent of its layers is that of the map's casters, not of the texel's"
_SERIES = "7 coefficients tell no depths apart that are nearer than a seventh of the map's"
_MOMENTS = "4 moments are exact of two casters"
_ROUNDING = "moments multiply what float32 rounds, most where a texel holds everything"
_OWN_PART = "beside a strand nearly opaque, what is left without its own part is rounding"
_PLANES = "bounds that are rounded anew move planes, and a caster in a layer of its own is a step"
_SEGMENTS = (
    "a strand is corrected for as one line, of one depth a texel; of segments shorter than that "
    "some lie in the receiver's own slice"
)
_HALF_FLOAT = "sums of 11 bits"
_EIGHT_BITS = "a fragment below half of a 255th of kappa is lost"

EXCEPTIONS: tuple[NamedException, ...] = (
    NamedException("ten_thousand_fragments", ("* float16",), 1.0, _HALF_FLOAT, only_on="gpu"),
    NamedException("ten_thousand_fragments", ("* unorm8",), 1.0, _EIGHT_BITS),
    NamedException("a_hundred_thousand_fragments", ("* float16",), 1.0, _HALF_FLOAT, only_on="gpu"),
    NamedException("a_hundred_thousand_fragments", ("* unorm8",), 1.0, _EIGHT_BITS),
    NamedException("a_million_fragments", ("* float16",), 1.0, _HALF_FLOAT, only_on="gpu"),
    NamedException("a_million_fragments", ("* unorm8",), 1.0, _EIGHT_BITS),
    NamedException("thin_ribbon", (FOM,), 0.995, _HALF),
    NamedException("thin_ribbon", (MOMENTS,), 0.92, "moments count a quarter of what is there"),
    NamedException("receivers_on_the_planes", (BOM, AOM, AUTO, DOM), 0.095, _OWN_LAYER),
    NamedException("receivers_on_the_planes", (OSM, CLUSTERS), 0.055, _OWN_LAYER),
    NamedException("receivers_on_the_planes", (FOM,), 0.3, _SERIES),
    NamedException("receivers_on_the_planes", (MOMENTS,), 0.2, _MOMENTS),
    NamedException("receivers_on_the_planes", (LISTS,), 0.01, _BOUND),
    NamedException("first_fragment", (OSM,), 0.0011, _SEGMENTS),
    NamedException("first_fragment", (FOM,), 0.01, _SERIES),
    NamedException("two_clusters_far_apart", (AOM, AUTO), 0.007, _OUTLIERS),
    NamedException("two_clusters_far_apart", (BOM,), 0.02, _OUTLIERS),
    NamedException("two_clusters_far_apart", (DOM,), 0.05, _OUTLIERS),
    NamedException("two_clusters_far_apart", (CLUSTERS,), 0.07, "four clusters, each a layer"),
    NamedException("two_clusters_far_apart", (OSM,), 0.14, _OUTLIERS),
    NamedException("two_clusters_far_apart", (FOM,), 0.19, _SERIES),
    NamedException("two_clusters_far_apart", (MOMENTS,), 0.12, _MOMENTS),
    NamedException("two_clusters_far_apart", (LISTS,), 0.003, _BOUND),
    NamedException("directional_range", (DOM,), 0.53, _BEHIND_FIRST),
    NamedException("directional_range", (OSM,), 0.56, _SLICES),
    NamedException("directional_range", (FOM,), 0.5, _SERIES),
    NamedException("directional_range", (MOMENTS,), 0.3, _MOMENTS),
    NamedException("directional_range", (LISTS,), 0.003, _BOUND),
    NamedException("point_range", (DOM,), 0.035, _BEHIND_FIRST),
    NamedException("point_range", (OSM,), 0.7, _SLICES),
    NamedException("point_range", (FOM,), 0.5, _SERIES),
    NamedException("point_range", (MOMENTS,), 0.4, _MOMENTS),
    NamedException("point_range", (LISTS,), 0.0035, _BOUND),
    NamedException("no_mirrored_shadow", (FOM,), 0.015, _SERIES),
    NamedException("light_inside", (OSM,), 0.006, _OWN_LAYER),
    NamedException("light_inside", (FOM,), 0.045, _SERIES),
    NamedException("light_inside", (MOMENTS,), 0.11, _MOMENTS),
    NamedException("light_inside", (LISTS,), 0.003, _BOUND),
    NamedException("permuted", (MOMENTS,), 2.7e-4, _ROUNDING),
    NamedException("scaled", (BOM, AOM), 7e-5, _PLANES),
    NamedException("scaled", (MOMENTS,), 1e-3, _ROUNDING),
    NamedException("instanced", (MOMENTS,), 1.45e-3, _ROUNDING),
    NamedException("both_devices", (MOMENTS,), 0.05, _OWN_PART, only_on="gpu"),
    NamedException("never_rises", (FOM,), 0.15, "a series rings"),
    NamedException("never_rises", (MOMENTS,), 5e-7, _ROUNDING, only_on="gpu"),
    NamedException("hardly_rises", (FOM,), 0.25, "a series rings"),
)


def exception_of(case: str, way: str) -> NamedException | None:
    """The one that is about this way of this case; the first of several."""
    return next((one for one in EXCEPTIONS if one.is_about(case, way)), None)


def table() -> str:
    """What docs/stress.md lists: a row for each."""
    rows = [f"| `{one.case}` | {_ways(one)} | {one.size:g} | {one.why} |" for one in EXCEPTIONS]
    return "\n".join(["| case | of | size | why |", "|---|---|---|---|", *rows]) + "\n"


def _ways(one: NamedException) -> str:
    own = ", ".join(f"`{way}`" for way in one.ways)
    return f"{own}, {one.only_on} alone" if one.only_on else own
