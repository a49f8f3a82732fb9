"""The registry: what it tells of every technique and parameter, and what it refuses."""

from typing import Any

import pytest

import pyopacity as po

NAMES = list(po.techniques())


def test_the_promised_names_are_there() -> None:
    assert {"bounding_opacity_maps", "exact", "unshadowed"} <= set(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_everything_is_told(name: str) -> None:
    info = po.techniques()[name]
    assert info.name == name and info.summary and info.paper
    for parameter in info.parameters:
        assert parameter.name and parameter.type and parameter.range and parameter.doc
        assert parameter.default is not None


@pytest.mark.parametrize("name", NAMES)
def test_parameters_are_attributes_with_their_defaults(name: str) -> None:
    technique = po.technique(name)
    for parameter in technique.parameters:
        assert getattr(technique, parameter.name) == parameter.default
        setattr(technique, parameter.name, parameter.default)
        assert parameter.name in dir(technique)
        documentation = getattr(type(technique), parameter.name).__doc__
        assert parameter.doc in documentation and parameter.range in documentation
        assert parameter.name in (type(technique).__doc__ or "")


def test_values_are_taken_and_kept() -> None:
    technique = po.technique("bounding_opacity_maps", layers=8, split="hybrid", split_ratio=0.25)
    assert (technique.layers, technique.split, technique.split_ratio) == (8, "hybrid", 0.25)
    technique.layers, technique.bias = 4, 0.5
    assert (technique.layers, technique.bias) == (4, 0.5)
    technique.bias = "auto"
    assert technique.bias == "auto"
    assert "layers=4" in repr(technique)


@pytest.mark.parametrize(
    ("parameters", "named"),
    [
        ({"layers": 0}, "layers = 0 is outside"),
        ({"layers": 4000}, "layers = 4000 is outside"),
        ({"layers": True}, "layers = true is not an int"),
        ({"layers": 10**30}, "layers"),
        ({"layers": 2.5}, "layers"),
        ({"layers": "many"}, "layers"),
        ({"layers": True}, "layers"),
        ({"layers": None}, "layers is None"),
        ({"layers": [4]}, "layers is a list"),
        ({"split": "linaer"}, "split"),
        ({"split": 3}, "split"),
        ({"split_ratio": float("nan")}, "split_ratio"),
        ({"bias": "none"}, "bias"),
        ({"bias": -1}, "bias"),
        ({"layesr": 8}, 'did you mean "layers"'),
    ],
)
def test_bad_parameters_are_refused_and_change_nothing(
    parameters: dict[str, Any], named: str
) -> None:
    with pytest.raises(po.ParameterError) as error:
        po.technique("bounding_opacity_maps", **parameters)
    assert named in str(error.value)

    technique = po.technique("bounding_opacity_maps")
    before = repr(technique)
    for name, value in parameters.items():
        with pytest.raises(po.ParameterError):
            setattr(technique, name, value)
    assert repr(technique) == before


def test_a_misspelt_technique_gets_the_nearest_name() -> None:
    with pytest.raises(po.ParameterError, match='did you mean "bounding_opacity_maps"'):
        po.technique("bounding_opacity_map")
    with pytest.raises(po.ParameterError, match="technique is a"):
        po.technique(3)  # type: ignore[arg-type]
