"""map_size="auto": a texel as wide as the space between strands, and the report says why."""

import numpy as np
import pytest

import pyopacity as po


def lattice(spacing: float, width: float = 0.01, side: float = 8.0) -> po.Scene:
    """Vertical strands on a square lattice, lit from above at a slant."""
    at = np.arange(0.0, side, spacing)
    x, y = (a.ravel() for a in np.meshgrid(at, at))
    z = np.linspace(0.0, side, 17)
    points = np.stack([np.repeat(x, z.size), np.repeat(y, z.size), np.tile(z, x.size)], 1).astype(
        np.float64
    )
    offsets = np.arange(x.size + 1) * z.size
    strands = po.Strands(points, offsets, width=width, opacity=0.3)
    return po.Scene(strands, po.DirectionalLight((0.3, 0.2, -1.0)))


def chosen(scene: po.Scene, **parameters: float) -> tuple[int, float, str]:
    """Texels, the side of one in world units, and the note in the report. No map is drawn."""
    technique = po.technique("unshadowed", **parameters)
    with po.Renderer(scene, technique=technique, map_size="auto", device="cpu") as renderer:
        renderer.transmittance(np.zeros((1, 3)))
        (note,) = [row.note for row in renderer.report if row.name == "map_size"]
        texel = 1.0 / float(np.linalg.norm(renderer.light_from_world[0, :3]))
    return int(note.partition(" ")[0]), texel, note


@pytest.mark.parametrize("spacing", [0.1, 0.2, 0.4])
def test_a_texel_is_as_wide_as_the_space_between_strands(spacing: float) -> None:
    size, texel, note = chosen(lattice(spacing, side=80 * spacing))
    assert note.startswith(f"{size} texels: the space between strands")
    assert size % 32 == 0
    assert 0.5 * spacing < texel < 1.3 * spacing


def test_a_texel_is_no_narrower_than_a_strand() -> None:
    _, texel, note = chosen(lattice(0.4, width=0.6, side=40.0))
    assert "the width of strands" in note
    assert 0.4 < texel <= 0.61


def test_a_filter_of_one_width_is_two_texels_wide() -> None:
    size, texel, note = chosen(lattice(0.2), filter_width=0.08)
    assert "half of filter_width" in note
    assert 0.035 < texel <= 0.0401
    assert size > chosen(lattice(0.2))[0]


def test_sizes_are_bounded() -> None:
    assert chosen(lattice(0.2), filter_width=1e-6)[0] == 4096
    assert chosen(lattice(0.2), filter_width=1e6)[0] == 64


def test_a_scene_without_strands_gets_512() -> None:
    corners = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    sheet = po.Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]), opacity=0.5)
    size, _, note = chosen(po.Scene(sheet, po.DirectionalLight((0, 0, -1))))
    assert (size, note) == (512, "512 texels: no strands to go by")


def test_scale_changes_nothing() -> None:
    scene = lattice(0.3)
    expected = chosen(scene)[0]
    for factor in (1e-3, 1e3):
        scene.shapes[0].transform = np.diag([factor, factor, factor, 1.0])
        assert chosen(scene)[0] == expected


def test_a_number_is_kept_and_not_explained() -> None:
    with po.Renderer(lattice(0.4), map_size=100, device="cpu") as renderer:
        renderer.transmittance(np.zeros((1, 3)))
        assert "map_size" not in {row.name for row in renderer.report}
        assert renderer.map_size == 100
        renderer.map_size = "auto"
        assert renderer.map_size == "auto"
        renderer.transmittance(np.zeros((1, 3)))
        assert "map_size" in {row.name for row in renderer.report}
    with pytest.raises(po.ParameterError, match="map_size"):
        po.Renderer(lattice(0.4), map_size="large", device="cpu")
