"""Pictures and transmittance: what they mean, and what a renderer refuses."""

import threading
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pyopacity as po
from scenes import RINGING, TRANSLUCENT

pytestmark = pytest.mark.gl

DOWN = (0.0, 0.0, -1.0)


# ---- pictures ----


def test_a_picture_is_linear_rgba_from_the_top(renderer: po.Renderer) -> None:
    image = renderer.render()
    assert image.shape == (32, 48, 4) and image.dtype == np.float32
    assert image.flags.c_contiguous and np.isfinite(image).all()
    assert image[..., 3].min() >= 0.0 and image[..., 3].max() <= 1.0


def test_what_is_up_in_the_world_is_up_in_the_picture(
    sheet: Callable[..., po.Mesh], small: dict[str, Any]
) -> None:
    scene = po.Scene(sheet(half_size=0.5, height=1.0))
    camera = po.Camera.look_at(eye=(0, -6, -1.5), target=(0, 0, 0), fov_deg=50)
    with po.Renderer(scene, camera, **small) as renderer:
        alpha = renderer.render()[..., 3]
    assert alpha[:16].sum() > 0.0 and alpha[16:].sum() == 0.0


def test_render_fills_the_array_it_is_given(
    renderer: po.Renderer, same: Callable[..., bool]
) -> None:
    expected = renderer.render()
    image = np.full((32, 48, 4), np.nan, np.float32)
    assert renderer.render(out=image) is image
    assert same(image, expected)


def read_only_picture() -> Any:
    image = np.empty((32, 48, 4), np.float32)
    image.flags.writeable = False
    return image


@pytest.mark.parametrize(
    "out",
    [
        np.empty((32, 48, 4)),
        np.empty((48, 32, 4), np.float32),
        np.empty((32, 48, 3), np.float32),
        np.empty((32, 48, 8), np.float32)[..., ::2],
        np.empty((32, 48, 4), np.float16),
        read_only_picture(),
        [],
    ],
)
def test_other_arrays_are_refused(renderer: po.Renderer, out: Any) -> None:
    with pytest.raises(po.ParameterError, match="out is"):
        renderer.render(out=out)


def test_background_shows_where_nothing_is(small: dict[str, Any]) -> None:
    with po.Renderer(po.Scene(), background=(0.1, 0.2, 0.4), **small) as renderer:
        assert renderer.background == (0.1, 0.2, 0.4, 1.0)
        assert np.allclose(renderer.render(), (0.1, 0.2, 0.4, 1.0), atol=1e-6)
        renderer.background = (1.0, 1.0, 1.0, 0.0)
        assert np.array_equal(renderer.render(), np.zeros((32, 48, 4)))


def test_a_shadow_is_darker(
    sheet: Callable[..., po.Mesh], ball: Callable[..., po.Mesh], small: dict[str, Any]
) -> None:
    scene = po.Scene(sheet(), ball((0, 0, 1)), po.DirectionalLight(DOWN))
    camera = po.Camera.look_at(eye=(0, 0, -6), target=(0, 0, 0), up=(0, 1, 0))
    scene.shapes[0].opacity = 1.0
    above = po.Camera.look_at(eye=(3, 0, 4), target=(0, 0, 0))
    with po.Renderer(scene, camera, ambient=0.0, **small) as renderer:
        renderer.camera = above
        shadowed = renderer.render()
        renderer.technique = "unshadowed"
        lit = renderer.render()
    assert (shadowed[..., 0] <= lit[..., 0] + 1e-6).all()
    assert (shadowed[..., 0] < 0.5 * lit[..., 0]).sum() >= 4


# ---- transmittance ----


@pytest.mark.parametrize("technique", TRANSLUCENT)
@pytest.mark.parametrize("opacities", [(0.5,), (0.5, 0.2), (1.0,), (0.25, 1.0), (0.0,)])
def test_light_through_sheets_is_the_product(
    technique: str,
    opacities: tuple[float, ...],
    sheet: Callable[..., po.Mesh],
    small: dict[str, Any],
) -> None:
    sheets = [sheet(1.0 - i, opacity=opacity) for i, opacity in enumerate(opacities)]
    points = np.array([[0.1, 0.2, 2.0], [0.1, 0.2, -4.0], [9.0, 0.0, -4.0]])
    scene = po.Scene(sheets, po.DirectionalLight(DOWN))
    with po.Renderer(scene, technique=technique, **small) as renderer:
        light = renderer.transmittance(points)
    assert light.dtype == np.float32
    behind = np.prod([1.0 - opacity for opacity in opacities])
    assert light == pytest.approx([1.0, behind, 1.0], abs=1e-5)


@pytest.mark.parametrize("technique", list(po.techniques()))
def test_a_strand_does_not_shadow_itself(technique: str, small: dict[str, Any]) -> None:
    along = np.linspace(-1.0, 1.0, 9)
    points = np.stack([along, 0.5 * along, 0.3 * along], axis=1)
    hair = po.Strands(points, np.array([0, 9]), width=0.1, opacity=0.9)
    with po.Renderer(po.Scene(hair, po.DirectionalLight()), technique=technique, **small) as r:
        # A series spreads the next segments of the strand over depths before the receiver's.
        bound = 0.01 if technique in RINGING else 1e-6
        assert r.transmittance(hair) == pytest.approx(1.0, abs=bound)


@pytest.mark.parametrize("technique", list(po.techniques()))
def test_light_only_falls_along_its_way(
    technique: str, scene: po.Scene, small: dict[str, Any]
) -> None:
    way = np.linspace(-3.0, 3.0, 101)[:, None] * scene.lights[0].direction
    with po.Renderer(scene, technique=technique, **small) as renderer:
        light = renderer.transmittance(way + (0.0, 0.0, 0.5))
    assert light.min() >= 0.0 and light.max() <= 1.0
    assert technique in RINGING or (np.diff(light) <= 1e-6).all()


def test_of_a_shape_is_at_its_own_points_in_the_world(renderer: po.Renderer) -> None:
    hair = renderer.scene.shapes[0]
    turn = np.array([[0.0, -1, 0, 0.2], [1, 0, 0, 0], [0, 0, 1, 0.1], [0, 0, 0, 1]])
    hair.transform = turn
    world = hair.points @ turn[:3, :3].T + turn[:3, 3]
    renderer.technique.own_correction = False
    renderer.scene.shapes[
        1
    ].opacity = 0.6  # opaque, strands would see it where it is, and points moved back
    assert renderer.transmittance(hair) == pytest.approx(renderer.transmittance(world), abs=1e-6)


def test_float32_and_float64_points_agree(renderer: po.Renderer) -> None:
    points = np.random.default_rng(5).uniform(-1, 1, (200, 3))
    double = renderer.transmittance(points)
    assert renderer.transmittance(points.astype(np.float32)) == pytest.approx(double, abs=1e-3)


def test_no_points_no_light_no_shape(renderer: po.Renderer, small: dict[str, Any]) -> None:
    assert renderer.transmittance(np.empty((0, 3))).shape == (0,)
    points = np.zeros((3, 3), np.float32)
    with po.Renderer(po.Scene(renderer.scene.shapes), **small) as unlit:
        assert unlit.transmittance(points).tolist() == [1.0, 1.0, 1.0]
    with po.Renderer(po.Scene(po.DirectionalLight()), **small) as empty:
        assert empty.transmittance(points).tolist() == [1.0, 1.0, 1.0]


@pytest.mark.parametrize("light", [1, -1, 0.0, None, 2**40])
def test_a_light_that_is_not_there(renderer: po.Renderer, light: Any) -> None:
    with pytest.raises(po.ParameterError, match="light"):
        renderer.transmittance(np.zeros((1, 3)), light=light)


# ---- what was done ----


def test_the_report_is_data_and_a_table(renderer: po.Renderer) -> None:
    renderer.render()
    lighting = next(row for row in renderer.report if row.name == "lighting")
    assert lighting.status == "ran" and lighting.why and lighting.ms > 0.0
    lines = str(renderer.report).splitlines()
    assert len(lines) == len(renderer.report)
    assert all(row.name in line for row, line in zip(renderer.report, lines, strict=True))
    dot = renderer.graph_dot()
    assert dot.startswith("digraph") and '"image"' in dot


def test_memory_is_what_the_last_frame_needed(renderer: po.Renderer) -> None:
    renderer.technique = po.technique("opacity_shadow_maps", layers=8, accumulator="float16")
    renderer.transmittance(np.zeros((5, 3)))
    texels = int(renderer.map_size) ** 2
    held = {row.name: (row.bytes, row.texels) for row in renderer.memory()}
    assert held["opacity_shadow_maps/opacity"] == (8 * 2 * texels, texels)
    assert held["opaque_depth"] == (4 * texels, texels)
    assert held["transmittance"] == (5 * 4, 0)  # a float for each point
    assert "image" not in held
    renderer.render()
    assert "image" in {row.name for row in renderer.memory()}


def test_textures_are_read_by_name(renderer: po.Renderer) -> None:
    renderer.render()
    depth = renderer.read("opaque_depth")
    assert depth.shape == (64, 64) and 0.0 <= depth.min() < depth.max() <= 1.0
    assert renderer.read("image").shape == (32, 48, 4)
    layers = renderer.read("bounding_opacity_maps/opacity")
    assert layers.ndim == 4 and layers.shape[1:] == (64, 64, 4)
    with pytest.raises(po.ParameterError, match="no texture") as error:
        renderer.read("opacity")
    assert "bounding_opacity_maps/opacity" in error.value.fix


# ---- settings ----


def test_settings_are_attributes(renderer: po.Renderer) -> None:
    assert (renderer.map_size, renderer.antialiasing, renderer.size) == (64, 1, (48, 32))
    renderer.map_size, renderer.ambient, renderer.specular = 128, 0.5, 0
    renderer.shininess, renderer.antialiasing, renderer.size = 10, 2, (20, 10)
    assert (renderer.map_size, renderer.ambient, renderer.shininess) == (128, 0.5, 10.0)
    assert renderer.render().shape == (10, 20, 4)
    assert {"map_size", "antialiasing", "ambient", "specular", "shininess"} <= set(dir(renderer))


def test_technique_is_a_name_or_a_technique(renderer: po.Renderer) -> None:
    assert renderer.technique.name == "bounding_opacity_maps"
    renderer.technique = "exact"
    assert renderer.technique.name == "exact"
    eight = po.technique("bounding_opacity_maps", layers=8)
    renderer.technique = eight
    assert renderer.technique is eight
    renderer.technique.layers = 4
    renderer.render()
    assert renderer.read("bounding_opacity_maps/opacity").shape[0] == 1


@pytest.mark.parametrize(
    "settings",
    [
        {"scene": [1]},
        {"camera": (0, 0, 1)},
        {"technique": "exakt"},
        {"technique": 3},
        {"device": "tpu"},
        {"size": 100},
        {"size": (100,)},
        {"size": (10.5, 10)},
        {"background": (1, 1)},
        {"background": (1, 1, -1)},
        {"map_sise": 512},
        {"map_size": "big"},
    ],
)
def test_bad_arguments(scene: po.Scene, settings: dict[str, Any]) -> None:
    with pytest.raises(po.ParameterError):
        po.Renderer(**{"scene": scene, **settings})


# ---- life ----


def test_a_closed_renderer_says_so(scene: po.Scene, small: dict[str, Any]) -> None:
    with po.Renderer(scene, **small) as renderer:
        image = renderer.render()
        copy = image.copy()
    renderer.close()
    assert renderer.closed and np.array_equal(image, copy)
    for use in (
        renderer.render,
        renderer.invalidate,
        renderer.graph_dot,
        lambda: renderer.report,
        lambda: renderer.map_size,
        lambda: setattr(renderer, "size", (10, 10)),
        lambda: renderer.transmittance(np.zeros((1, 3))),
    ):
        with pytest.raises(po.ContextError, match="closed"):
            use()


def test_two_renderers_draw_one_scene(
    scene: po.Scene, small: dict[str, Any], same: Callable[..., bool]
) -> None:
    with po.Renderer(scene, **small) as one, po.Renderer(scene, **small) as two:
        assert same(one.render(), two.render())
        scene.shapes[0].opacity = 0.9
        assert same(one.render(), two.render())


def test_another_thread_gets_a_typed_error(renderer: po.Renderer) -> None:
    caught: list[BaseException] = []

    def use() -> None:
        try:
            renderer.render()
        except po.Error as error:
            caught.append(error)

    thread = threading.Thread(target=use)
    thread.start()
    thread.join()
    assert [type(error) for error in caught] == [po.ContextError]
    renderer.render()


def test_other_threads_run_while_one_renders(renderer: po.Renderer) -> None:
    renderer.antialiasing, renderer.size = 4, (800, 600)
    ticks: list[float] = []
    done = threading.Event()

    def tick() -> None:
        while not done.wait(0.001):
            ticks.append(time.perf_counter())

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.perf_counter()
    renderer.render()
    end = time.perf_counter()
    done.set()
    thread.join()
    assert len([t for t in ticks if start < t < end]) > 3


def test_shapes_may_change_on_another_thread_meanwhile(renderer: po.Renderer) -> None:
    hair = renderer.scene.shapes[0]
    done = threading.Event()

    def animate() -> None:
        points = hair.points
        while not done.is_set():
            hair.points = points + np.random.default_rng(1).normal(0.0, 0.01, points.shape)
            hair.opacity = 0.5

    thread = threading.Thread(target=animate)
    thread.start()
    try:
        for _ in range(5):
            assert np.isfinite(renderer.render()).all()
    finally:
        done.set()
        thread.join()


FORK = """
import os, sys
import numpy as np
import pyopacity as po
renderer = po.Renderer(po.Scene(), size=(8, 8))
renderer.render()
child = os.fork()
if child == 0:
    try:
        renderer.render()
    except po.ForkedContextError as error:
        os._exit(7 if "spawn" in error.fix else 8)
    os._exit(9)
_, status = os.waitpid(child, 0)
renderer.render()
sys.exit(os.waitstatus_to_exitcode(status))
"""


def test_a_forked_child_gets_a_typed_error(python: Callable[..., Any]) -> None:
    result = python("-W", "ignore", "-c", FORK)
    assert result.returncode == 7, result.stderr


LEFT_OPEN = """
import pyopacity as po
renderer = po.Renderer(po.Scene(po.load("demo:hair?segments=100"), po.DirectionalLight()),
                       size=(8, 8), map_size=16)
renderer.render()
po.kept = [renderer, renderer.context]
"""


def test_the_interpreter_ends_with_a_renderer_open(python: Callable[..., Any]) -> None:
    result = python("-c", LEFT_OPEN)
    assert (result.returncode, result.stderr) == (0, "")
