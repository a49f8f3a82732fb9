"""A search of planes keeps, and reads back, no more of its fine histogram than it looks at."""

import numpy as np
import numpy.typing as npt
import pytest

import pyopacity as po
from scenes import random_shapes, tangle

pytestmark = pytest.mark.gl

MAPS = "bounding_opacity_maps"
HISTOGRAM = f"{MAPS}/histogram"
BLOCK = 4  # texels to a side
CELL_BYTES = 64 * 4
LIGHTS = {
    "directional": po.DirectionalLight((0.5, 0.3, -0.8)),
    "point inside": po.PointLight((0.1, 0.2, 0.3)),
}


def every_kind(light: po.Light) -> po.Scene:
    points, offsets = tangle(3, strands=400, points=9, step=0.4)
    return po.Scene(po.Strands(points, offsets, width=0.1, opacity=0.3), *random_shapes(5), light)


class Searched:
    def __init__(self, scene: po.Scene, map_size: int, **parameters: object) -> None:
        technique = po.technique(MAPS, **parameters)
        with po.Renderer(scene, technique=technique, map_size=map_size, size=(8, 8)) as renderer:
            renderer.transmittance(np.zeros((1, 3), np.float32))
            self.memory = {row.name: row.bytes for row in renderer.memory()}
            self.notes = {row.name: row.note for row in renderer.report}
            self.textures = {
                name: renderer.read(name)
                for name in self.memory
                if name.startswith((HISTOGRAM, f"{MAPS}/sampled")) and "/carries" not in name
            }
            # One map, or the faces of a cube in three columns.
            self.stride = max(1, renderer.read(f"{MAPS}/start").shape[1] // 128)


def blocks(whole: npt.NDArray[np.float32], stride: int) -> npt.NDArray[np.float32]:
    """One block in every `stride`, both ways, side by side."""
    down, across = (
        np.flatnonzero(np.arange(side) // BLOCK % stride == 0) for side in whole.shape[1:3]
    )
    return whole[:, down][:, :, across]


@pytest.mark.parametrize(("light", "map_size"), [("directional", 290), ("point inside", 90)])
def test_a_scattered_histogram_has_the_bits_of_its_blocks_in_a_whole_one(light, map_size):
    scene = every_kind(LIGHTS[light])
    found = Searched(scene, map_size, deposit="scatter")
    whole = Searched(scene, map_size, deposit="scatter", split="per_texel").textures[HISTOGRAM]
    packed = found.textures[HISTOGRAM]
    assert found.stride > 1
    assert np.array_equal(packed, blocks(whole, found.stride))
    assert (packed[-1, ..., -1] > 0).mean() > 0.05


def test_a_blended_histogram_is_copied_and_finds_the_same_ratio():
    scene = every_kind(LIGHTS["directional"])
    blended = Searched(scene, 290, deposit="blend")
    assert np.array_equal(
        blended.textures[f"{MAPS}/sampled_histogram"], blocks(blended.textures[HISTOGRAM], 2)
    )
    scattered = Searched(scene, 290, deposit="scatter")
    search = f"{MAPS}/split_search"
    assert scattered.notes[search] == blended.notes[search]


def test_memory_is_that_of_what_is_looked_at():
    memory = Searched(every_kind(LIGHTS["directional"]), 256, deposit="scatter").memory
    texels = 128**2
    assert memory[HISTOGRAM] == texels * CELL_BYTES
    assert memory[f"{MAPS}/sampled_start"] == texels * 4
    assert f"{MAPS}/sampled_histogram" not in memory


@pytest.mark.parametrize("deposit", ["blend", "scatter"])
def test_small_maps_are_read_where_they_lie(deposit):
    found = Searched(every_kind(LIGHTS["directional"]), 128, deposit=deposit)
    assert not [name for name in found.memory if "sampled" in name]
    assert found.notes[f"{MAPS}/split_search"].startswith("split ratio")
