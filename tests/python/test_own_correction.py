"""What a caster that is itself the receiver loses of its light to itself."""

import sys
from pathlib import Path

import numpy as np
import pytest

import pyopacity as po

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "benchmarks"))
import generated_scenes
import own_shadow

MAPS = "bounding_opacity_maps"
MAP_SIZE, ACROSS, POINTS = 128, 8, 16
TEXEL = 12.0 / MAP_SIZE  # about: the strands lie in cells of 1.5


def losses(opacity: float, width: float, technique: str = MAPS, **parameters: object) -> np.ndarray:
    """1 - T along strands that stand alone: (strands, points)."""
    scene = own_shadow.isolated(opacity, width, ACROSS, POINTS)
    found = own_shadow.losses(scene, po.technique(technique, **parameters), MAP_SIZE)
    return found.reshape(-1, POINTS)


@pytest.mark.parametrize("opacity", [0.1, 0.3, 0.9])
@pytest.mark.parametrize("width", [0.01 * TEXEL, 0.1 * TEXEL, TEXEL, 4.0 * TEXEL])
def test_a_strand_alone_loses_no_more_than_lies_in_front(opacity: float, width: float) -> None:
    """Steep ones have themselves in front, beyond the bias, within a texel: so say exact lists."""
    corrected, exact = losses(opacity, width), losses(opacity, width, "exact")
    assert corrected.min() >= 0.0 and corrected.max() <= 1.0
    assert 0.5 * exact.mean() < corrected.mean() < 1.02 * exact.mean()


@pytest.mark.parametrize("interpolation", ["linear", "mean_depth"])
def test_few_layers_have_half_of_the_error_or_less(interpolation: str) -> None:
    strands = generated_scenes.scattered(1500)
    scene = generated_scenes.lit(strands, generated_scenes.ABOVE)
    exact = po.transmittance(scene, strands, "exact", MAP_SIZE)

    def rmse(layers: int, own_correction: bool) -> float:
        technique = po.technique(
            MAPS, layers=layers, interpolation=interpolation, own_correction=own_correction
        )
        return po.metrics.rmse(po.transmittance(scene, strands, technique, MAP_SIZE), exact)

    corrected = [rmse(layers, True) for layers in (4, 16, 64)]
    assert corrected == sorted(corrected, reverse=True)
    assert corrected[0] < 0.5 * rmse(4, False)


@pytest.mark.parametrize("own_correction", [True, False])
@pytest.mark.parametrize("opacity", [0.1, 0.9])
def test_the_first_surface_has_all_of_the_light(opacity: float, own_correction: bool) -> None:
    scene = own_shadow.isolated(opacity, TEXEL, ACROSS, POINTS)
    height = scene.shapes[0].points[:, 2].reshape(-1, POINTS)
    lost = losses(opacity, TEXEL, own_correction=own_correction)
    assert not lost[np.arange(len(lost)), height.argmax(axis=1)].any()


def test_depth_error_is_less() -> None:
    strands = generated_scenes.tree(1500)
    scene = generated_scenes.lit(strands, generated_scenes.ABOVE)
    with po.Renderer(scene, device="cpu", technique="exact", map_size=MAP_SIZE) as renderer:
        exact = renderer.transmittance(strands)
        rmse = {}
        for own_correction in (True, False):
            renderer.technique = po.technique(MAPS, layers=8, own_correction=own_correction)
            T = renderer.transmittance(strands)
            assert T.min() >= 0.0 and T.max() <= 1.0
            rmse[own_correction] = po.metrics.rmse(T, exact)
    assert rmse[True] < rmse[False]


def test_the_papers_deposit_knows_no_correction() -> None:
    """It is not the strand's own area that would be taken out."""
    on, off = (
        losses(0.5, TEXEL, own_correction=correction, deposit_rule="paper")
        for correction in (True, False)
    )
    assert on.tobytes() == off.tobytes() and on.max() > 0.0


def test_strands_see_an_opaque_surface_where_it_is() -> None:
    """A slope moves a surface back in the map, by a texel of itself: not for what is no surface."""
    side = np.array([[-4.0, -4, 0], [4, -4, 8], [4, 4, 8], [-4, 4, 0]])
    wall = po.Mesh(side, np.array([[0, 1, 2], [0, 2, 3]]))
    behind = side.mean(0) - [0.0, 0.0, 0.2]  # in the shadow, by less than the wall is moved back
    strand = po.Strands(
        np.stack([behind, behind + [0.01, 0.0, 0.01]]), np.array([0, 2]), width=0.01, opacity=0.3
    )
    scene = po.Scene([wall, strand], po.DirectionalLight((0.0, 0.0, -1.0)))
    for name in ("exact", "bounding_opacity_maps"):
        assert po.transmittance(scene, strand, name, 32).max() == 0.0
        assert po.transmittance(scene, wall, name, 32).min() == 1.0
