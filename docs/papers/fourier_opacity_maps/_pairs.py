"""Fourier opacity maps beside opacity shadow maps of as many channels, as the paper compares."""

from common.scenes import published

import pyopacity as po

FOM, OSM = "FOM", "OSM"


def pair(channels: int) -> dict[str, po.Technique]:
    """As published: coefficients between global bounds, and as many even slices."""
    return {
        FOM: published("fourier_opacity_maps", coefficients=channels),
        OSM: published("opacity_shadow_maps", layers=channels),
    }
