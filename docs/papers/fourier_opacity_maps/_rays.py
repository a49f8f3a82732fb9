"""One ray through an absorption function: exact T, and what a basis rebuilds of it.

The function is cut into thin sheets across the light, and T is asked of the engine's own maps. Two
sheets that stop no light to speak of hold the map's depths at 0 to 1.
"""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
from common.scenes import along_a_ray, sheets

import pyopacity as po

Values = npt.NDArray[np.float64]
SHEETS = 800
ASKED = np.linspace(0.001, 0.999, 400)
NOTHING = 1e-7  # opacity


def gaussian(middle: float, width: float, optical_depth: float) -> Callable[[Values], Values]:
    """A feature of this optical depth in all."""
    peak = optical_depth / (width * np.sqrt(2.0 * np.pi))
    return lambda z: peak * np.exp(-0.5 * ((z - middle) / width) ** 2)


def casting(absorption: Callable[[Values], Values]) -> po.Mesh:
    """The function as sheets."""
    depths = (np.arange(SHEETS) + 0.5) / SHEETS
    opacities = -np.expm1(-absorption(depths) / SHEETS)
    with_ends = np.pad(depths, 1, constant_values=(0.0, 1.0)), np.pad(opacities, 1)
    return sheets(with_ends[0], np.maximum(with_ends[1], NOTHING))


def exact(absorption: Callable[[Values], Values]) -> Values:
    """T where it is asked, by the exact lists."""
    return along_a_ray(po.technique("exact"), casting(absorption), ASKED).astype(np.float64)


def rebuilt(
    absorption: Callable[[Values], Values], coefficients: int, **parameters: object
) -> Values:
    """T where it is asked, by a series; the engine keeps it between that of nothing and of all."""
    technique = po.technique("fourier_opacity_maps", coefficients=coefficients, **parameters)
    return along_a_ray(technique, casting(absorption), ASKED).astype(np.float64)


def unclamped(absorption: Callable[[Values], Values], coefficients: int) -> Values:
    """The same as in the paper: its equation 3, of the map's coefficients, and nothing else."""
    technique = po.technique("fourier_opacity_maps", coefficients=coefficients, margin=0.0)
    scene = po.Scene(casting(absorption), po.DirectionalLight((0, 0, -1)))
    with po.Renderer(scene, technique=technique, device="cpu", map_size=16) as used:
        used.transmittance(np.zeros((1, 3)))
        sums = used.read("fourier_opacity_maps/coefficients")[:, 8, 8, :].reshape(-1)
        d = ASKED * -used.light_from_world[2, 2]
    optical_depth = sums[0] * d
    for k in range(1, coefficients // 2 + 1):
        turn, scale = 2.0 * np.pi * k * d, 1.0 / (np.pi * k)
        optical_depth += scale * sums[2 * k - 1] * np.sin(turn)
        optical_depth += scale * sums[2 * k] * (1.0 - np.cos(turn))
    return np.exp(-optical_depth)


def ringing(T: Values) -> float:
    """The largest rise of T along a ray, which nothing that casts can cause."""
    return float(np.max(T - np.minimum.accumulate(T)))


def rmse(found: Values, right: Values) -> float:
    return float(np.sqrt(np.mean((found - right) ** 2)))
