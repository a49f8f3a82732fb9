"""Models whose total error is measured: strands under one light, and what they may cost at most."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import depth_error
import generated_scenes
import numpy as np
import numpy.typing as npt

import pyopacity as po
from pyopacity.comparison import Receivers, sample_receivers
from pyopacity.comparison.truth import texel_side

Array = npt.NDArray[np.float32]

OPACITY = 0.3
RECEIVERS, RAYS, SEED = 4000, 64, 0
# The most RMSE of `exact` and of bounding_opacity_maps with 16 layers at every map size.
UNSEEN = (0.06, 0.07)


@dataclass(frozen=True)
class Model:
    """Strands, with or without the body that they grow on."""

    name: str
    scene: po.Scene
    goals: tuple[float, float] = UNSEEN


def models(only: Sequence[str] | None = None) -> Iterator[Model]:
    """All, or those of these names; of files, those that PYOPACITY_DATA has."""
    for name, make in _makers().items():
        if only is None or name in only:
            yield make(name)


def _makers() -> dict[str, Callable[[str], Model]]:
    hair, opaque = depth_error.DATA / "hair", depth_error.DATA / "opaque"
    bear, ponytail = hair / "bear.hair", hair / "ponytail.hair"
    files: dict[str, tuple[list[Path], float, tuple[float, float]]] = {
        "straight.hair": ([hair / "straight.hair"], 0.1, (0.035, 0.04)),
        "bear.hair": ([bear], 0.15, (0.045, 0.06)),
        "bear.hair on its body": ([bear, opaque / "bear_body.obj"], 0.15, (0.045, 0.06)),
        "ponytail.hair": ([ponytail], 0.15, UNSEEN),
        "ponytail.hair on its head": ([ponytail, opaque / "ponytail_head.obj"], 0.15, UNSEEN),
    }
    makers: dict[str, Callable[[str], Model]] = {"demo:hair": _demo}
    makers |= dict.fromkeys(generated_scenes.GENERATED, _generated)
    for name, (paths, width, goals) in files.items():
        if all(path.exists() for path in paths):
            makers[name] = _loader(paths, width, goals)
    return makers


def _loader(paths: list[Path], width: float, goals: tuple[float, float]) -> Callable[[str], Model]:
    def load(name: str) -> Model:
        shapes = [shape for path in paths for shape in po.load(str(path))]
        for shape in shapes:
            if isinstance(shape, po.Strands):
                shape.width, shape.opacity = width, OPACITY
        return model(name, shapes, goals)

    return load


def _demo(name: str) -> Model:
    return model(name, po.load(name))


def _generated(name: str) -> Model:
    return model(name, [generated_scenes.GENERATED[name]()])


def model(name: str, shapes: list[po.Shape], goals: tuple[float, float] = UNSEEN) -> Model:
    """Under the light of all benchmarks; only strands are looked at."""
    for shape in shapes:
        shape.receives = isinstance(shape, po.Strands)
    return Model(name, po.Scene(shapes, po.DirectionalLight(depth_error.LIGHT)), goals)


class Bench:
    """Total error of a model at some of its strands' vertices, on the CPU's maps."""

    def __init__(
        self, model: Model, receivers: int = RECEIVERS, rays: int = RAYS, seed: int = SEED
    ) -> None:
        self.scene, self.rays = model.scene, rays
        self.receivers: Receivers = sample_receivers(model.scene, receivers, seed)
        self.renderer = po.Renderer(model.scene, device="cpu")
        self._truth: dict[float, Array] = {}
        self._texels: dict[int, float] = {}

    def texel(self, map_size: int) -> float:
        """Side of a texel, world units."""
        if map_size not in self._texels:
            self._set(po.technique("unshadowed"), map_size)
            self.renderer.transmittance(self.receivers.points[:1])
            self._texels[map_size] = texel_side(self.renderer)
        return self._texels[map_size]

    def truth(self, footprint: float) -> Array:
        """T by rays over a square of this side in world units."""
        if footprint not in self._truth:
            points, bias = self.receivers.points, self.receivers.bias
            self._truth[footprint] = po.trace_transmittance(
                self.scene, points, 0, footprint, self.rays, bias=bias
            )
        return self._truth[footprint]

    def errors(
        self,
        technique: po.Technique,
        map_size: int,
        footprint: float,
        look_ups: Sequence[Mapping[str, Any]] = ({},),
    ) -> list[po.metrics.Errors]:
        """Of T against rays over the footprint, with each of these parameters on the same map."""
        self._set(technique, map_size)
        truth, found = self.truth(footprint), []
        for parameters in look_ups:
            for name, value in parameters.items():
                setattr(technique, name, value)
            found.append(po.metrics.errors(self.receivers.transmittance(self.renderer), truth))
        return found

    def map_size_choice(self, technique: po.Technique) -> tuple[int, str]:
        """What map_size="auto" takes, and why."""
        self._set(technique, "auto")
        self.receivers.transmittance(self.renderer)
        note = next(row.note for row in self.renderer.report if row.name == "map_size")
        size, _, why = note.partition(" texels: ")
        return int(size), why

    def _set(self, technique: po.Technique, map_size: int | str) -> None:
        self.renderer.map_size, self.renderer.technique = map_size, technique
