"""Small scenes, and what holds for every test: a reason to skip, and nothing left on the GPU."""

from __future__ import annotations

import functools
import gc
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import pyopacity as po
from pyopacity import _native

Result = subprocess.CompletedProcess[str]


@pytest.fixture(scope="session")
def needs_gl() -> None:
    """Skips where no context is to be had, and only then: any other failure is a failure."""
    try:
        _native.Context.headless()
    except po.ContextError as error:
        pytest.skip(f"no OpenGL here: {error.what}")


@pytest.fixture(autouse=True)
def gl_marker(request: pytest.FixtureRequest) -> None:
    if request.node.get_closest_marker("gl"):
        request.getfixturevalue("needs_gl")


@pytest.fixture(autouse=True)
def nothing_left_on_the_gpu(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Every renderer that a test makes frees all of its OpenGL objects."""
    contexts: list[_native.Context] = []
    make = po.Renderer.__init__

    @functools.wraps(make)  # keywords are checked against the signature
    def make_and_remember(self: po.Renderer, *args: Any, **settings: Any) -> None:
        make(self, *args, **settings)
        if self.device != "cpu":
            contexts.append(self.context)

    monkeypatch.setattr(po.Renderer, "__init__", make_and_remember)
    yield
    gc.collect()
    assert [context.live_objects for context in contexts] == [0] * len(contexts)


# ---- shapes: z points up, about one unit across ----


def tuft(seed: int = 0, strands: int = 12, points: int = 6) -> po.Strands:
    """Curved strands that rise from the ground."""
    random = np.random.default_rng(seed)
    roots = random.uniform((-0.4, -0.4, 0.1), (0.4, 0.4, 0.2), (strands, 1, 3))
    along = np.linspace(0.0, 1.0, points)[None, :, None]
    lean = random.uniform((-0.3, -0.3, 0.6), (0.3, 0.3, 1.0), (strands, 1, 3))
    bend = random.uniform(-0.3, 0.3, (strands, 1, 3))
    xyz = (roots + along * lean + along**2 * bend).reshape(-1, 3)
    offsets = np.arange(0, strands * points + 1, points)
    return po.Strands(xyz, offsets, width=0.05, opacity=0.4, color=(0.6, 0.4, 0.2))


def sheet(height: float = 0.0, half_size: float = 2.0, **attributes: Any) -> po.Mesh:
    """A square across the z axis."""
    s = half_size
    corners = [(-s, -s, height), (s, -s, height), (s, s, height), (-s, s, height)]
    triangles = np.array([[0, 1, 2], [0, 2, 3]])
    return po.Mesh(np.array(corners, np.float64), triangles, **attributes)


def ball(center: tuple[float, float, float] = (0.0, 0.0, 0.5), radius: float = 0.3) -> po.Mesh:
    """An opaque sphere of 8 x 16 faces."""
    theta, phi = np.meshgrid(
        np.linspace(0.0, np.pi, 9), np.linspace(0.0, 2.0 * np.pi, 17), indexing="ij"
    )
    around = np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)
    xyz = np.stack(around, axis=-1).reshape(-1, 3) * radius + center
    corner = np.arange(9 * 17).reshape(9, 17)
    a, b, c, d = corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]
    triangles = np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)
    return po.Mesh(xyz.astype(np.float32), triangles)


@pytest.fixture(name="tuft")
def tuft_factory() -> Callable[..., po.Strands]:
    return tuft


@pytest.fixture(name="sheet")
def sheet_factory() -> Callable[..., po.Mesh]:
    return sheet


@pytest.fixture(name="ball")
def ball_factory() -> Callable[..., po.Mesh]:
    return ball


def tuft_and_ball() -> po.Scene:
    """A tuft beside a ball, both on a ground that does not cast, under one light."""
    ground = sheet(half_size=3.0)
    ground.casts = False
    light = po.DirectionalLight((0.5, 0.3, -0.8))
    return po.Scene([tuft(), ball((0.7, 0.0, 0.5)), ground], light)


@pytest.fixture
def scene() -> po.Scene:
    return tuft_and_ball()


# Opaque: what is translucent adds passes, which tests/python/test_compositing.py is about.
SMALL: dict[str, Any] = {
    "size": (48, 32),
    "map_size": 64,
    "antialiasing": 1,
    "compositing": "opaque",
}


@pytest.fixture(name="small")
def small_settings() -> dict[str, Any]:
    """Settings for pictures that take little time."""
    return dict(SMALL)


def small_renderer(scene: po.Scene) -> po.Renderer:
    camera = po.Camera.fit(scene.shapes[:2])
    return po.Renderer(scene, camera, technique="bounding_opacity_maps", **SMALL)


@pytest.fixture
def renderer(needs_gl: None, scene: po.Scene) -> Iterator[po.Renderer]:
    """Renders `scene`, small."""
    with small_renderer(scene) as small:
        yield small


@pytest.fixture(name="new_renderer")
def renderer_factory(needs_gl: None) -> Callable[[], po.Renderer]:
    """For a test that needs more than one: each with a scene of its own, like `scene`."""
    return lambda: small_renderer(tuft_and_ball())


# ---- commands ----


@pytest.fixture(scope="session")
def python() -> Callable[..., Result]:
    """Runs Python apart from this process."""

    def run(*arguments: str, **environment: str) -> Result:
        return subprocess.run(
            [sys.executable, *arguments],
            capture_output=True,
            text=True,
            timeout=120,
            env={**os.environ, **environment},
        )

    return run


def same(a: npt.NDArray[Any], b: npt.NDArray[Any]) -> bool:
    """Equal bit for bit."""
    return a.shape == b.shape and a.tobytes() == b.tobytes()


@pytest.fixture(name="same")
def same_bits() -> Callable[..., bool]:
    return same
