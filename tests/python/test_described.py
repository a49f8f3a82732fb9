"""Descriptions of techniques that are refused: the error names the field, the registry stays."""

from dataclasses import replace
from typing import Any

import pytest

import pyopacity as po

SHADER = """
#ifdef PASS_total
#endif
float texel_optical_depth(ivec2 texel, float depth, OwnDeposit own) { return 0.0; }
#include "lib/lookup.glsl"
"""
START, TOTAL = po.Texture("start", "depth32f"), po.Texture("total")
FIRST = po.CasterPass("first", ["start"], fragment="bounds.frag.glsl", depth="less")
SUM = po.CasterPass("total", ["total"], blend="add")
STRENGTH = po.Param("strength", 1.0, (0.0, 4.0), "A factor.")
RIGHT: dict[str, Any] = {
    "summary": "A sum.",
    "paper": "none",
    "shader": SHADER,
    "parameters": [STRENGTH],
    "textures": [START, TOTAL],
    "passes": [FIRST, SUM],
    "look_up": ["start", "total", "strength"],
}


def drawn(writes: list[str], **options: Any) -> dict[str, Any]:
    """With the pass over casters in place of the sum."""
    return {"passes": [FIRST, po.CasterPass("total", writes, **options)]}


def stored(writes: list[str], *reads: str) -> dict[str, Any]:
    return {"passes": [FIRST, po.TexelPass("total", writes, reads)]}


def with_param(**changes: Any) -> dict[str, Any]:
    fields = {"name": "p", "default": 1.0, "range": (0.0, 4.0), "doc": "A factor."}
    return {"parameters": [STRENGTH, po.Param(**{**fields, **changes})]}


def with_texture(name: str, *fields: Any) -> dict[str, Any]:
    return {"textures": [START, TOTAL, po.Texture(name, *fields)]}


WRONG: list[tuple[dict[str, Any], str]] = [
    # the whole
    ({"summary": ""}, "no summary"),
    ({"paper": ""}, "no paper"),
    ({"summary": None}, "summary is None"),
    ({"shader": 3}, "shader is an int"),
    ({"shader": "\ud800"}, "shader is no Unicode text"),
    ({"shader": ""}, 'shader has nothing for pass "total"'),
    ({"shader": "#ifdef PASS_total\n#endif"}, "shader has no look-up"),
    ({"own_correction": 1}, "own_correction is an int"),
    # look_up
    ({"look_up": ["strat"]}, 'did you mean "start"'),
    ({"look_up": ["bias_"]}, 'look_up reads "bias_"'),
    ({"look_up": "start"}, "look_up is a str"),
    ({"look_up": [3]}, "one of look_up is an int"),
    # parameters
    (with_param(name="strength"), '"strength" is there twice'),
    (with_param(name="bias"), "every technique has it"),
    (with_param(name="Big"), "no name for GLSL"),
    (with_param(doc=""), "no doc"),
    (with_param(range=(2.0, 4.0)), 'parameter "p" = 1'),
    (with_param(range=(4.0, 0.0)), "range 4..0"),
    (with_param(range=(0.0, float("inf"))), "finite ends"),
    (with_param(range=(float("nan"), 1.0)), "finite ends"),
    (with_param(default=float("nan")), "a default between"),
    (with_param(default=1, range=(0.5, 2)), "whole ones"),
    (with_param(default=1, range=(0, 1e12)), "whole ones"),
    (with_param(default=10**30, range=(0, 1)), 'parameter "p"'),
    ({"parameters": [po.Choice("c", [], "None.")]}, "the choices nothing"),
    ({"parameters": [po.Choice("c", ["a", "a"], "Two.")]}, "all different"),
    ({"parameters": [STRENGTH, "strength"]}, "parameters[1] is a str"),
    ({"parameters": 3}, "parameters is an int"),
    # textures
    (with_texture("total"), '"total" is there twice'),
    (with_texture("opaque_depth"), "the engine's own"),
    (with_texture("t 1"), "no name for GLSL"),
    (with_texture("x", "rgba33f"), 'format = "rgba33f" does not exist'),
    (with_texture("x", "rgba33f"), 'did you mean "rgba32f"'),
    (with_texture("x", "rgba32f", -1), "-1 layers"),
    (with_texture("x", "rgba32f", 65), "65 layers"),
    (with_texture("x", "depth32f", 2), "a depth32f of layers"),
    (with_texture("x"), 'texture "x" is written by no pass'),
    # passes
    ({"passes": [FIRST, SUM, SUM]}, '"total" is there twice'),
    (drawn(["total"], reads=["total"]), "no pass before it writes"),
    (drawn(["total"], reads=["totle"]), 'did you mean "total"'),
    (drawn([]), "writes nothing"),
    (drawn(["totle"]), 'writes "totle", which is no texture'),
    (drawn(["total", "total"]), "one writer a texture"),
    (drawn(["start"]), "one writer a texture"),
    (drawn(["total"], blend="sum"), 'blend = "sum" does not exist'),
    (drawn(["total"], depth="lesser"), 'did you mean "less"'),
    (drawn(["total"], depth="less"), "goes with one depth32f texture"),
    ({"passes": [po.CasterPass("first", ["start"], fragment="x.glsl")]}, "goes with one depth32f"),
    ({"textures": [START, po.Texture("total", "r32ui")]}, "whose format is r32ui"),
    ({"textures": [START, po.Texture("total", "r32f", 9)]}, "9 layers of others"),
    ({"passes": [po.TexelPass("total", ["start"])]}, 'stores into "start"'),
    (stored(["total"], "totle"), 'did you mean "total"'),
    ({"passes": ["first"]}, "passes[0] is a str"),
]


@pytest.mark.parametrize(("changes", "named"), WRONG, ids=lambda value: str(value)[:40])
def test_a_wrong_description_is_refused(changes: dict[str, Any], named: str) -> None:
    before = list(po.techniques())
    with pytest.raises(po.ParameterError) as error:
        po.register_technique("mine", **{**RIGHT, **changes})
    assert named in str(error.value)
    assert error.value.what and error.value.fix
    assert list(po.techniques()) == before


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        (
            {"shader": SHADER.replace("lookup", "look_up")},
            'techniques/mine.glsl:5: there is no shader "lib/look_up.glsl"',
        ),
        (
            {"passes": [replace(FIRST, fragment="bound.frag.glsl"), SUM]},
            'there is no shader "bound.frag.glsl"',
        ),
    ],
)
def test_a_file_that_the_engine_does_not_have_is_refused(
    changes: dict[str, Any], named: str
) -> None:
    before = list(po.techniques())
    with pytest.raises(po.ShaderError) as error:
        po.register_technique("mine", **{**RIGHT, **changes})
    assert named in error.value.what and "did you mean" in error.value.fix
    assert list(po.techniques()) == before


@pytest.mark.parametrize(
    ("name", "named"),
    [
        ("exact", "the engine's own"),
        ("Mine", "no name for a technique"),
        ("../mine", "no name for a technique"),
        ("", "no name for a technique"),
        (None, "name is None"),
    ],
)
def test_a_wrong_name_is_refused(name: Any, named: str) -> None:
    with pytest.raises(po.ParameterError, match=named):
        po.register_technique(name, **RIGHT)


@pytest.mark.parametrize(
    "make",
    [
        lambda: po.Texture(3),  # type: ignore[arg-type]
        lambda: po.Texture("x", None),  # type: ignore[arg-type]
        lambda: po.Texture("x", layers=1.5),  # type: ignore[arg-type]
        lambda: po.Texture("x", layer=1),  # type: ignore[call-arg]
        lambda: po.CasterPass("p", "total"),
        lambda: po.CasterPass("p", ["total"], optical_depth=1),  # type: ignore[arg-type]
        lambda: po.CasterPass("p", ["total"], fragment=None),  # type: ignore[arg-type]
        lambda: po.TexelPass("p", [None]),  # type: ignore[list-item]
        lambda: po.Param("p", "word"),  # type: ignore[arg-type]
        lambda: po.Param("p", None),  # type: ignore[arg-type]
        lambda: po.Param("p", 1.0, 4.0),  # type: ignore[arg-type]
        lambda: po.Choice("p", "word"),
    ],
)
def test_a_field_of_another_type_is_refused_where_it_is_written(make: Any) -> None:
    with pytest.raises(po.ParameterError):
        make()


def test_descriptions_are_values() -> None:
    assert po.Texture("x") == po.Texture("x", "rgba32f", 0)
    assert "rgba32f" in repr(TOTAL)
    assert po.CasterPass("p", ["a"]).writes == ("a",)
    with pytest.raises(AttributeError):
        TOTAL.format = "r32f"  # type: ignore[misc]
