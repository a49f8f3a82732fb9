"""Casters far apart in one texel: what bounds and slices see."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from pyopacity import metrics
from pyopacity.scene import Scene
from pyopacity.shapes import Strands
from pyopacity.stress.bench import Bench
from pyopacity.stress.case import Finding, case
from pyopacity.stress.shapes import down
from pyopacity.stress.way import Way, exact, parameters_of

F64 = npt.NDArray[np.float64]
LAYERS = 8
AUTO = "auto"


def two_clusters() -> Scene:
    """Dense threads at .1 and .9 of the range, which a lone thread at each end stretches."""
    random = np.random.default_rng(3)
    height = np.where(np.arange(1500) % 2, 8.0, -8.0)[:, None]
    roots = random.normal(0.0, 0.3, (1500, 3)) + height * (0, 0, 1)
    along = np.linspace(-1, 1, 4)[:, None] * random.normal(0, 0.3, (1500, 1, 3))
    ends = np.zeros((2, 4, 3)) + np.linspace(-1, 1, 4)[:, None] * (1, 0.2, 0)
    ends += np.array([10.0, -10.0])[:, None, None] * (0, 0, 1)
    points = np.concatenate([roots[:, None] + along, ends]).reshape(-1, 3)
    strands = Strands(points, np.arange(1503) * 4, width=0.05, opacity=0.4)
    return Scene(strands, down())


def _errors(bench: Bench, layers: int) -> Iterator[tuple[Way, float]]:
    """RMSE of T at the casters against the exact lists of the same map."""
    scene = two_clusters()
    strands = scene.shapes[0]
    for device in bench.devices:
        right = bench.T(exact(device), scene, strands, 128, bias="auto")
        for way in bench.ways():
            if way.device == device:
                T = bench.T(way, scene, strands, 128, bias="auto", layers=layers, memory=1)
                yield way, metrics.rmse(T, right)


@case(
    "outlier",
    input="threads at .1 and .9 of the depth between lone ones, 8 layers; technique auto, no lists",
    right="at most 10 % worse than the best of as many layers",
    tolerance=1.1,
    of="RMSE of T, by the best one's",
)
def auto_is_near_the_best(bench: Bench) -> Iterator[Finding]:
    """The exact lists of the same map are the truth; no technique is chosen by hand."""
    found = list(_errors(bench, LAYERS))
    for device in bench.devices:
        errors = {way: error for way, error in found if way.device == device}
        layered = {w: e for w, e in errors.items() if "layers" in parameters_of(w.technique)}
        best = min(error for way, error in layered.items() if way.technique != AUTO)
        for way, error in layered.items():
            if way.technique == AUTO:
                yield Finding(way, error / best, f"{error:.5f}, {best:.5f}")


@case(
    "outlier",
    input="the same, each technique at its default",
    right="the exact lists' T",
    tolerance=1e-4,
    of="RMSE of T",
    why_tolerance="of exact lists summed in another order; whoever has layers is a named exception",
)
def two_clusters_far_apart(bench: Bench) -> Iterator[Finding]:
    """Both clusters are in front of the lower one's threads, at whatever distance."""
    for way, error in _errors(bench, 16):
        yield Finding(way, error, f"{error:.5f}")
