"""What has not changed does not run again, and skipping never shows in the picture."""

import random
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import pyopacity as po

pytestmark = pytest.mark.gl

MAPS = "bounding_opacity_maps"


def ran(renderer: po.Renderer) -> set[str]:
    return {row.name for row in renderer.report if row.status == "ran"}


def why(renderer: po.Renderer, name: str) -> tuple[str, str]:
    row = next(row for row in renderer.report if row.name == name)
    return row.status, row.why


def ran_after(renderer: po.Renderer, change: Callable[[], object]) -> set[str]:
    renderer.render()
    change()
    renderer.render()
    return ran(renderer)


def test_nothing_changed_runs_nothing(renderer: po.Renderer) -> None:
    assert ran_after(renderer, lambda: None) == set()
    assert {row.status for row in renderer.report} <= {"cached", "culled"}
    assert all(row.why for row in renderer.report)


def test_setting_what_is_there_already_runs_nothing(renderer: po.Renderer) -> None:
    def change() -> None:
        renderer.camera = po.Camera.fit(renderer.scene.shapes[:2])
        renderer.map_size, renderer.size = 64, (48, 32)
        renderer.scene.lights[0].color = (1, 1, 1)
        renderer.scene.shapes[0].transform = np.eye(4)
        renderer.technique.layers = 16

    assert ran_after(renderer, change) == set()


def test_a_question_asked_again_runs_nothing(renderer: po.Renderer) -> None:
    hair = renderer.scene.shapes[0]
    for where in (hair, hair.points * 0.9):
        first = renderer.transmittance(where)
        renderer.render()
        assert (renderer.transmittance(where) == first).all()
        assert ran(renderer) == set()
        renderer.invalidate()
        assert (renderer.transmittance(where) == first).all()


def test_the_camera_moves_lighting_alone(renderer: po.Renderer) -> None:
    def change() -> None:
        renderer.camera = po.Camera.look_at((2, -3, 1), (0, 0, 0.4))

    assert ran_after(renderer, change) == {"lighting"}
    assert "camera" in why(renderer, "lighting")[1]


@pytest.mark.parametrize(("name", "value"), [("color", (1, 0.5, 0.2)), ("intensity", 0.3)])
def test_the_lights_colour_moves_lighting_alone(
    renderer: po.Renderer, name: str, value: Any
) -> None:
    light = renderer.scene.lights[0]
    assert ran_after(renderer, lambda: setattr(light, name, value)) == {"lighting"}


@pytest.mark.parametrize(("name", "value"), [("ambient", 0.7), ("specular", 0), ("size", (40, 30))])
def test_the_picture_has_settings_of_its_own(renderer: po.Renderer, name: str, value: Any) -> None:
    assert ran_after(renderer, lambda: setattr(renderer, name, value)) == {"lighting"}


def test_a_shapes_colour_moves_lighting_alone(renderer: po.Renderer) -> None:
    hair = renderer.scene.shapes[0]
    assert ran_after(renderer, lambda: setattr(hair, "color", (1, 0, 0))) == {"lighting"}


def test_opacity_leaves_the_depth_bounds_alone(renderer: po.Renderer) -> None:
    hair = renderer.scene.shapes[0]
    again = ran_after(renderer, lambda: setattr(hair, "opacity", 0.6))
    assert {f"{MAPS}/opacity", "lighting"} <= again
    assert not again & {f"{MAPS}/bounds", "opaque_depth"}


def test_a_receiver_that_does_not_cast_leaves_the_maps_alone(renderer: po.Renderer) -> None:
    ground = renderer.scene.shapes[2]
    assert ran_after(renderer, lambda: setattr(ground, "opacity", 0.9)) <= {"lighting"}


def test_points_move_what_depends_on_them(renderer: po.Renderer) -> None:
    hair = renderer.scene.shapes[0]
    again = ran_after(renderer, lambda: setattr(hair, "points", hair.points * 0.99))
    assert {f"{MAPS}/bounds", f"{MAPS}/opacity", "lighting"} <= again


def test_layers_leave_the_depth_bounds_alone(renderer: po.Renderer) -> None:
    again = ran_after(renderer, lambda: setattr(renderer.technique, "layers", 4))
    assert {f"{MAPS}/opacity", "lighting"} <= again
    assert not again & {f"{MAPS}/bounds", "opaque_depth"}


def test_needs_recompute_searches_the_split_again(renderer: po.Renderer) -> None:
    again = ran_after(renderer, renderer.needs_recompute)
    assert f"{MAPS}/split_search" in again
    assert f"{MAPS}/opacity" not in again  # the same answer moves nothing


def test_invalidate_runs_everything_that_ran(renderer: po.Renderer) -> None:
    renderer.render()
    first = ran(renderer)
    renderer.invalidate()
    renderer.render()
    assert ran(renderer) == first


def test_a_question_about_light_draws_no_picture(renderer: po.Renderer) -> None:
    renderer.transmittance(np.zeros((4, 3)))
    assert why(renderer, "lighting")[0] == "culled"
    assert why(renderer, "transmittance")[0] == "ran"


def test_without_casters_passes_are_culled_and_say_why(
    sheet: Callable[..., po.Mesh], tuft: Callable[..., po.Strands], small: dict[str, Any]
) -> None:
    light = po.DirectionalLight()
    with po.Renderer(po.Scene(tuft(), light), **small) as hair_only:
        hair_only.render()
        status, reason = why(hair_only, "opaque_depth")
        assert status == "culled" and reason
    with po.Renderer(po.Scene(sheet(), light), **small) as opaque_only:
        opaque_only.render()
        for row in opaque_only.report:
            if row.name.startswith(MAPS):
                assert row.status != "ran" and row.why, row
        assert why(opaque_only, "opaque_depth")[0] == "ran"


def test_zero_opacity_casts_nothing(tuft: Callable[..., po.Strands], small: dict[str, Any]) -> None:
    hair = tuft()
    hair.opacity = 0.0
    with po.Renderer(po.Scene(hair, po.DirectionalLight()), **small) as renderer:
        renderer.render()
        assert not any(name.startswith(MAPS) for name in ran(renderer))


# ---- skipped equals forced, whatever happened before ----

Change = Callable[[random.Random, po.Renderer], object]


def change_points(r: random.Random, renderer: po.Renderer) -> None:
    hair = renderer.scene.shapes[0]
    hair.points = hair.points + r.uniform(-0.05, 0.05)


def change_transform(r: random.Random, renderer: po.Renderer) -> None:
    matrix = np.eye(4)
    matrix[:3, 3] = r.uniform(-0.3, 0.3), r.uniform(-0.3, 0.3), 0.0
    r.choice(renderer.scene.shapes).transform = matrix


def change_light(r: random.Random, renderer: po.Renderer) -> None:
    light = renderer.scene.lights[0]
    light.direction = r.uniform(-1, 1), r.uniform(-1, 1), -1.0
    light.intensity = r.uniform(0.2, 2.0)


def change_camera(r: random.Random, renderer: po.Renderer) -> None:
    renderer.camera = po.Camera.look_at((r.uniform(-3, 3), -4, r.uniform(0.5, 3)), (0, 0, 0.5))


def change_shape(r: random.Random, renderer: po.Renderer) -> None:
    shape = r.choice(renderer.scene.shapes)
    name = r.choice(["opacity", "color", "casts", "receives"])
    values = {
        "opacity": r.choice([0.0, 0.3, 0.8, 1.0]),
        "color": (r.random(), r.random(), r.random()),
        "casts": r.random() < 0.5,
        "receives": r.random() < 0.5,
    }
    setattr(shape, name, values[name])


def change_width(r: random.Random, renderer: po.Renderer) -> None:
    hair = renderer.scene.shapes[0]
    assert isinstance(hair, po.Strands)
    hair.width = r.choice([0.0, 0.02, 0.1])


def change_technique(r: random.Random, renderer: po.Renderer) -> None:
    renderer.technique = r.choice(list(po.techniques()))
    renderer.technique.bias = r.choice(["auto", 0.0, 0.1])
    if renderer.technique.name == MAPS:
        renderer.technique.layers = r.choice([1, 4, 7, 16, 40])
        renderer.technique.split = r.choice(["auto", "linear", "logarithmic", "hybrid"])


def change_settings(r: random.Random, renderer: po.Renderer) -> None:
    renderer.map_size = r.choice([16, 33, 64])
    renderer.size = r.choice([(48, 32), (31, 17)])
    renderer.antialiasing = r.choice([1, 2])
    renderer.compositing = r.choice(["auto", "opaque", "subsets", "sorted", "exact"])
    renderer.background = (r.random(), r.random(), r.random(), r.choice([0.0, 1.0]))


def ask_about_light(r: random.Random, renderer: po.Renderer) -> None:
    renderer.transmittance(np.full((2, 3), r.uniform(-5.0, 5.0)))


CHANGES: list[Change] = [
    change_points,
    change_transform,
    change_light,
    change_camera,
    change_shape,
    change_width,
    change_technique,
    change_settings,
    ask_about_light,
]


# The fixtures keep nothing between examples: each has a renderer of its own, to be repeated alone.
@settings(
    max_examples=8,
    derandomize=True,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(
    changes=st.lists(st.sampled_from(CHANGES), min_size=5, max_size=10),
    r=st.randoms(use_true_random=False),
)
def test_skipped_equals_forced(
    new_renderer: Callable[[], po.Renderer],
    same: Callable[..., bool],
    changes: list[Change],
    r: random.Random,
) -> None:
    with new_renderer() as renderer:
        for change in changes:
            change(r, renderer)
            skipped = renderer.render()
            renderer.invalidate()
            assert same(skipped, renderer.render()), change.__name__


def test_a_used_renderer_draws_what_a_new_one_does(
    renderer: po.Renderer, same: Callable[..., bool]
) -> None:
    r = random.Random(7)
    for change in CHANGES:
        change(r, renderer)
        renderer.steady = False  # a light that holds on to its map depends on the frames before
        used = renderer.render()
        names = ("size", "map_size", "antialiasing", "compositing", "steady")
        settings = {name: getattr(renderer, name) for name in names}
        with po.Renderer(
            renderer.scene,
            renderer.camera,
            technique=renderer.technique,
            background=renderer.background,
            **settings,
        ) as fresh:
            assert same(used, fresh.render()), change.__name__
