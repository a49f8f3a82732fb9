"""Fewer, wider strands in maps: the same area, an error as told, and own deposits that fit."""

import re
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import pyopacity as po

Floats = npt.NDArray[np.floating[Any]]
DOWN = po.DirectionalLight((0.0, 0.0, -1.0))
DEVICES = ["cpu", pytest.param("gpu", marks=pytest.mark.gl)]
LAYERED = ("bounding_opacity_maps", "deep_opacity_maps", "opacity_shadow_maps")


def transmittance(scene: po.Scene, where: Any, technique: Any, **settings: Any) -> Floats:
    with po.Renderer(scene, size=(8, 8), technique=technique, **settings) as r:
        return r.transmittance(where)


def slab(strands: int, width: float, seed: int = 0, segments: int = 4) -> po.Strands:
    """Level strands in all directions through a unit square, and behind each other over 1."""
    random = np.random.default_rng(seed)
    middle = random.uniform(0.0, 1.0, (strands, 1, 3))
    angle = random.uniform(0.0, np.pi, strands)
    along = np.stack([np.cos(angle), np.sin(angle), np.zeros(strands)], axis=1)[:, None, :]
    steps = np.linspace(-0.2, 0.2, segments + 1)[None, :, None]
    points = (middle + steps * along).reshape(-1, 3)
    offsets = np.arange(0, len(points) + 1, segments + 1)
    return po.Strands(points, offsets, width=width, opacity=0.3)


def behind(count: int, seed: int = 1) -> Floats:
    """Places behind the slab, within it from aside."""
    at = np.random.default_rng(seed).uniform(0.2, 0.8, (count, 3))
    at[:, 2] = -0.5
    return at


def test_a_renderer_holds_all_strands_unless_told() -> None:
    with po.Renderer(po.Scene(slab(50, 0.01), DOWN), size=(8, 8), device="cpu") as r:
        assert r.map_detail == 1.0
        r.transmittance(behind(10))
        assert not [row for row in r.report if row.name == "map_detail"]
        r.map_detail = 0.25
        r.transmittance(behind(10))
        (row,) = [row for row in r.report if row.name == "map_detail"]
        assert row.note == "1 of 4 strands, 4 times as wide: as set"


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("detail", [0.6, 0.25, 0.1])
def test_area_stays(device: Any, detail: float) -> None:
    """What the strands take away in all, where each is far thinner than a texel."""
    scene = po.Scene(slab(4000, 0.0002), DOWN)
    side = (np.arange(64) + 0.5) / 64 * 2.0 - 0.5
    at = np.stack([*np.meshgrid(side, side), np.full((64, 64), -0.5)], axis=-1).reshape(-1, 3)
    taken = [
        -np.log(transmittance(scene, at, "exact", map_size=64, map_detail=d, device=device)).sum()
        for d in (1.0, detail)
    ]
    assert taken[1] == pytest.approx(taken[0], rel=0.03)


@pytest.mark.gl
@pytest.mark.parametrize("deposit", ["blend", "scatter"])
@pytest.mark.parametrize("light", ["directional", "spot"])
@pytest.mark.parametrize("technique", [*LAYERED, "adaptive_opacity_maps", "exact"])
def test_both_devices_keep_the_same_strands(technique: str, light: str, deposit: str) -> None:
    hair = po.load("demo:hair?segments=6000")[0]
    middle = np.mean([hair.bounds.min, hair.bounds.max], axis=0)
    lamp = (
        po.DirectionalLight((0.5, 0.3, -0.8))
        if light == "directional"
        else po.SpotLight((middle + (60.0, 0.0, 80.0)).tolist(), (-60.0, 0.0, -80.0), angle_deg=30)
    )
    made = po.technique(technique)
    if "deposit" in {parameter.name for parameter in made.parameters}:
        made.deposit = deposit
    elif deposit == "scatter":
        pytest.skip(f"{technique} has one way to deposit")
    scene = po.Scene(hair, lamp)
    found = [
        transmittance(scene, hair, made, map_size=96, map_detail=0.3, device=device)
        for device in ("cpu", "gpu")
    ]
    np.testing.assert_allclose(found[0], found[1], atol=1e-4)


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("technique", LAYERED)
@pytest.mark.parametrize("detail", [1.0, 0.25])
def test_own_deposits_are_those_of_the_map(device: Any, technique: str, detail: float) -> None:
    """Strands apart from each other, one behind each other's end, under a sheet that halves light.

    Kept ones have left more than they are wide, the others nothing; either way T is what the sheet
    lets through.
    """
    count = 16
    roots = np.stack(
        [np.zeros(count), 2.0 * np.arange(count), np.linspace(0.0, 0.3, count)], axis=1
    )
    points = (roots[:, None, :] + np.linspace(0, 5, 6)[None, :, None] * (1.0, 0.0, 0.0)).reshape(
        -1, 3
    )
    strands = po.Strands(points, np.arange(0, 6 * count + 1, 6), width=0.2, opacity=0.9)
    high = 4.0
    corners = np.array([[-2, -2, high], [8, -2, high], [8, 33, high], [-2, 33, high]])
    sheet = po.Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]), opacity=0.5)
    t = transmittance(
        po.Scene(strands, sheet, DOWN),
        strands,
        technique,
        map_size=128,
        map_detail=detail,
        device=device,
    )
    np.testing.assert_allclose(t, 0.5, atol=2e-3)


@pytest.mark.parametrize("texels", [32, 128])
@pytest.mark.parametrize("detail", [0.5, 0.2])
def test_the_error_is_within_that_of_a_choice_by_lot(texels: int, detail: float) -> None:
    """The formula of docs/accuracy.md, texel by texel, with what the map itself holds."""
    width = 0.002
    scene, at = po.Scene(slab(8000, width), DOWN), behind(4000)
    settings = {"map_size": texels, "device": "cpu", "steady": False}
    made = po.technique("exact", filter="none")
    full, few = (transmittance(scene, at, made, map_detail=d, **settings) for d in (1.0, detail))
    omega = -np.log(full)
    side = 1.4 / texels  # at most: strands end .2 beyond the square
    most = 0.3 * min(width * np.sqrt(2) / side, 1.0)  # what one may leave in a texel
    k = (1.0 / detail - 1.0) * most / (1.0 - most) ** 2
    bound = np.sqrt(np.mean(full**2 * np.expm1(k * omega)))
    rms = np.sqrt(np.mean((few - full) ** 2))
    assert 0.2 * bound < rms < bound
    assert abs(np.mean(few - full)) < 0.25 * bound


def test_auto_stays_within_what_it_says() -> None:
    """Fine strands in coarse maps become fewer, and add .02 at most; coarse ones stay."""
    random = np.random.default_rng(5)
    hair = slab(30_000, 0.0006, segments=2)
    scene = po.Scene(hair, DOWN)
    at = np.ascontiguousarray(np.asarray(hair.points)[random.integers(0, 90_000, 5000)])
    found = []
    for detail in (1.0, "auto"):
        with po.Renderer(
            scene, size=(8, 8), technique="exact", map_size=64, map_detail=detail, device="cpu"
        ) as r:
            found.append(r.transmittance(at))
            notes = [row.note for row in r.report if row.name == "map_detail"]
    told = re.fullmatch(r"1 of ([\d.]+) strands, \1 times as wide: adds \.02 at most", notes[0])
    assert told and float(told[1]) > 1.2
    rms = np.sqrt(np.mean((found[1] - found[0]) ** 2))
    assert 0.003 < rms <= 0.02
    with po.Renderer(
        po.Scene(slab(300, 0.05), DOWN), size=(8, 8), map_size=256, map_detail="auto", device="cpu"
    ) as r:
        r.transmittance(at)
        (note,) = [row.note for row in r.report if row.name == "map_detail"]
        assert note.startswith("all strands") or float(note.split()[2]) < 1.02


def test_lines_of_the_papers_are_not_fewer() -> None:
    scene, at = po.Scene(slab(500, 0.01), DOWN), behind(200)
    made = po.technique("opacity_shadow_maps", deposit_rule="paper")
    full = transmittance(scene, at, made, map_size=64, device="cpu")
    with po.Renderer(
        scene, size=(8, 8), technique=made, map_size=64, map_detail=0.2, device="cpu"
    ) as r:
        np.testing.assert_array_equal(r.transmittance(at), full)
        assert any(row.note == "all strands: deposit_rule is paper" for row in r.report)


@pytest.mark.gl
@pytest.mark.parametrize("look_up", ["per_sample", "along_strands"])
def test_pictures_show_every_strand(look_up: str) -> None:
    """Maps hold fewer, the camera sees all; and what it sees is lit as its vertices are."""
    hair = po.load("demo:hair?segments=6000")[0]
    scene = po.Scene(hair, po.DirectionalLight((0.5, 0.3, -0.8)))
    shown = []
    for detail in (1.0, 0.3):
        with po.Renderer(
            scene,
            size=(64, 48),
            map_size=64,
            map_detail=detail,
            strand_look_up=look_up,
        ) as r:
            shown.append(r.render())
    np.testing.assert_allclose(shown[0][..., 3], shown[1][..., 3], atol=1e-6)
    difference = np.abs(shown[0] - shown[1])[..., :3]
    assert 1e-5 < difference.mean() < 0.02
