"""Chunks that a camera or a light cannot see are not drawn, and nothing is another bit for it."""

import re
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import pyopacity as po

MODES = ("opaque", "subsets", "sorted", "exact", "maps")
Floats = npt.NDArray[np.floating[Any]]


def head(segments: int = 20_000) -> po.Strands:
    shape = po.load(f"demo:hair?segments={segments}")[0]
    assert isinstance(shape, po.Strands)
    return shape


def lamps(middle: Floats, radius: float, random: np.random.Generator) -> list[po.Light]:
    """One of each kind: from above and inside, with all of the hair in its cone or a part."""
    aside, down = random.normal(size=3), random.normal(size=3)
    aside[2], down[2] = np.abs(aside).sum(), -np.abs(down).sum()
    outside = middle + 3.0 * radius * aside / np.linalg.norm(aside)
    inside = middle + random.normal(size=3) * 0.3 * radius
    return [
        po.DirectionalLight(down.tolist()),
        po.SpotLight(outside.tolist(), (middle - outside).tolist(), angle_deg=8.0),
        po.PointLight(outside.tolist()),
        po.PointLight(inside.tolist()),
    ]


def extent(shape: po.Shape) -> tuple[Floats, float]:
    """The middle of a shape's box, and how far its corners are from there."""
    low, high = np.array(shape.bounds.min), np.array(shape.bounds.max)
    return 0.5 * (low + high), 0.5 * float(np.linalg.norm(high - low))


def hidden(renderer: po.Renderer, name: str) -> tuple[int, int]:
    """How many chunks a pass left out, of how many; of the light's passes, not the camera's."""
    (row,) = [
        row
        for row in renderer.report
        if row.name.split("/")[-1] == name and not row.name.startswith("camera/")
    ]
    found = re.search(r"(\d+) of (\d+) chunks out of view", row.note)
    return (int(found[1]), int(found[2])) if found else (0, 0)


@pytest.mark.gl
@pytest.mark.parametrize("seed", range(10))
def test_pictures_are_those_of_all_chunks(seed: int) -> None:
    """Cameras around and within the hair, whose near plane cuts strands; every way of covering."""
    random = np.random.default_rng(seed)
    hair = head()
    middle, radius = extent(hair)
    light = lamps(middle, radius, random)[seed % 4]
    eye = middle + random.normal(size=3) * radius * (0.2 if seed % 2 else 1.0)
    camera = po.Camera.look_at(
        eye.tolist(),
        (middle + random.normal(size=3) * radius * 0.3).tolist(),
        fov_deg=(12, 50)[seed % 3 > 0],
    )
    pictures, shadows = [], []
    for culling in (True, False):
        with po.Renderer(
            po.Scene(hair, light),
            camera,
            (48, 36),
            map_size=96,
            compositing=MODES[seed % 5],
            culling=culling,
        ) as r:
            pictures.append(r.render())
            seen = [row for row in r.report if "chunks out of view" in row.note]
            shadows.append(r.transmittance(hair))
            shadows.append(r.image("depth"))
        is_within_or_narrow = seed % 2 == 1 or seed % 3 == 0
        assert bool(seen) == culling or not (culling and is_within_or_narrow)
    np.testing.assert_array_equal(pictures[0], pictures[1])
    np.testing.assert_array_equal(shadows[0], shadows[2])
    np.testing.assert_array_equal(shadows[1], shadows[3])
    assert pictures[0][..., 3].max() > 0.0


@pytest.mark.parametrize("device", [pytest.param("gpu", marks=pytest.mark.gl), "cpu"])
@pytest.mark.parametrize("kind", range(4))
def test_lights_leave_out_what_shadows_nothing(device: Any, kind: int) -> None:
    """The map is cut to what receives, here a small sheet amid the hair, or to a narrow cone."""
    random = np.random.default_rng(kind)
    hair = head()
    hair.receives = False
    middle, radius = extent(hair)
    light = lamps(middle, radius, random)[kind]
    corners = middle + 0.1 * radius * random.normal(size=(3, 3))
    sheet = po.Mesh(corners, np.array([[0, 1, 2]]))
    sheet.casts = False
    scene = po.Scene(hair, sheet, light)
    at = random.dirichlet((1.0, 1.0, 1.0), 500) @ corners
    found = []
    for culling in (True, False):
        with po.Renderer(scene, map_size=96, device=device, culling=culling, size=(8, 8)) as r:
            found.append(r.transmittance(at))
            count, chunks = hidden(r, "bounds")
        assert (count > 0) == culling or kind >= 2  # the map of a point light holds all that casts
        assert count <= chunks
    np.testing.assert_array_equal(found[0], found[1])
    assert found[0].min() < 1.0


@pytest.mark.gl
def test_a_tenth_of_the_hair_is_a_tenth_of_the_work() -> None:
    hair = head(150_000)
    middle, radius = extent(hair)
    eye = middle + (0.0, -6.0 * radius, 0.0)
    fov_deg = 4.0
    camera = po.Camera.look_at(eye.tolist(), middle.tolist(), fov_deg=fov_deg)
    steps = np.asarray(hair.points, np.float64) - eye
    reach = np.tan(np.radians(fov_deg / 2)) * steps[:, 1]
    part = np.mean((np.abs(steps[:, 0]) < reach) & (np.abs(steps[:, 2]) < reach))
    assert 0.05 < part < 0.15
    with po.Renderer(po.Scene(hair), camera, (32, 32), technique="unshadowed") as r:
        r.render()
        count, chunks = hidden(r, "translucent")
    assert chunks == -(-150_000 // 512)
    assert part - 0.02 < 1.0 - count / chunks < 3.0 * part


@pytest.mark.gl
def test_chunks_follow_points_that_move() -> None:
    """Boxes are made again, the order stays; an instance that moved none keeps its own."""
    hair = head()
    twin = hair.instance()
    camera = po.Camera.fit(po.Scene(hair))
    away = np.asarray(hair.points) + (1e4, 0.0, 0.0)
    with po.Renderer(po.Scene(hair), camera, (32, 24), map_size=64) as r:
        first = r.render()
        there = np.array(hair.points)
        hair.points = np.ascontiguousarray(away)
        assert r.render()[..., 3].max() == 0.0
        r.scene.add(twin)
        r.scene.remove(hair)
        np.testing.assert_allclose(r.render(), first, atol=1e-6)
        r.scene.add(hair)
        hair.points = there
        r.scene.remove(twin)
        np.testing.assert_array_equal(r.render(), first)


@pytest.mark.gl
def test_neighbours_are_in_one_chunk_whatever_their_order() -> None:
    """Strands stored in any order are as many chunks in view."""
    hair = head(60_000)
    offsets = np.asarray(hair.offsets)
    order = np.random.default_rng(1).permutation(len(offsets) - 1)
    picked = np.concatenate([np.arange(offsets[k], offsets[k + 1]) for k in order])
    lengths = np.diff(offsets)[order]
    mixed = po.Strands(
        np.ascontiguousarray(np.asarray(hair.points)[picked]),
        np.concatenate([[0], np.cumsum(lengths)]),
        width=0.04,
    )
    middle, _ = extent(hair)
    camera = po.Camera.look_at((middle + (0.0, -60.0, 0.0)).tolist(), middle.tolist(), fov_deg=6.0)
    counts = []
    for shape in (hair, mixed):
        with po.Renderer(po.Scene(shape), camera, (16, 16), technique="unshadowed") as r:
            r.render()
            counts.append(hidden(r, "translucent"))
    assert counts[0][1] == counts[1][1]
    assert abs(counts[0][0] - counts[1][0]) <= 3 < counts[0][0]
