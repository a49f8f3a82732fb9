"""The look-up texture of the thesis: where its table lays planes, and what that costs."""

import numpy as np
import pytest

import pyopacity as po
from layer_errors import LIGHT, Errors, hair, rmse

MAPS = "bounding_opacity_maps"
DEVICES = ["cpu", pytest.param("gpu", marks=pytest.mark.gl)]


@pytest.mark.parametrize("device", DEVICES)
def test_the_last_layer_of_a_logarithmic_table_holds_half_of_the_range(device: str) -> None:
    """Sheets across the light: T falls by a line from the middle of the range to its end."""
    heights = np.linspace(0.0, 1.0, 5)[:, None, None]
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float64)
    corners = (square + heights * (0, 0, 1)).reshape(-1, 3)
    quad = np.array([[0, 1, 2], [0, 2, 3]])
    sheets = po.Mesh(corners, np.concatenate([quad + 4 * i for i in range(5)]), opacity=0.3)
    scene = po.Scene(sheets, po.DirectionalLight((0, 0, -1)))
    along = np.linspace(0.5, 0.99, 20)
    points = np.stack([np.full(20, 0.3), np.full(20, 0.2), 1.0 - along], axis=1)
    technique = po.technique(
        MAPS, layers=16, split="logarithmic", interpolation="linear", paper_lut=True, bias=0.0
    )
    with po.Renderer(scene, technique=technique, device=device, map_size=16, size=(8, 8)) as used:
        T = used.transmittance(points)
    # Two sheets lie before the middle; three from there on, which the last layer holds.
    assert np.abs(T - 0.7 ** (2 + 3 * (along - 0.5) / 0.5)).max() < 1e-4


def test_the_closed_form_is_better_than_the_table_of_many_layers() -> None:
    """Of 8 layers the table is as good: what it wastes lies behind most of the shadow."""
    errors = Errors(*hair(8000), map_size=64)
    for split in ("auto", "linear", "logarithmic", "per_texel"):
        closed, table = (
            rmse(errors.of(MAPS, layers=32, split=split, paper_lut=paper_lut))
            for paper_lut in (False, True)
        )
        assert closed < table, split
        assert split != "logarithmic" or table > 1.3 * closed


@pytest.mark.gl
def test_shaders_lay_the_same_planes_as_the_cpu() -> None:
    scene = po.Scene(po.load("demo:hair?segments=4000"), po.DirectionalLight(LIGHT))
    planes = {"split": "logarithmic", "deposit": "blend"}
    T = []
    for device in ("cpu", "gpu"):
        technique = po.technique(MAPS, paper_lut=True, layers=32, **planes)
        with po.Renderer(scene, technique=technique, device=device, map_size=64) as used:
            T.append(used.transmittance(scene.shapes[0]))
    assert np.abs(T[0] - T[1]).max() < 1e-5


def test_eleven_frames_and_one_find_their_ratio_in_the_table() -> None:
    scene, strands = hair(2000)
    notes = []
    for frames in (1, 11):
        technique = po.technique(MAPS, paper_lut=True, layers=8, search_frames=frames)
        with po.Renderer(scene, technique=technique, device="cpu", map_size=48) as used:
            for _ in range(frames):
                used.transmittance(strands)
            notes.append(next(row.note for row in used.report if "split_search" in row.name))
    one, eleven = (float(text.rpartition(" ")[2]) for text in notes)
    assert abs(one - eleven) < 0.31
