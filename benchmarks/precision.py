"""Which digits survive: accumulators, depth formats, far origins, correlation, recurrences.

    python benchmarks/precision.py docs/precision > tables.md

Prints the tables of docs/precision.md, and draws its plots into the folder. Formats are computed
by numpy, one operation after the other, against float64; T far from the origin, and our
correlation, are the engine's.
"""

from __future__ import annotations

import math
import pathlib
import sys
from collections.abc import Callable, Iterable

import numpy as np
import numpy.typing as npt
from plots import Line, log_log

import pyopacity as po
from pyopacity import _native
from pyopacity.stress.formulas import noisy, two_passes
from pyopacity.stress.shapes import tangle

F64 = npt.NDArray[np.float64]
LARGEST = 1.0 - 2.0**-24

# ---- accumulators ----

KAPPA = 8.0 * math.log(2.0)  # the optical depth of a full channel of 8 bits
RANGE = 128.0  # of fixed point


def in_float32(tau: float, count: int) -> float:
    """One float32 sum, as blending adds."""
    return float(np.cumsum(np.full(count, tau, np.float32), dtype=np.float32)[-1])


def in_float16(tau: float, count: int) -> float:
    """The same in halves, rounded to nearest, until a step changes nothing any more."""
    total, one = np.float16(0.0), np.float16(tau)
    with np.errstate(over="ignore"):
        for _ in range(count):
            after = np.float16(total + one)
            if after == total:
                break
            total = after
    return float(total)


def in_unorm8(tau: float, count: int) -> float:
    """255ths of kappa, rounded at each step, as blending into 8 bits does."""
    step = math.floor(255.0 * tau / KAPPA + 0.5)
    return min(count * step, 255) / 255.0 * KAPPA


def in_fixed32(tau: float, count: int) -> float:
    """Units of 2^-31 of the range or finer: decision 7."""
    unit = 2.0 ** -math.floor(32.0 - math.log2(min(max(2.0 * tau * count, 2.0**-40), RANGE)))
    return math.floor(tau / unit + 0.5) * unit * count


ACCUMULATORS: dict[str, Callable[[float, int], float]] = {
    "float32": in_float32,
    "fixed32": in_fixed32,
    "float16": in_float16,
    "unorm8": in_unorm8,
}
OVERLAPS = tuple(10**k for k in range(1, 7))
OPACITIES = (1e-8, 1e-6, 1e-4, 1e-2, 0.3, LARGEST)


def error_of_T(omega: float, tau: float, count: int) -> float:
    return abs(math.exp(-omega) - math.exp(-tau * count))


def accumulators(folder: pathlib.Path) -> Iterable[str]:
    yield "| overlaps | " + " | ".join(ACCUMULATORS) + " |"
    yield "|---" * (1 + len(ACCUMULATORS)) + "|"
    worst: dict[str, list[float]] = {name: [] for name in ACCUMULATORS}
    for count in OVERLAPS:
        cells = []
        for name, add in ACCUMULATORS.items():
            # The last one lets exp(-2) of the light through, where T has most to lose.
            taus = [-math.log1p(-opacity) for opacity in OPACITIES] + [2.0 / count]
            errors = [error_of_T(add(tau, count), tau, count) for tau in taus]
            at = int(np.argmax(errors))
            worst[name].append(errors[at])
            cells.append(f"{errors[at]:.1e} ({-math.expm1(-taus[at]):.2g})")
        yield f"| 1e{round(math.log10(count))} | {' | '.join(cells)} |"
    lines = [Line(name, OVERLAPS, errors) for name, errors in worst.items()]
    log_log(folder / "accumulators.svg", "error of T, worst opacity", "overlaps", lines)


# ---- depth ----


def _float_bits(depth: F64) -> F64:
    return depth.astype(np.float32).astype(np.float64)


def _whole(bits: int) -> Callable[[F64], F64]:
    return lambda depth: np.round(depth * (2.0**bits - 1.0)) / (2.0**bits - 1.0)


FORMATS = {"float32": _float_bits, "16 bits": _whole(16), "8 bits": _whole(8)}
RATIOS = tuple(10.0**k for k in range(1, 7))


def depth_errors(stored: Callable[[F64], F64], ratio: float, is_linear: bool) -> float:
    """Largest error of a depth between near 1 and far, by the range of depths."""
    near, far = 1.0, ratio
    z = np.geomspace(near, far, 20_001)
    if is_linear:
        back = near + stored((z - near) / (far - near)) * (far - near)
    else:
        ndc = stored(far / (far - near) * (1.0 - near / z))
        back = near / (1.0 - ndc * (far - near) / far)
    return float(np.max(np.abs(back - z)) / (far - near))


def depth_formats(folder: pathlib.Path) -> Iterable[str]:
    names = [(name, kind) for name in FORMATS for kind in ("linear", "NDC")]
    yield "| far / near | " + " | ".join(f"{name}, {kind}" for name, kind in names) + " |"
    yield "|---" * (1 + len(names)) + "|"
    found: dict[tuple[str, str], list[float]] = {name: [] for name in names}
    for ratio in RATIOS:
        for name in names:
            found[name].append(depth_errors(FORMATS[name[0]], ratio, name[1] == "linear"))
        cells = " | ".join(f"{found[name][-1]:.1e}" for name in names)
        yield f"| 1e{round(math.log10(ratio))} | {cells} |"
    lines = [Line(", ".join(name), RATIOS, errors) for name, errors in found.items()]
    log_log(folder / "depths.svg", "error of depth, by the range", "far / near", lines)


# ---- distance from the origin ----

DISTANCES = (0.0, *(10.0**k for k in range(1, 8)))


def T_at(distance: float, dtype: type) -> F64:
    """T of a tangle that far away, whose points are given in a format."""
    points, offsets = tangle(9, 60)
    moved = (points + distance * np.array([1.0, -0.7, 0.4])).astype(dtype)
    strands = po.Strands(moved, offsets, width=0.2, opacity=0.3)
    scene = po.Scene(strands, po.DirectionalLight((0.5, 0.3, -0.8)))
    technique = po.technique("exact", bias=0.2)
    return po.transmittance(scene, strands, technique, 64).astype(np.float64)


def origins(folder: pathlib.Path) -> Iterable[str]:
    yield "| distance | float64 | float32 | spacing of float32 |"
    yield "|---|---|---|---|"
    right = T_at(0.0, np.float64)
    found: dict[str, list[float]] = {"float64": [], "float32": []}
    for distance in DISTANCES[1:]:
        for name, dtype in (("float64", np.float64), ("float32", np.float32)):
            found[name].append(po.metrics.rmse(T_at(distance, dtype), right))
        cells = " | ".join(f"{found[name][-1]:.1e}" for name in found)
        spacing = np.spacing(np.float32(distance))
        yield f"| 1e{round(math.log10(distance))} | {cells} | {spacing:.1e} |"
    lines = [Line(f"points in {name}", DISTANCES[1:], errors) for name, errors in found.items()]
    log_log(folder / "origins.svg", "RMSE of T", "distance from the origin", lines)


# ---- correlation ----

MEANS = (0.0, 1.0, 10.0, 100.0, 1e3, 1e4)
PARTS = 64


def one_pass(x: F64, y: F64, dtype: type) -> float:
    """The thesis's sums of products, section 5.2.4."""
    a, b = x.astype(dtype), y.astype(dtype)
    n = dtype(len(a))
    sums = [dtype(np.cumsum(v, dtype=dtype)[-1]) for v in (a, b, a * b, a * a, b * b)]
    sx, sy, xy, xx, yy = sums
    with np.errstate(all="ignore"):
        below = (n * xx - sx * sx) * (n * yy - sy * sy)
        return float((n * xy - sx * sy) / np.sqrt(below))


def two_pass(x: F64, y: F64, dtype: type) -> float:
    """First the means, then the sums, in a format."""
    a, b = x.astype(dtype), y.astype(dtype)
    da, db = a - np.mean(a, dtype=dtype), b - np.mean(b, dtype=dtype)
    top = np.cumsum(da * db, dtype=dtype)[-1]
    below = np.cumsum(da * da, dtype=dtype)[-1] * np.cumsum(db * db, dtype=dtype)[-1]
    return float(top / np.sqrt(below))


def merged(x: F64, y: F64, dtype: type) -> float:
    """Two passes over each of some parts, and the parts put together (Chan et al. 1979)."""
    n, mean, moments = dtype(0.0), np.zeros(2, dtype), np.zeros(3, dtype)
    for a, b in zip(np.array_split(x.astype(dtype), PARTS), np.array_split(y.astype(dtype), PARTS),
                    strict=True):  # fmt: skip
        m = dtype(len(a))
        own = np.array([a.mean(dtype=dtype), b.mean(dtype=dtype)], dtype)
        da, db = a - own[0], b - own[1]
        d, weight = own - mean, n * m / (n + m)
        moments += np.array([da @ db, da @ da, db @ db], dtype)
        moments += weight * np.array([d[0] * d[1], d[0] * d[0], d[1] * d[1]], dtype)
        mean, n = mean + d * m / (n + m), n + m
    return float(moments[0] / np.sqrt(moments[1] * moments[2]))


def correlations(folder: pathlib.Path) -> Iterable[str]:
    ways: dict[str, Callable[[F64, F64], float]] = {}
    for dtype in (np.float32, np.float64):
        for name, way in (("one pass", one_pass), ("two passes", two_pass), ("merged", merged)):
            ways[f"{name}, {dtype.__name__}"] = lambda x, y, way=way, dtype=dtype: way(x, y, dtype)
    ways["ours, float64"] = _native.correlation
    yield "| mean / deviation | right | " + " | ".join(ways) + " |"
    yield "|---" * (2 + len(ways)) + "|"
    errors: dict[str, list[float]] = {name: [] for name in ways}
    for mean in MEANS:
        x, y = noisy(np.random.default_rng(1), mean, 0.9, 0.436)
        right = two_passes(x, y)
        got = {name: way(x, y) for name, way in ways.items()}
        for name, value in got.items():
            errors[name].append(1.0 if math.isnan(value) else min(abs(value - right), 10.0))
        cells = " | ".join(f"{value:.7f}" for value in got.values())
        yield f"| {mean:g} | {right:.7f} | {cells} |"
    lines = [Line(name, MEANS[1:], found[1:]) for name, found in errors.items()]
    log_log(folder / "correlations.svg", "error of C", "mean / deviation", lines)


# ---- recurrences ----

HARMONICS = tuple(range(1, 32))  # 63 coefficients


def _turned(z: npt.NDArray[np.float32], most: int, is_reduced: bool) -> list[F64]:
    """cos 2 pi k z by turning the first one on, in float32."""
    two_pi = np.float32(2.0 * np.pi)
    turns = z - np.round(z) if is_reduced else z
    c, s = np.cos(two_pi * turns), np.sin(two_pi * turns)
    found, x, y = [], np.ones_like(c), np.zeros_like(c)
    for _ in range(most):
        x, y = x * c - y * s, y * c + x * s
        found.append(x.astype(np.float64))
    return found


def recurrences(folder: pathlib.Path) -> Iterable[str]:
    z = np.random.default_rng(0).uniform(0.0, 1.0, 20_000).astype(np.float32)
    right = [np.cos(2.0 * np.pi * k * z.astype(np.float64)) for k in HARMONICS]
    two_pi = np.float32(2.0 * np.pi)
    direct = [np.cos(two_pi * np.float32(k) * z).astype(np.float64) for k in HARMONICS]
    ways = {
        "turned on, reduced (ours)": _turned(z, len(HARMONICS), True),
        "turned on": _turned(z, len(HARMONICS), False),
        "cos of each": direct,
        "Legendre, float32": _legendre(z),
    }
    right_of = {"Legendre, float32": _legendre(z.astype(np.float64))}
    yield "| coefficients | " + " | ".join(ways) + " |"
    yield "|---" * (1 + len(ways)) + "|"
    errors = {
        name: [
            float(np.abs(f - r).max())
            for f, r in zip(found, right_of.get(name, right), strict=True)
        ]
        for name, found in ways.items()
    }
    for k in (1, 3, 7, 15, 31):
        yield f"| {2 * k + 1} | " + " | ".join(f"{e[k - 1]:.1e}" for e in errors.values()) + " |"
    count = [2 * k + 1 for k in HARMONICS]
    lines = [Line(name, count, found) for name, found in errors.items()]
    log_log(folder / "recurrences.svg", "largest error of a function", "coefficients", lines)


def _largest(found: list[F64], right: list[F64]) -> list[float]:
    return [float(np.abs(f - r).max()) for f, r in zip(found, right, strict=True)]


def _legendre(z: npt.NDArray[np.floating]) -> list[F64]:
    """P_2k of 2 z - 1, by the three-term recurrence in the format of z."""
    x = (2 * z - 1).astype(z.dtype)
    before, here, found = np.ones_like(x), x, []
    for n in range(1, 2 * len(HARMONICS)):
        ahead = ((2 * n + 1) * x * here - n * before) / (n + 1)
        before, here = here, ahead.astype(z.dtype)
        if n % 2 == 1:
            found.append(here.astype(np.float64))
    return found


def main() -> None:
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(exist_ok=True)
    for study in (accumulators, depth_formats, origins, correlations, recurrences):
        print(f"\n{study.__name__}\n")
        for line in study(folder):
            print(line, flush=True)


if __name__ == "__main__":
    main()
