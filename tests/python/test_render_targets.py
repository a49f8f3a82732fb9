"""How many images a pass that blends draws into: the same T bit for bit, in more passes."""

import numpy as np
import pytest

import pyopacity as po
from layer_errors import hair

MAPS = "bounding_opacity_maps"
DEVICES = ["cpu", pytest.param("gpu", marks=pytest.mark.gl)]


def passes(renderer: po.Renderer, texture: str) -> int:
    names = [row.name.removeprefix(f"{MAPS}/") for row in renderer.report]
    return sum(name == texture or name.startswith(f"{texture}_") for name in names)


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("interpolation", ["linear", "mean_depth"])
def test_T_is_the_same_in_more_passes(device: str, interpolation: str) -> None:
    """18 layers are five images of four planes, and with mean depths ten; memory has no limit."""
    scene, strands = hair(2000)
    technique = po.technique(MAPS, layers=18, interpolation=interpolation, deposit="blend")
    expected = {0: 1, 8: 1, 4: 2, 2: 3, 1: 5}
    if interpolation == "mean_depth":
        expected = {0: 2, 8: 2, 4: 3, 2: 5, 1: 10}
    if device == "cpu":
        expected = dict.fromkeys(expected, 1)
    found = {}
    with po.Renderer(scene, technique=technique, device=device, map_size=64) as renderer:
        for targets, count in expected.items():
            technique.render_targets = targets
            found[targets] = renderer.transmittance(strands)
            assert passes(renderer, "opacity") + passes(renderer, "moments") == count
            assert passes(renderer, "histogram") == (1 if device == "cpu" else 16 // (targets or 8))
    for T in found.values():
        assert np.array_equal(T, found[0])


@pytest.mark.parametrize("device", DEVICES)
def test_splits_of_texels_are_the_same_in_more_passes(device: str) -> None:
    scene, strands = hair(2000)
    technique = po.technique(MAPS, layers=6, split="per_texel", deposit="blend")
    with po.Renderer(scene, technique=technique, device=device, map_size=32) as renderer:
        found = renderer.transmittance(strands)
        technique.render_targets = 1
        assert np.array_equal(renderer.transmittance(strands), found)


def test_only_what_hardware_had_is_a_number_of_targets() -> None:
    assert po.technique(MAPS).render_targets == 0
    for wrong in (-1, 3, 5, 16, "8", True):
        with pytest.raises(po.ParameterError, match="render_targets"):
            po.technique(MAPS, render_targets=wrong)
