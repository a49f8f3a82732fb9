"""What cases ask for T with: renderers that are kept while the scene is the same."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from types import TracebackType

import numpy as np
import numpy.typing as npt

from pyopacity._arrays import Floats, Value
from pyopacity.renderer import Renderer
from pyopacity.scene import Scene
from pyopacity.shapes import Shape
from pyopacity.stress.way import ALL, TRANSLUCENT, Device, Way, accumulators, ways

MAP_SIZE = 64
_KEPT = 6  # renderers, of the scenes asked last


class Bench:
    """Devices to ask, and how much may be asked.

    Args:
        devices: "gpu" where there is OpenGL.
        seed: of everything random.
        is_thorough: the sizes of the table, also where they take minutes.
        on_gpu: the techniques that are asked there.
        progress: told in words what is asked.

    Attributes:
        asked: the way that was asked last; None before any, and once renderers are freed.
    """

    def __init__(
        self,
        devices: Iterable[Device],
        seed: int = 0,
        is_thorough: bool = False,
        on_gpu: Iterable[str] = ALL,
        progress: Callable[[str], object] = lambda _: None,
    ) -> None:
        self.devices = tuple(devices)
        self.seed = seed
        self.is_thorough = is_thorough
        self.asked: Way | None = None
        self._on_gpu = frozenset(on_gpu)
        self._progress = progress
        self._renderers: dict[tuple[Device, int, int], Renderer] = {}

    def random(self, salt: int = 0) -> np.random.Generator:
        """A generator of this seed, for one purpose."""
        return np.random.default_rng([self.seed, salt])

    def ways(self, among: Iterable[str] = TRANSLUCENT, papers: bool = False) -> list[Way]:
        """Every way on this bench's devices: :func:`pyopacity.stress.way.ways`."""
        every = ways(self.devices, among, papers)
        return [way for way in every if way.device == "cpu" or way.technique in self._on_gpu]

    def accumulators(self) -> list[Way]:
        """Every way to sum in fewer bits."""
        every = accumulators(self.devices)
        return [way for way in every if way.device == "cpu" or way.technique in self._on_gpu]

    def renderer(self, way: Way, scene: Scene, map_size: int = MAP_SIZE, **more: Value) -> Renderer:
        """One that has the way's technique; the same for a scene, a device and a map's size."""
        self.asked = way
        self._progress(str(way))
        key = (way.device, id(scene), map_size)
        technique = way.make(**more)
        if key in self._renderers:
            self._renderers[key].technique = technique
            return self._renderers[key]
        if len(self._renderers) == _KEPT:
            self._renderers.pop(next(iter(self._renderers))).close()
        self._renderers[key] = Renderer(
            scene,
            size=(16, 12),
            technique=technique,
            device=way.device,
            map_size=map_size,
            antialiasing=1,
        )
        return self._renderers[key]

    def T(
        self,
        way: Way,
        scene: Scene,
        where: Floats | Shape,
        map_size: int = MAP_SIZE,
        light: int = 0,
        **more: Value,
    ) -> npt.NDArray[np.float64]:
        """T at points or at a shape's own, in float64; ``more`` are the technique's parameters."""
        renderer = self.renderer(way, scene, map_size, **more)
        return renderer.transmittance(where, light).astype(np.float64)

    def clear(self) -> None:
        """Frees every renderer."""
        for renderer in self._renderers.values():
            renderer.close()
        self._renderers.clear()
        self.asked = None

    def __enter__(self) -> Bench:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.clear()
