"""What opacity looks like: translucent shapes over each other, by every way of compositing."""

import random
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import pyopacity as po

pytestmark = pytest.mark.gl

ORDERED = ["sorted", "exact"]
MODES = [*ORDERED, "maps"]
ABOVE = po.Camera.look_at((0, 0, 10), (0, 0, 0), up=(0, 1, 0), fov_deg=20)


def flat(shapes: Any, mode: str, **settings: Any) -> npt.NDArray[np.float32]:
    """The middle of a picture in which every shape has its own colour: ambient light alone."""
    options: dict[str, Any] = {"size": (16, 16), "map_size": 64, "antialiasing": 1, "ambient": 1.0}
    options |= settings
    with po.Renderer(po.Scene(shapes), ABOVE, compositing=mode, **options) as renderer:
        middle: npt.NDArray[np.float32] = renderer.render()[8, 8]
        return middle


def over(layers: list[tuple[float, tuple[float, float, float]]]) -> npt.NDArray[np.float64]:
    """The nearest first."""
    rgba = np.zeros(4)
    for opacity, color in layers:
        rgba += (1.0 - rgba[3]) * opacity * np.array([*color, 1.0])
    return rgba


def sheets(sheet: Callable[..., po.Mesh], seed: int) -> tuple[list[po.Mesh], Any]:
    """Five, in any order in the scene; and as the camera meets them."""
    r = random.Random(seed)
    layers = []
    for height in range(5):
        color = (r.random(), r.random(), r.random())
        layers.append((float(height) / 2, r.uniform(0.1, 0.9), color))
    shapes = [sheet(height, opacity=opacity, color=color) for height, opacity, color in layers]
    r.shuffle(shapes)
    return shapes, [(opacity, color) for _, opacity, color in reversed(layers)]


@pytest.mark.parametrize("mode", ORDERED)
@pytest.mark.parametrize("seed", range(3))
def test_sheets_composite_to_the_closed_form(
    sheet: Callable[..., po.Mesh], mode: str, seed: int
) -> None:
    shapes, layers = sheets(sheet, seed)
    assert np.abs(flat(shapes, mode) - over(layers)).max() < 1e-5


@pytest.mark.parametrize("seed", range(3))
def test_maps_have_the_exact_opacity_and_nearly_the_colour(
    sheet: Callable[..., po.Mesh], seed: int
) -> None:
    shapes, layers = sheets(sheet, seed)
    pixel, right = flat(shapes, "maps"), over(layers)
    assert abs(pixel[3] - right[3]) < 1e-5
    assert np.abs(pixel - right).max() < 0.03


@pytest.mark.parametrize("mode", MODES)
def test_a_half_transparent_strand_over_white_shows_half(mode: str) -> None:
    strand = po.Strands(
        np.array([(-2.0, 0, 0), (2, 0, 0)]),
        np.array([0, 2]),
        width=1.0,
        opacity=0.5,
        color=(0, 0, 0),
    )
    pixel = flat(strand, mode, background=(1, 1, 1))
    assert np.abs(pixel - (0.5, 0.5, 0.5, 1.0)).max() < 1e-5
    pixel = flat(strand, mode)
    assert np.abs(pixel - (0, 0, 0, 0.5)).max() < 1e-5


@pytest.mark.parametrize("mode", MODES)
def test_what_is_opaque_hides_and_is_covered(sheet: Callable[..., po.Mesh], mode: str) -> None:
    def red(height: float) -> po.Mesh:
        return sheet(height, opacity=0.5, color=(1, 0, 0))

    ground = sheet(0.0, color=(0, 1, 0))
    assert np.abs(flat([red(1), ground], mode) - (0.5, 0.5, 0, 1)).max() < 1e-5
    assert np.abs(flat([ground, red(-1)], mode) - (0, 1, 0, 1)).max() < 1e-6


def test_in_opaque_all_is_opaque_and_in_subsets_a_third_of_each(
    sheet: Callable[..., po.Mesh],
) -> None:
    upper, lower = sheet(1, opacity=0.2, color=(1, 0, 0)), sheet(0, opacity=0.3, color=(0, 0, 1))
    assert np.abs(flat([upper, lower], "opaque") - (1, 0, 0, 1)).max() < 1e-6
    strands = po.Strands(
        np.array([(-2.0, 0, z) for z in (0, 1, 2)] + [(2.0, 0, z) for z in (0, 1, 2)])[
            [0, 3, 1, 4, 2, 5]
        ],
        np.array([0, 2, 4, 6]),
        width=1.0,
        opacity=0.1,
        color=np.repeat(np.eye(3, dtype=np.float32), 2, axis=0),
    )
    pixel = flat(strands, "subsets")
    assert np.abs(pixel - (1 / 3, 1 / 3, 1 / 3, 1)).max() < 1e-5


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize(
    ("profile", "eye", "part"),
    # Of the density from -1 to .3 a metaball has (.3 - 2/3 .3^3 + .3^5/5) 15/16 more than half.
    [("sphere", 10, 1), ("sphere", 0.3, 0.65), ("metaball", 10, 1), ("metaball", 0.3, 0.764831)],
)
def test_a_particle_is_as_opaque_as_its_chord(
    mode: str, profile: Any, eye: float, part: float
) -> None:
    """Seen from far, through its middle; and from within, from there on."""
    smoke = po.Particles(
        np.zeros((1, 3)), radius=1.0, opacity=0.6, color=(1, 1, 1), profile=profile
    )
    camera = po.Camera.look_at((0, 0, eye), (0, 0, 0), up=(0, 1, 0), fov_deg=10)
    options: dict[str, Any] = {"size": (15, 15), "map_size": 64, "antialiasing": 1}
    with po.Renderer(po.Scene(smoke), camera, compositing=mode, ambient=1.0, **options) as renderer:
        pixel = renderer.render()[7, 7]
    assert np.abs(pixel - (1.0 - 0.4**part)).max() < 1e-4


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("direction", [(0, 0, -1), (0.4, 0.2, -1), (-1, 0.01, 0.02)])
@pytest.mark.parametrize("inside", [False, True])
def test_a_volume_is_as_opaque_as_its_way_through(
    mode: str, direction: tuple[float, float, float], inside: bool
) -> None:
    extinction = np.full((4, 5, 6), 0.7, np.float32)
    slab = po.Volume(extinction, (-2.5, -2.0, -1.5), (1.0, 1.0, 1.0), color=(1, 1, 1))
    way = np.array(direction) / np.linalg.norm(direction)
    eye = np.zeros(3) if inside else -20.0 * way
    camera = po.Camera.look_at(tuple(eye), tuple(way), up=(0, 1, 0), fov_deg=5)
    options: dict[str, Any] = {"size": (9, 9), "map_size": 64, "antialiasing": 1}
    with po.Renderer(po.Scene(slab), camera, compositing=mode, ambient=1.0, **options) as renderer:
        pixel = renderer.render()[4, 4]
    # From the middle of a box to where the way leaves it.
    half = float(np.min(np.array([3.0, 2.5, 2.0]) / np.maximum(np.abs(way), 1e-9)))
    right = 1.0 - np.exp(-0.7 * half * (1 if inside else 2))
    assert np.abs(pixel - right).max() < 5e-3


@pytest.mark.parametrize("mode", MODES)
def test_what_is_opaque_cuts_media_off(sheet: Callable[..., po.Mesh], mode: str) -> None:
    ground = sheet(0.0, half_size=5.0, color=(0, 0, 0))
    smoke = po.Particles(np.zeros((1, 3)), radius=1.0, opacity=0.75, color=(1, 1, 1))
    assert np.abs(flat([ground, smoke], mode)[:3] - 0.5).max() < 5e-3  # half a pixel beside
    box = po.Volume(np.full((4, 4, 4), 0.5, np.float32), (-1.5, -1.5, -1.5), color=(1, 1, 1))
    assert np.abs(flat([ground, box], mode)[:3] - (1 - np.exp(-1.0))).max() < 5e-3


def test_maps_look_like_exact(tuft: Callable[..., po.Strands], small: dict[str, Any]) -> None:
    scene = po.Scene([tuft(strands=60), tuft(1, strands=60)], po.DirectionalLight())
    scene.shapes[1].color = (0.1, 0.3, 0.9)
    camera = po.Camera.fit(scene)
    pictures = {}
    for mode in ("maps", "exact"):
        with po.Renderer(scene, camera, **{**small, "compositing": mode}) as renderer:
            pictures[mode] = renderer.render()
    assert np.abs(pictures["maps"][..., 3] - pictures["exact"][..., 3]).max() < 1e-5
    assert po.metrics.rmse(pictures["maps"], pictures["exact"]) < 0.01


@pytest.mark.parametrize("mode", ["opaque", "subsets", *MODES])
def test_skipped_equals_forced(renderer: po.Renderer, mode: str, same: Callable[..., bool]) -> None:
    renderer.compositing = mode
    hair, _, ground = renderer.scene.shapes
    light = renderer.scene.lights[0]
    smoke = po.Particles(np.array([[0.3, 0.2, 0.8]]), radius=0.3, opacity=0.5)
    changes: list[Callable[[], object]] = [
        lambda: setattr(renderer, "camera", po.Camera.look_at((0, -3, 1.5), (0, 0, 0.5))),
        lambda: setattr(ground, "opacity", 0.5),
        lambda: renderer.scene.add(smoke),
        lambda: setattr(hair, "opacity", 1.0),
        lambda: setattr(light, "direction", (0.2, 0.5, -0.8)),
        lambda: setattr(hair, "opacity", 0.2),
        lambda: setattr(renderer, "antialiasing", 2),
        lambda: setattr(hair, "points", hair.points * 0.9),
        lambda: setattr(smoke, "color", (1, 0, 0)),
    ]
    for change in changes:
        change()
        skipped = renderer.render()
        renderer.invalidate()
        assert same(skipped, renderer.render())


def test_too_many_samples_are_refused(sheet: Callable[..., po.Mesh]) -> None:
    stack = [sheet(0.01 * i, half_size=50.0, opacity=0.1) for i in range(20)]
    with po.Renderer(
        po.Scene(stack), ABOVE, size=(2048, 2048), compositing="exact", antialiasing=1
    ) as renderer:
        with pytest.raises(po.OutOfMemoryError, match="samples"):
            renderer.render()
        renderer.size = (16, 16)
        renderer.render()


# ---- images beside the picture ----


def test_images_tell_of_the_first_surface(sheet: Callable[..., po.Mesh]) -> None:
    upper = sheet(1.0, half_size=0.5, opacity=0.25)
    scene = po.Scene([sheet(0.0, half_size=1.0), upper], po.DirectionalLight((0, 0, -1)))
    with po.Renderer(scene, ABOVE, size=(32, 32), map_size=64, background=(1, 1, 1)) as renderer:
        ids, depth = renderer.image("object_id"), renderer.image("depth")
        coverage, transmittance = renderer.image("coverage"), renderer.image("transmittance")
    assert ids.dtype == np.int32 and (ids[0, 0], ids[16, 16], ids[16, 9]) == (-1, 1, 0)
    assert np.isinf(depth[0, 0]) and abs(depth[16, 16] - 9.0) < 0.01
    assert coverage[0, 0] == 0.0 and coverage[16, 16] == pytest.approx(1.0, abs=1e-5)
    assert transmittance[0, 0] == 1.0 and transmittance[16, 9] == pytest.approx(1.0, abs=1e-5)


def test_coverage_is_the_opacity_of_a_pixel(sheet: Callable[..., po.Mesh]) -> None:
    with po.Renderer(
        po.Scene(sheet(opacity=0.25)), ABOVE, size=(8, 8), background=(1, 1, 1)
    ) as renderer:
        assert renderer.image("coverage")[4, 4] == pytest.approx(0.25, abs=1e-5)
        assert renderer.render()[4, 4, 3] == pytest.approx(1.0)


def test_an_image_that_there_is_none(renderer: po.Renderer) -> None:
    with pytest.raises(po.ParameterError, match='no image "normals"'):
        renderer.image("normals")
