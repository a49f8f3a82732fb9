"""One hash a driver: runs, threads, processes.

    python -m pyopacity.stress.digests DEVICE RUNS

prints the hashes of every way on a device, as JSON: what other processes are compared with.
"""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
from collections.abc import Iterator

import numpy as np

from pyopacity._arrays import Floats
from pyopacity.errors import Error
from pyopacity.scene import Scene
from pyopacity.shapes import Shape
from pyopacity.stress.bench import Bench
from pyopacity.stress.case import Finding, case, wrong
from pyopacity.stress.shapes import hair, random_shapes, slanted
from pyopacity.stress.way import ALL, Device, Way

Digests = dict[str, list[str]]
# Threads of ours, and of llvmpipe.
_THREADS = ("OPACITY_THREADS", "LP_NUM_THREADS")


def digest(bench: Bench, way: Way) -> str:
    """Of T at points, at strands and at surfaces, under every kind of caster."""
    scene = Scene(hair(2, strands=30), random_shapes(8), slanted())
    renderer = bench.renderer(way, scene)
    points = np.random.default_rng(1).uniform(-3, 3, (2000, 3))
    asked: list[Floats | Shape] = [points, *scene.shapes[:2]]
    answers = [renderer.transmittance(where) for where in asked]
    bench.clear()
    return hashlib.sha256(b"".join(answer.tobytes() for answer in answers)).hexdigest()


def digests(device: Device, runs: int) -> Digests:
    """Of every way on a device, as often as there are runs; each with a renderer of its own."""
    with Bench([device]) as bench:
        return {
            str(way): [digest(bench, way) for _ in range(runs)]
            for way in bench.ways(ALL, papers=True)
        }


def elsewhere(device: Device, runs: int = 1, threads: int | None = None) -> Digests:
    """The same in a process of its own, with so many threads."""
    more = {} if threads is None else {name: str(threads) for name in _THREADS}
    result = subprocess.run(
        [sys.executable, "-m", __name__, device, str(runs)],
        capture_output=True,
        text=True,
        env={**os.environ, **more},
    )
    if result.returncode != 0:
        raise Error(
            f"a process for {device} ended with {result.returncode}: {result.stderr.strip()}",
            "run python -m pyopacity.stress.digests by hand",
        )
    found: Digests = json.loads(result.stdout)
    return found


def _compared(bench: Bench, device: Device, others: dict[str, Digests]) -> Iterator[Finding]:
    runs = 10 if bench.is_thorough else 3
    own = digests(device, runs)
    for way in (w for w in bench.ways(ALL, papers=True) if w.device == device):
        hashes = own[str(way)]
        problems = [f"run {i} has another" for i, h in enumerate(hashes) if h != hashes[0]]
        for name, found in others.items():
            problems += [f"{name} has another" for h in found[str(way)] if h != hashes[0]]
        yield wrong(way, problems)


@case(
    "determinism",
    input="10 runs in this process, 3 processes, 1 .. 8 threads; every way",
    right="one hash a way",
    tolerance=0,
    of="other hashes",
    is_slow=True,
)
def one_hash(bench: Bench) -> Iterator[Finding]:
    """Each sum has one order, or is of whole numbers, whose order does not matter."""
    threads = range(1, 9) if bench.is_thorough else (1, 3)
    for device in bench.devices:
        others = {f"a process of {n} threads": elsewhere(device, 1, n) for n in threads}
        others |= {f"process {n}": elsewhere(device) for n in range(3 * bench.is_thorough)}
        yield from _compared(bench, device, others)


@case(
    "determinism",
    input="casters in another order, scattered",
    right="the same hash",
    tolerance=0,
    of="T",
)
def order_in_no_bit(bench: Bench) -> Iterator[Finding]:
    """Sums of whole numbers do not depend on their order."""
    strands = [hair(seed, strands=20) for seed in (1, 2, 3)]
    asked = bench.random().uniform(-6, 6, (1500, 3))
    scenes = [Scene(*chosen, slanted()) for chosen in (strands, strands[::-1])]
    for way in bench.ways():
        if way.given("deposit") == "scatter":
            T = [bench.T(way, scene, asked) for scene in scenes]
            off = float(np.abs(T[0] - T[1]).max())
            yield Finding(way, off, f"off by {off:.3g}")


if __name__ == "__main__":
    name, runs = sys.argv[1:]
    print(json.dumps(digests("cpu" if name == "cpu" else "gpu", int(runs))))
