"""What a frame does, counted: on any machine the same, so that no change costs more unseen.

Passes that ran, draw calls and dispatches, fragments that casters leave in a map, bytes that maps
hold, that passes write, and that Python allocates. Never a time: benchmarks measure those
(docs/performance.md).
Where a number here has to rise, the change that raises it says what for.
"""

from __future__ import annotations

import collections
import re
import tracemalloc
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pyopacity as po

MAPS = "bounding_opacity_maps"
TEXELS = 64 * 64
ANY_POINT = np.zeros((1, 3))
DOWN = (0.0, 0.0, -1.0)

# Of T at the tuft's points, beside the ball, from nothing: passes that run, and the draw calls and
# dispatches in them. A pass takes one; a search and a choice compute on the CPU and take none, and
# a sort takes one for each merge and one for the sums.
FROM_NOTHING = {
    "bounding_opacity_maps": (8, 7),
    "adaptive_opacity_maps": (9, 9),
    "auto": (8, 9),
    "deep_opacity_maps": (8, 7),
    "opacity_shadow_maps": (4, 4),
    "fourier_opacity_maps": (4, 4),
    "moment_opacity_maps": (4, 4),
    "density_clustering": (9, 9),
    "deep_shadow_maps": (10, 11),
    "exact": (7, 9),
    "shadow_map": (4, 4),
    "unshadowed": (2, 2),
}


def ran(renderer: po.Renderer) -> list[str]:
    return [row.name for row in renderer.report if row.status == "ran"]


def calls(renderer: po.Renderer) -> int:
    return sum(row.calls for row in renderer.report)


def held(renderer: po.Renderer) -> dict[str, int]:
    """Bytes by name."""
    return {row.name: row.bytes for row in renderer.memory()}


def written(renderer: po.Renderer) -> dict[str, int]:
    """Bytes of what passes that ran wrote, by name: all of an output, for each pass that writes."""
    did, bytes_of = ran(renderer), held(renderer)
    outputs = re.findall(r'"pass ([^"]+)" -> "([^"]+)"', renderer.graph_dot())
    times = collections.Counter(out for by, out in outputs if by in did and out in bytes_of)
    return {name: count * bytes_of[name] for name, count in times.items()}


# ---- passes, draw calls and dispatches ----


@pytest.mark.gl
def test_passes_and_calls_of_every_technique(scene: po.Scene, small: dict[str, Any]) -> None:
    found = {}
    for name in po.techniques():
        with po.Renderer(scene, technique=name, **small) as renderer:
            renderer.transmittance(scene.shapes[0])
            found[name] = len(ran(renderer)), calls(renderer)
    assert found == FROM_NOTHING


@pytest.mark.gl
@pytest.mark.parametrize(
    ("look_up", "along_strands"),
    [("per_sample", {}), ("along_strands", {"solid/strand_shadows": 1})],
)
def test_a_picture_draws_each_shape_once(
    renderer: po.Renderer, look_up: str, along_strands: dict[str, int]
) -> None:
    """In each pass that draws it: three shapes, of which two cast, and one of these is solid."""
    renderer.technique.split = "hybrid"
    renderer.strand_look_up = look_up
    renderer.render()
    by_pass = {row.name: row.calls for row in renderer.report if row.status == "ran"}
    assert by_pass == {
        "opaque_depth": 1,
        f"{MAPS}/bounds": 1,
        f"{MAPS}/opacity": 1,
        **along_strands,
        "lighting": 3,
    }


@pytest.mark.gl
def test_nothing_changed_calls_nothing(renderer: po.Renderer) -> None:
    renderer.render()
    assert calls(renderer) > 0
    renderer.render()
    assert (ran(renderer), calls(renderer)) == ([], 0)
    assert {row.status for row in renderer.report} <= {"cached", "culled"}


@pytest.mark.gl
@pytest.mark.parametrize(
    "change",
    [
        lambda r: setattr(r, "camera", po.Camera.look_at((2, -3, 1), (0, 0, 0.4))),
        lambda r: setattr(r.scene.lights[0], "color", (1.0, 0.5, 0.2)),
        lambda r: setattr(r.scene.shapes[0], "color", (1.0, 0.0, 0.0)),
    ],
    ids=["camera", "light colour", "shape colour"],
)
def test_what_moves_no_shadow_shades_alone(
    renderer: po.Renderer, change: Callable[[po.Renderer], object]
) -> None:
    renderer.render()
    change(renderer)
    renderer.render()
    assert (ran(renderer), calls(renderer)) == (["lighting"], 3)


@pytest.mark.gl
@pytest.mark.parametrize("name", ["exact", *[n for n in FROM_NOTHING if n.endswith("maps")]])
def test_more_strands_take_no_more_calls(
    name: str, tuft: Callable[..., po.Strands], small: dict[str, Any]
) -> None:
    """But for the merges of a sort: one more where the longest list doubles."""
    found = []
    for strands in (40, 80):
        scene = po.Scene(tuft(strands=strands), po.DirectionalLight(DOWN))
        with po.Renderer(scene, technique=name, **small) as renderer:
            renderer.transmittance(ANY_POINT)
            found.append((ran(renderer), calls(renderer)))
    (few_passes, few), (many_passes, many) = found
    assert few_passes == many_passes and few <= many <= few + 1


@pytest.mark.gl
def test_a_second_light_takes_as_many_calls_as_the_first(
    renderer: po.Renderer, small: dict[str, Any]
) -> None:
    def of_maps(light: int) -> int:
        renderer.invalidate()
        renderer.transmittance(ANY_POINT, light)
        return calls(renderer)

    alone = of_maps(0)
    renderer.scene.add(po.DirectionalLight((0.4, 0.2, -0.8)))
    assert [of_maps(0), of_maps(1)] == [alone, alone]


def test_without_opengl_there_are_no_calls(scene: po.Scene) -> None:
    with po.Renderer(scene, device="cpu", map_size=64) as renderer:
        renderer.transmittance(ANY_POINT)
        assert len(ran(renderer)) > 4 and calls(renderer) == 0


# ---- fragments ----


def fragments(scene: po.Scene, **settings: Any) -> np.ndarray:
    """How many each texel of a map of 64 x 64 has, as `exact` counts them."""
    with po.Renderer(scene, technique="exact", map_size=64, **settings) as renderer:
        renderer.transmittance(ANY_POINT)
        return renderer.read("exact/count")


@pytest.mark.parametrize("device", ["cpu", pytest.param("gpu", marks=pytest.mark.gl)])
def test_a_sheet_across_the_light_leaves_one_fragment_a_texel(
    device: str, sheet: Callable[..., po.Mesh]
) -> None:
    """The map fits the sheet, with a border of one texel about it."""
    scene = po.Scene(sheet(opacity=0.5), po.DirectionalLight(DOWN))
    counts = fragments(scene, device=device)
    assert counts.max() == 1 and counts.sum() == 62 * 62
    scene.add(sheet(height=0.5, opacity=0.5))
    assert fragments(scene, device=device).sum() == 2 * 62 * 62


@pytest.mark.parametrize("device", ["cpu", pytest.param("gpu", marks=pytest.mark.gl)])
def test_strands_along_the_rows_leave_at_most_two_rows_of_fragments_each(device: str) -> None:
    """Narrower than a texel each touches the rows on both sides of its axis, no more."""
    along = np.linspace(-1.0, 1.0, 9)
    points = np.array([(x, y, 0.0) for x in (-1.0, 0.013, 1.0) for y in along])  # a row is along y
    hair = po.Strands(points, np.arange(0, 28, 9), width=1e-3, opacity=0.5)
    counts = fragments(po.Scene(hair, po.DirectionalLight(DOWN)), device=device)
    rows = np.flatnonzero(counts.sum(axis=1))
    assert 3 <= len(rows) <= 6
    assert 3 * 62 <= counts.sum() <= 3 * 2 * (62 + 8)  # at a joint both segments count


def test_hair_leaves_no_more_fragments_than_it_did() -> None:
    """On the CPU, where no driver decides which texels a segment touches: 5,284, 2.6 a segment."""
    hair = po.load("demo:hair?segments=2000")[0]
    counts = fragments(po.Scene(hair, po.DirectionalLight((0.5, 0.3, -0.8))), device="cpu")
    assert counts.sum() == pytest.approx(5284, rel=0.002)


# ---- bytes ----


@pytest.mark.gl
@pytest.mark.parametrize("layers", [4, 16, 32])
def test_layers_are_four_bytes_each(layers: int, scene: po.Scene, small: dict[str, Any]) -> None:
    linear = po.technique(
        MAPS, layers=layers, split="hybrid", interpolation="linear", deposit="blend"
    )
    with po.Renderer(scene, technique=linear, **small) as renderer:
        renderer.transmittance(ANY_POINT)
        bytes_of = held(renderer)
        assert written(renderer) == bytes_of
        scene.shapes[0].opacity = 0.1
        renderer.transmittance(ANY_POINT)
        once_more = written(renderer)
    assert bytes_of.pop(f"{MAPS}/opacity") == 4 * layers * TEXELS
    depths = (f"{MAPS}/start", f"{MAPS}/end", "opaque_depth", "opaque_moved")
    assert [bytes_of.pop(name) for name in depths] == [4 * TEXELS] * 4
    assert set(bytes_of) == {"query", "transmittance"}  # what is asked, and the answer
    # Another opacity moves no bound.
    assert once_more == {f"{MAPS}/opacity": 4 * layers * TEXELS, **bytes_of}


@pytest.mark.parametrize("device", ["cpu", pytest.param("gpu", marks=pytest.mark.gl)])
def test_lists_hold_sixteen_bytes_a_fragment(device: str, sheet: Callable[..., po.Mesh]) -> None:
    shapes = [sheet(height=0.1 * i, opacity=0.5) for i in range(8)]
    scene = po.Scene(shapes, po.DirectionalLight(DOWN))
    with po.Renderer(scene, technique="exact", map_size=64, device=device) as renderer:
        renderer.transmittance(ANY_POINT)
        entries, room = renderer.read("exact/count").sum(), held(renderer)["exact/list"]
    assert entries == 8 * 62 * 62
    assert 16 * entries <= room <= 1.1 * 16 * entries  # whole rows


@pytest.mark.gl
def test_a_camera_that_moves_writes_the_picture_alone(renderer: po.Renderer) -> None:
    renderer.render()
    everything = written(renderer)
    assert f"{MAPS}/opacity" in everything
    renderer.camera = po.Camera.look_at((2, -3, 1), (0, 0, 0.4))
    renderer.render()
    pixels, least, most = 48 * 32, 4, 4 * 4 + 4  # one to four channels and a depth, of 4 bytes
    again = written(renderer)
    assert not [name for name in again if name.startswith((MAPS, "opaque_"))]
    assert least * pixels <= sum(again.values()) <= most * pixels


@pytest.mark.parametrize("device", ["cpu", pytest.param("gpu", marks=pytest.mark.gl)])
def test_a_cached_map_writes_nothing(device: str, scene: po.Scene) -> None:
    """The map of a question is that of the next one: same bits, and the answer alone is written."""
    with po.Renderer(scene, device=device, map_size=64, technique="exact") as renderer:
        renderer.transmittance(ANY_POINT)
        assert sum(written(renderer).values()) > 16 * TEXELS
        renderer.transmittance(np.ones((1, 3)))
        assert ran(renderer) == ["transmittance"]
        assert sum(written(renderer).values()) < 100


# ---- memory of Python ----


@pytest.mark.gl
def test_arrays_that_are_there_cost_no_others(renderer: po.Renderer) -> None:
    """A frame that moves, and T at moved points: next to nothing in Python, and nothing stays."""
    image = np.empty((32, 48, 4), np.float32)
    points = np.random.default_rng(0).uniform(-1, 1, (100_000, 3)).astype(np.float32)
    out = np.empty(len(points), np.float32)

    def frame(number: int) -> None:
        renderer.camera = po.Camera.look_at((2, -3, 1 + 0.01 * number), (0, 0, 0.4))
        renderer.render(out=image)
        points[:, 0] += 1e-3
        renderer.transmittance(points, out=out)

    frame(0)
    tracemalloc.start()
    try:
        frame(1)
        before, _ = tracemalloc.get_traced_memory()
        tracemalloc.reset_peak()
        frame(2)
        after, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak - before < 16_384  # a copy of the points would be 1.2 MB, of T 400 kB
    assert after - before < 4_096
