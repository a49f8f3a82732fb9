"""What holds for every technique of the registry, beside what the stress suite asks of it."""

import numpy as np
import pytest

import pyopacity as po
from scenes import hair_over_ball

ALL = sorted(po.techniques())


def small(scene, technique, **options):
    return po.Renderer(
        scene, size=(48, 32), technique=technique, map_size=64, antialiasing=1, **options
    )


@pytest.mark.parametrize("name", ALL)
def test_both_ends_of_every_parameter_render(needs_gl, name):
    scene = hair_over_ball()
    for parameter in po.techniques()[name].parameters:
        for value in ends_of(parameter):
            with small(scene, po.technique(name, **{parameter.name: value})) as r:
                picture = r.render()
                assert np.isfinite(picture).all(), (parameter.name, value)


def ends_of(parameter):
    """The extremes that a parameter's range names."""
    if parameter.type == "bool":
        return [True, False]
    if parameter.type == "choice or list":
        return [word.strip('"') for word in parameter.range.split(", ")[:-1]]
    if parameter.type == "choice":
        return [choice.strip().strip('"') for choice in parameter.range.split(",")]
    convert = int if parameter.type == "int" else float
    if ", " in parameter.range:
        return [convert(choice) for choice in parameter.range.split(", ")]
    ends = [convert(float(end)) for end in parameter.range.replace('"auto" or ', "").split("..")]
    return [*ends, "auto"] if "auto" in parameter.range else ends
