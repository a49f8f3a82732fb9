"""Yuksel and Keyser 2008: what the paper claims, and what its options do."""

from typing import Any

import numpy as np
import pytest

import pyopacity as po
from layer_errors import LIGHT, Errors, hair, rmse
from test_load_formats import DATA

OSM, DOM = "opacity_shadow_maps", "deep_opacity_maps"


@pytest.fixture(scope="module")
def errors() -> Errors:
    return Errors(*hair())


def test_three_layers_light_the_surface_better_than_sixteen_slices(errors: Errors) -> None:
    lit = errors.is_lit
    three, sixteen = errors.of(DOM, layers=3)[lit], errors.of(OSM, layers=16)[lit]
    assert lit.sum() > 500 and rmse(three) < 0.3 * rmse(sixteen)


@pytest.mark.slow
def test_so_they_do_on_the_model_of_figure_1() -> None:
    path = DATA / "hair" / "straight.hair"
    if not path.exists():
        pytest.skip(f"{path}: not there; set PYOPACITY_DATA")
    scene = po.Scene(po.load(str(path)), po.DirectionalLight(LIGHT))
    scene.shapes[0].opacity = 0.3
    straight = Errors(scene, scene.shapes[0], 256)
    lit = straight.is_lit
    three = rmse(straight.of(DOM, layers=3)[lit])
    assert three < 0.3 * rmse(straight.of(OSM, layers=16)[lit])
    assert three < rmse(straight.of(OSM, layers=128)[lit])
    assert straight.bands(16, OSM, layers=16) > 0.1
    assert abs(straight.bands(16, DOM, layers=3)) < 0.01


def test_the_first_surface_is_lit_whatever_its_slope(sheet: Any) -> None:
    slope = sheet(opacity=0.5)
    slope.transform = np.array([[0.8, 0, 0.6, 0], [0, 1, 0, 0], [-0.6, 0, 0.8, 0], [0, 0, 0, 1.0]])
    below = sheet(-3.0, 0.5, opacity=0.5)
    scene = po.Scene([slope, below], po.DirectionalLight((0.0, 0.0, -1.0)))
    for layers in (1, 3, 16):
        technique = po.technique(DOM, layers=layers)
        assert po.transmittance(scene, slope, technique, 64).min() == 1.0
        assert po.transmittance(scene, below, technique, 64).max() < 0.9


def test_too_few_or_too_small_layers_darken_what_is_beyond(errors: Errors) -> None:
    """Figure 8: strands beyond the last layer cast shadows onto themselves."""
    size = 0.02 * errors.depth_range
    few = errors.of(DOM, layers=3, layer_sizes=[size] * 3)
    more = errors.of(DOM, layers=7, layer_sizes=[size] * 7)
    larger = errors.of(DOM, layers=3, layer_sizes=[3 * size] * 3)
    assert few.mean() < -0.03
    assert few.mean() < more.mean() < 0.01 and few.mean() < larger.mean() < 0.01
    assert rmse(more) < rmse(few)


def test_what_lies_beyond_the_last_layer(errors: Errors) -> None:
    small = {"layers": 3, "layer_extent": 0.05 * errors.depth_range}
    last, ignore, extend = (
        errors.of(DOM, beyond=beyond, **small) for beyond in ("last", "ignore", "extend")
    )
    assert last.mean() < -0.03 and ignore.mean() > 0.03
    # One deep layer counts casters before they come: lighter than what casts on itself.
    assert last.mean() < extend.mean() < ignore.mean()


def test_behind_everything_only_ignore_forgets_casters(sheet: Any) -> None:
    scene = po.Scene(
        [sheet(height, opacity=0.5) for height in (0.0, -1.0, -5.0)],
        po.DirectionalLight((0.0, 0.0, -1.0)),
    )
    point = np.array([[0.1, 0.2, -50.0]])
    for beyond, rest in (("last", 0.125), ("extend", 0.125), ("ignore", 0.25)):
        technique = po.technique(DOM, layers=4, layer_extent=2.0, beyond=beyond)
        assert po.transmittance(scene, point, technique, 32)[0] == pytest.approx(rest, abs=1e-6)


def test_sizes_are_world_units_and_grow_linearly(errors: Errors) -> None:
    linear = errors.ask(DOM, layers=3, layer_sizes="linear", layer_extent=3.0)
    assert (errors.ask(DOM, layers=3, layer_extent=3.0) == linear).all()
    assert (errors.ask(DOM, layers=3, layer_sizes=[0.5, 1.0, 1.5]) == linear).all()
    assert (errors.ask(DOM, layers=3, layer_sizes="1, 2, 3", layer_extent=3.0) == linear).all()
    assert (errors.ask(DOM, layers=3, layer_sizes="constant", layer_extent=3.0) != linear).any()


def test_bad_sizes_are_typed() -> None:
    technique = po.technique(DOM)
    for bad in ([], [1.0, -1.0], [0.0], "quadratic", "1,,2", True, [float("nan")]):
        with pytest.raises(po.ParameterError) as caught:
            technique.layer_sizes = bad
        assert caught.value.fix
    technique.layer_sizes = np.array([1.0, 2.0])
    assert technique.layer_sizes == "1.0,2.0"
    with pytest.raises(po.ParameterError, match="2 sizes for 16 layers") as caught:
        po.transmittance(po.Scene(po.DirectionalLight()), np.zeros((1, 3)), technique)
    assert "layers = 2" in caught.value.fix


def test_the_found_extent_is_nearly_the_best(errors: Errors) -> None:
    for layers in (3, 16):
        found = rmse(errors.of(DOM, layers=layers))
        tried = [
            rmse(errors.of(DOM, layers=layers, layer_extent=extent))
            for extent in errors.depth_range * 0.5 ** np.arange(6)
        ]
        assert found < 1.2 * min(tried) < max(tried)


def test_four_n_minus_one_layers_fill_n_targets(needs_gl: None) -> None:
    scene, strands = hair(3000)
    for layers, targets in ((3, 1), (4, 2), (7, 2), (64, 17)):
        technique = po.technique(DOM, layers=layers, deposit="blend")
        with po.Renderer(scene, technique=technique, map_size=48) as renderer:
            plain = renderer.transmittance(strands)
            technique.packing = "4n-1"
            assert (renderer.transmittance(strands) == plain).all()
            packed = renderer.read(f"{DOM}/opacity")
            start = renderer.read(f"{DOM}/start")
        assert packed.shape == (targets, 48, 48, 4)
        covered = start < 1.0
        assert (packed[0, ..., 3][covered] == start[covered]).all()


def test_depths_of_few_bits_change_little(errors: Errors) -> None:
    """Section 3: 8 bits look like 16."""
    full = errors.ask(DOM)
    changed = {bits: rmse(errors.ask(DOM, depth_bits=bits) - full) for bits in (16, 8)}
    assert 0.0 < changed[16] < 0.003
    assert changed[16] < changed[8] < 0.02
    assert rmse(errors.of(DOM, depth_bits=8)) < 1.1 * rmse(errors.of(DOM))


def test_smoothing_blurs_silhouettes(errors: Errors, sheet: Any) -> None:
    """So it is off by default: beside a caster it darkens, on its edge it lightens."""
    scene = po.Scene(sheet(0.0, 1.0, opacity=0.5), po.DirectionalLight((0.0, 0.0, -1.0)))
    ground = sheet(-1.0, 3.0)
    scene.add(ground)
    ground.casts = False
    x = np.linspace(-1.5, 1.5, 61)
    points = np.stack([x, 0 * x, 0 * x - 0.9], 1)
    technique = po.technique(DOM, layers=3)
    sharp = po.transmittance(scene, points, technique, 64)
    technique.smoothing = 3
    smooth = po.transmittance(scene, points, technique, 64)
    half_shadow = [((T > 0.52) & (T < 0.98)).sum() for T in (sharp, smooth)]
    assert half_shadow[1] > half_shadow[0] + 2
    assert smooth[30] == pytest.approx(0.5, abs=1e-6) and sharp[30] == pytest.approx(0.5, abs=1e-6)
    # Inside of hair neighbours flatten each other out: it is no gain in accuracy.
    assert rmse(errors.of(DOM, smoothing=1)) > rmse(errors.of(DOM))


def test_opaque_casters_have_a_map_of_their_own() -> None:
    """Figure 7: the hairy teapot, whose body and coat shade each other."""
    scene = po.Scene(po.load("demo:teapot?segments=6000"), po.DirectionalLight(LIGHT))
    for shape in scene.shapes:
        exact = po.transmittance(scene, shape, "exact", 128)
        found = po.transmittance(scene, shape, po.technique(DOM), 128)
        assert ((found == 0.0) == (exact == 0.0)).mean() > 0.999
        assert rmse(found - exact) < 0.05
