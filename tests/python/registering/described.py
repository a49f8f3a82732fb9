"""Techniques of Python and GLSL: equal to compiled ones, and replaced when registered again."""

import os
import random
from typing import Any

import numpy as np
import pytest

import guides
import pyopacity as po
from conftest import same, sheet, small_renderer, tuft_and_ball
from scenes import random_shapes
from test_skip import CHANGES, change_technique

po.load_plugin(os.environ["FIRST_HIT"])
guides.register_four_layers()

STRENGTH = po.Param("strength", 1.0, (0.0, 4.0), "Factor of the optical depth.")
FIRST_HIT: dict[str, Any] = {
    "summary": "One step at the first caster of each texel.",
    "paper": "none: the example of docs/add_a_technique.md",
    "shader": guides.first_hit_shader(),
    "parameters": [STRENGTH],
    "textures": [po.Texture("start", "depth32f"), po.Texture("total")],
    "passes": [
        po.CasterPass(
            "start_depth", ["start"], fragment="bounds.frag.glsl", optical_depth=False, depth="less"
        ),
        po.CasterPass("total", ["total"], blend="add"),
    ],
    "look_up": ["start", "total", "strength"],
}
po.register_technique("first_hit_described", **FIRST_HIT)

# The same once more, with the factor in a pass of its own over an array of two layers.
SCALED = {
    **FIRST_HIT,
    "textures": [*FIRST_HIT["textures"], po.Texture("scaled", "r32f", layers=2)],
    "passes": [*FIRST_HIT["passes"], po.TexelPass("scale", ["scaled"], ["total", "strength"])],
    "look_up": ["start", "scaled"],
    "shader": """
#if defined(PASS_total)
#include "lib/deposit.glsl"
layout(location = 0) out vec4 o_total;

void main() { o_total = vec4(deposit_or_discard().optical_depth); }

#elif defined(PASS_scale)
#include "lib/invocation.glsl"
uniform sampler2D t_total;
uniform float u_strength;
layout(r32f) writeonly uniform image2DArray i_scaled;

void main() {
    ivec3 size = imageSize(i_scaled);
    int index = int(invocation_index());
    if (index >= size.x * size.y * size.z) return;
    ivec3 texel = ivec3(index % size.x, index / size.x % size.y, index / (size.x * size.y));
    float total = texel.z == 1 ? texelFetch(t_total, texel.xy, 0).x : 1e6;
    imageStore(i_scaled, texel, vec4(u_strength * total));
}
#else
#include "lib/receiver.glsl"
uniform sampler2D t_start;
uniform sampler2DArray t_scaled;

float texel_optical_depth(ivec2 texel, float depth, OwnDeposit own) {
    if (!(depth > texelFetch(t_start, texel, 0).x)) return 0.0;
    return texelFetch(t_scaled, ivec3(texel, 1), 0).x;
}
#include "lib/lookup.glsl"
#endif
""",
}
po.register_technique("first_hit_scaled", **SCALED)


@pytest.mark.parametrize("strength", [1.0, 2.5])
@pytest.mark.parametrize("name", ["first_hit_described", "first_hit_scaled"])
@pytest.mark.parametrize(
    "light", [po.DirectionalLight((0.5, 0.3, -0.8)), po.PointLight((1.0, 0.5, 4.0))]
)
def test_it_equals_the_compiled_one_bit_for_bit(
    name: str, strength: float, light: po.Light
) -> None:
    scene = po.Scene(random_shapes(3), light)
    points = np.random.default_rng(5).uniform(-2, 2, (300, 3))
    results = []
    for technique in (name, "first_hit"):
        made = po.technique(technique, strength=strength)
        with po.Renderer(scene, size=(40, 30), map_size=48, technique=made) as r:
            results.append((r.transmittance(points), r.transmittance(scene.shapes[0]), r.render()))
    for described, compiled in zip(*results, strict=True):
        assert same(described, compiled)
    assert (results[0][0] < 1).any()


@pytest.mark.parametrize("between", ["linear", "steps"])
def test_four_layers_on_a_ladder_of_sheets(between: str) -> None:
    """Sheets at depths 0.5, 1.5 ... 7.5 in layers 2.2 deep, the first of which begins at 0.5."""
    depths, tau, layer = 0.5 + np.arange(8), 0.25, 2.2
    sheets = [sheet(-z, opacity=float(-np.expm1(-tau))) for z in depths]
    scene = po.Scene(sheets, po.DirectionalLight((0, 0, -1)))
    asked = np.array([0.0, 0.5, 1.3, 2.2, 3.9, 5.8, 7.0, 20.0])
    points = np.stack([np.full(8, 0.1), np.full(8, 0.2), -asked], 1)
    # In front of each layer's end; the last end holds all that is left.
    sums = [0.0, *((depths < 0.5 + k * layer).sum() * tau for k in (1, 2, 3)), 8 * tau]
    place = np.maximum(asked - 0.5, 0.0) / layer
    if between == "steps":
        place = np.ceil(place)
    expected = np.exp(-np.interp(place, range(5), sums))
    technique = po.technique("four_layers", depth=4 * layer, between=between, bias=0.0)
    with po.Renderer(scene, size=(16, 12), map_size=32, technique=technique) as r:
        assert r.transmittance(points) == pytest.approx(expected, abs=2e-5)


@pytest.mark.parametrize("name", ["four_layers", "first_hit_scaled"])
def test_skipped_equals_forced(name: str) -> None:
    r = random.Random(11)
    with small_renderer(tuft_and_ball()) as renderer:
        renderer.technique = name
        for change in [c for c in CHANGES if c is not change_technique] * 2:
            change(r, renderer)
            skipped = renderer.render()
            renderer.invalidate()
            assert same(skipped, renderer.render()), change.__name__


def test_its_report_and_textures_are_named_as_all_are() -> None:
    with small_renderer(tuft_and_ball()) as renderer:
        renderer.technique = "first_hit_scaled"
        renderer.render()
        ran = {row.name for row in renderer.report if row.status == "ran"}
        assert {f"first_hit_scaled/{name}" for name in ("start_depth", "total", "scale")} <= ran
        assert renderer.read("first_hit_scaled/scaled").shape[0] == 2
        renderer.technique.strength = 2.0
        renderer.render()
        rows = {row.name: (row.status, row.why) for row in renderer.report}
        assert rows["first_hit_scaled/total"][0] == "cached"
        assert rows["first_hit_scaled/scale"][0] == "ran"
        assert "strength" in rows["first_hit_scaled/scale"][1]


def test_on_the_cpu_it_says_that_it_has_no_such_form() -> None:
    with pytest.raises(po.ParameterError, match="runs on a GPU only"):
        po.transmittance(tuft_and_ball(), np.zeros((1, 3)), technique="four_layers")


# ---- registered again ----


def test_the_new_one_replaces_the_old() -> None:
    stronger = po.Param("factor", 2.0, (0.0, 9.0), "Of the optical depth.")
    with small_renderer(tuft_and_ball()) as renderer:
        po.register_technique("changing", **FIRST_HIT)
        renderer.technique = "changing"
        first = renderer.render()
        po.register_technique(
            "changing",
            **{
                **FIRST_HIT,
                "parameters": [stronger],
                "look_up": ["start", "total", "factor"],
                "shader": guides.first_hit_shader().replace("u_strength", "u_factor"),
            },
        )
        with pytest.raises(po.ParameterError, match="registered again") as error:
            renderer.render()
        assert 'pyopacity.technique("changing")' in error.value.fix
        renderer.technique = po.technique("changing")
        assert renderer.technique.factor == 2.0 and "strength" not in dir(renderer.technique)
        second = renderer.render()
        assert second[..., :3].sum() < first[..., :3].sum()
    assert list(po.techniques()).count("changing") == 1


def test_what_does_not_register_leaves_the_old_one() -> None:
    po.register_technique("lasting", **FIRST_HIT)
    with small_renderer(tuft_and_ball()) as renderer:
        renderer.technique = "lasting"
        with pytest.raises(po.ParameterError):
            po.register_technique("lasting", **{**FIRST_HIT, "look_up": ["strat"]})
        assert np.isfinite(renderer.render()).all()


# ---- what only the driver finds ----


@pytest.mark.parametrize(
    ("old", "new", "what"),
    [
        ("u_strength *", "u_strenght *", r"techniques/wrong\.glsl:\d+"),
        ("u_strength", "u_strong", "uses u_strong, which no declared read feeds"),
    ],
)
def test_a_wrong_shader_is_an_error_of_the_first_frame(old: str, new: str, what: str) -> None:
    shader = guides.first_hit_shader().replace(old, new)
    po.register_technique("wrong", **{**FIRST_HIT, "shader": shader})
    with small_renderer(tuft_and_ball()) as renderer:
        renderer.technique = "wrong"
        with pytest.raises(po.ShaderError, match=what) as error:
            renderer.render()
        assert error.value.fix
        renderer.technique = "first_hit_described"  # and nothing else is harmed
        assert np.isfinite(renderer.render()).all()
