"""Generated scenes as Python sees them; their bits are held in tests/cpp/demo_scene_test.cpp."""

import inspect

import numpy as np
import pytest

import pyopacity as po

# What comes first in each, and what counts it.
SCENES = {
    "hair": (po.Strands, "segments"),
    "fur": (po.Strands, "segments"),
    "grass": (po.Strands, "segments"),
    "dense_grass": (po.Strands, "segments"),
    "tree": (po.Mesh, "leaves"),
    "sparse_tree": (po.Mesh, "leaves"),
    "smoke": (po.Volume, "voxels"),
    "clouds": (po.Volume, "voxels"),
    "plume": (po.Particles, "particles"),
    "teapot": (po.Strands, "segments"),
    "mixed": (po.Strands, "primitives"),
}


def load(name: str, count: int = 2000, more: str = "") -> list[po.Shape]:
    return po.load(f"demo:{name}?{SCENES[name][1]}={count}{more}")


def arrays(shape: po.Shape) -> list[np.ndarray]:
    """All numbers of a shape."""
    names = ("points", "opacity", "color", "width", "radius", "extinction", "uvs", "alpha_map")
    found = (getattr(shape, name, None) for name in names)
    return [np.asarray(value, np.float64) for value in found if value is not None]


@pytest.mark.parametrize("name", SCENES)
def test_every_scene_has_its_kind_first_and_a_ground_last(name: str) -> None:
    shapes = load(name)
    assert isinstance(shapes[0], SCENES[name][0])
    assert isinstance(shapes[-1], po.Mesh) and not shapes[-1].casts
    assert all(shape.casts for shape in shapes[:-1])
    assert all(np.all(np.isfinite(values)) for shape in shapes for values in arrays(shape))


@pytest.mark.parametrize("name", SCENES)
def test_a_seed_is_a_scene(name: str) -> None:
    first, same, other = (arrays(load(name, 500, f"&seed={seed}")[0]) for seed in (1, 1, 2))
    assert all(np.array_equal(a, b) for a, b in zip(first, same, strict=True))
    pairs = zip(first, other, strict=True)
    assert not all(a.shape == b.shape and np.array_equal(a, b) for a, b in pairs)


@pytest.mark.parametrize("name", SCENES)
def test_the_documentation_names_every_scene(name: str) -> None:
    documentation = inspect.getdoc(po.load) or ""
    assert f"``{name}``" in documentation
    assert f"``{SCENES[name][1]}``" in documentation


def test_leaves_are_cut_out_by_an_alpha_map() -> None:
    leaves = load("tree")[0]
    assert isinstance(leaves, po.Mesh)
    assert leaves.alpha_mode == "mask"
    assert 0.4 < np.mean(leaves.alpha_map >= leaves.alpha_cutoff) < 0.8
    assert leaves.uvs.min() == 0.0 and leaves.uvs.max() == 1.0


@pytest.mark.parametrize("name", ["smoke", "clouds"])
def test_most_of_a_volume_is_empty_and_its_middle_is_thick(name: str) -> None:
    volume = load(name, 50_000)[0]
    assert isinstance(volume, po.Volume)
    filled = np.mean(volume.extinction > 0.0)
    assert 0.02 < filled < 0.3
    depth = (volume.extinction.sum(axis=0) * volume.spacing[2]).max()
    assert 2.0 < depth < 30.0


@pytest.mark.parametrize("name", SCENES)
def test_what_a_scene_does_not_have_is_refused(name: str) -> None:
    for option in ("style=blue", "count=5", f"{SCENES[name][1]}=0", "seed=-1"):
        with pytest.raises(po.ParameterError):
            po.load(f"demo:{name}?{option}")
