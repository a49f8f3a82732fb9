"""The ways of drawing where casters begin and end: one picture, whichever."""

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt
import pytest

import pyopacity as po

MAPS = "bounding_opacity_maps"
DEVICES = ["cpu", pytest.param("gpu", marks=pytest.mark.gl)]
MIRRORED = ("swapped_planes", "depth_range")
PASSES = {
    "one_pass": ["bounds"],
    "depth_func": ["start_depth", "end_depth"],
    "swapped_planes": ["start_depth", "end_depth", "mirror"],
    "depth_range": ["start_depth", "end_depth", "mirror"],
}
Array = npt.NDArray[np.float32]


def every_kind() -> po.Scene:
    """Points in depth and intervals: strands and leaves, particles and a volume."""
    rng = np.random.default_rng(3)
    hair = po.load("demo:hair?segments=3000")
    leaves = rng.uniform(-1, 1, (60, 1, 3)) + rng.normal(0, 0.2, (60, 3, 3))
    mesh = po.Mesh(leaves.reshape(-1, 3), np.arange(180).reshape(-1, 3), opacity=0.5)
    particles = po.Particles(rng.uniform(-2, 2, (50, 3)), radius=0.2, opacity=0.4)
    voxels = po.Volume(rng.uniform(0, 2, (5, 6, 7)).astype(np.float32), (1, 1, 1), (0.2, 0.2, 0.2))
    return po.Scene(hair, mesh, particles, voxels, po.DirectionalLight((0.5, 0.3, -0.8)))


class Maps:
    """Start, end and T of one way."""

    def __init__(self, scene: po.Scene, device: str, bounds: str) -> None:
        technique = po.technique(MAPS, bounds=bounds)
        with po.Renderer(
            scene, technique=technique, device=device, map_size=96, size=(8, 8)
        ) as renderer:
            self.T = np.concatenate([renderer.transmittance(shape) for shape in scene.shapes])
            self.start = renderer.read(f"{MAPS}/start")
            self.end = renderer.read(f"{MAPS}/end")
            names = [row.name.removeprefix(f"{MAPS}/") for row in renderer.report]
        self.passes = names[names.index(PASSES[bounds][0]) : names.index("histogram")]


@pytest.fixture(scope="module", params=DEVICES)
def ways(request: pytest.FixtureRequest) -> Iterator[dict[str, Maps]]:
    if request.param == "gpu":
        request.getfixturevalue("needs_gl")
    scene = every_kind()
    yield {bounds: Maps(scene, request.param, bounds) for bounds in PASSES}


def test_each_way_takes_its_passes(ways: dict[str, Maps]) -> None:
    for bounds, maps in ways.items():
        assert maps.passes == PASSES[bounds]


def test_one_pass_gives_the_bits_of_two(ways: dict[str, Maps]) -> None:
    one, two = ways["one_pass"], ways["depth_func"]
    assert np.array_equal(one.start, two.start)
    assert np.array_equal(one.end, two.end)
    assert np.array_equal(one.T, two.T)
    assert (two.start < two.end).mean() > 0.1


def test_mirrored_depths_differ_by_their_rounding(ways: dict[str, Maps]) -> None:
    end, both = ways["depth_func"].end, [ways[bounds] for bounds in MIRRORED]
    assert np.array_equal(both[0].end, both[1].end)
    assert np.array_equal(both[0].T, both[1].T)
    assert np.array_equal(both[0].end, np.float32(1) - (np.float32(1) - end))
    assert np.abs(both[0].end.astype(float) - end).max() <= 2.0**-25
    difference = np.abs(both[0].T - ways["depth_func"].T)
    assert np.sqrt(np.mean(difference**2)) < 1e-4


def test_an_empty_texel_begins_at_1_and_ends_at_0(ways: dict[str, Maps]) -> None:
    for maps in ways.values():
        empty = maps.start == 1.0
        assert empty.any()
        assert not maps.end[empty].any()
