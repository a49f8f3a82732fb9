"""The plugin of docs/plugins.md, loaded from the file that $FIRST_HIT names."""

import os

import numpy as np
import pytest

import pyopacity as po
from conftest import sheet

PATH = os.environ["FIRST_HIT"]
BEFORE = list(po.techniques())
LOADED = po.load_plugin(PATH)

UPPER, LOWER = 0.3, 0.5  # optical depths
ABOVE, ON_THE_UPPER, BETWEEN, BELOW = ([0.1, 0.2, z] for z in (2.0, 1.0, 0.5, -1.0))
POINTS = np.array([ABOVE, ON_THE_UPPER, BETWEEN, BELOW])


def two_sheets() -> po.Scene:
    sheets = [sheet(z, opacity=float(-np.expm1(-t))) for z, t in ((1.0, UPPER), (0.0, LOWER))]
    return po.Scene(sheets, po.DirectionalLight((0, 0, -1)))


def renderer(**settings: object) -> po.Renderer:
    return po.Renderer(two_sheets(), size=(16, 12), map_size=32, antialiasing=1, **settings)


def test_it_joins_the_registry_once() -> None:
    assert LOADED == ("first_hit",)
    assert po.load_plugin(PATH) == LOADED
    assert list(po.techniques()) == [*BEFORE, "first_hit"]


@pytest.mark.parametrize("strength", [0.0, 1.0, 4.0])
def test_transmittance_is_that_of_the_texel_behind_its_first_caster(strength: float) -> None:
    behind = np.exp(-strength * (UPPER + LOWER))
    with renderer(technique=po.technique("first_hit", strength=strength)) as r:
        assert r.transmittance(POINTS) == pytest.approx([1.0, 1.0, behind, behind], abs=1e-6)


def test_its_parameter_has_type_range_and_doc() -> None:
    strength = po.techniques()["first_hit"].parameters[-1]
    assert (strength.name, strength.type, strength.range) == ("strength", "float", "0..4")
    assert strength.default == 1.0 and strength.doc.startswith("Factor")
    with pytest.raises(po.ParameterError, match=r"strength = 5 is outside 0\.\.4"):
        po.technique("first_hit", strength=5)
    with pytest.raises(po.ParameterError, match='did you mean "strength"'):
        po.technique("first_hit", strenght=1)


def test_its_passes_have_rows_and_run_only_when_they_must() -> None:
    def statuses(r: po.Renderer) -> dict[str, str]:
        r.transmittance(POINTS)
        rows = {row.name: row.status for row in r.report}
        return {name: rows[name] for name in ("first_hit/start_depth", "first_hit/total")}

    with renderer(technique="first_hit") as r:
        assert set(statuses(r).values()) == {"ran"}
        r.technique.strength = 2.0  # of the look-up alone
        assert set(statuses(r).values()) == {"cached"}
        r.scene.shapes[0].opacity = 0.1
        assert statuses(r) == {"first_hit/start_depth": "cached", "first_hit/total": "ran"}


def test_its_textures_can_be_read() -> None:
    with renderer(technique="first_hit") as r:
        r.transmittance(POINTS)
        total = r.read("first_hit/total")
    assert total[16, 16] == pytest.approx(UPPER + LOWER, abs=1e-6)


def test_a_light_takes_it() -> None:
    scene = two_sheets()
    scene.lights[0].technique = "first_hit"
    with po.Renderer(scene, size=(16, 12), map_size=32, technique="exact") as r:
        assert r.transmittance(POINTS)[2] == pytest.approx(np.exp(-UPPER - LOWER), abs=1e-6)


def test_on_the_cpu_it_says_that_it_has_no_such_form() -> None:
    with pytest.raises(po.ParameterError, match="runs on a GPU only") as error:
        po.transmittance(two_sheets(), POINTS, technique="first_hit")
    assert "first_hit/" in error.value.what and "another technique" in error.value.fix


def test_its_name_is_taken() -> None:
    with pytest.raises(po.ParameterError, match='"first_hit", registered by a plugin'):
        po.register_technique(
            "first_hit",
            summary="Another.",
            paper="none",
            shader="float shadow_transmittance(Receiver receiver) { return 1.0; }",
            passes=[],
            textures=[],
            look_up=[],
        )
