"""Technique "auto": what it picks, why, and that nothing of the table is better."""

import numpy as np
import numpy.typing as npt
import pytest

import pyopacity as po
from layer_errors import LIGHT, rmse
from scenes import random_shapes

F64 = npt.NDArray[np.float64]

SCENES = {
    "hair": "demo:hair?segments=6000",
    "leaves": "demo:tree?leaves=2000",
    "particles": "demo:plume?particles=1500",
    "voxels": "demo:smoke?voxels=20000",
    "mixed": "demo:mixed?primitives=4000",
}


def scene_of(name: str) -> po.Scene:
    return po.Scene(po.load(SCENES[name]), po.DirectionalLight(LIGHT))


def choice(renderer: po.Renderer) -> str:
    return next(row.note for row in renderer.report if row.name == "technique")


def T_of(scene: po.Scene, map_size: int, technique: str | po.Technique) -> tuple[F64, str]:
    with po.Renderer(scene, device="cpu", technique=technique, map_size=map_size) as renderer:
        T = np.concatenate([renderer.transmittance(s) for s in scene.shapes if s.receives])
        named = {row.name for row in renderer.report}
        return T.astype(float), choice(renderer) if "technique" in named else ""


@pytest.mark.parametrize("name", SCENES)
def test_nothing_with_as_many_layers_is_better(name: str) -> None:
    scene = scene_of(name)
    exact, _ = T_of(scene, 256, "exact")
    found, why = T_of(scene, 256, po.technique("auto", layers=8, memory=1))
    assert why.startswith("adaptive_opacity_maps, 8 layers: ")
    kept = {info.name for info in po.techniques().values() if has(info, "layers")} - {"auto"}
    errors = {t: rmse(T_of(scene, 256, po.technique(t, layers=8))[0] - exact) for t in kept}
    assert rmse(found - exact) <= 1.1 * min(errors.values()), errors


def has(info: po.TechniqueInfo, parameter: str) -> bool:
    return parameter in {p.name for p in info.parameters}


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("budget", [0.1, 0.02, 0.004])
def test_an_error_budget_is_kept(name: str, budget: float) -> None:
    scene = scene_of(name)
    found, why = T_of(scene, 256, po.technique("auto", error_budget=budget))
    exact, _ = T_of(scene, 256, "exact")
    assert rmse(found - exact) <= budget and "entries a texel" in why


def test_few_casters_are_listed_and_many_are_layered() -> None:
    notes = {}
    for count in (50, 20000):
        centers = np.random.default_rng(0).uniform(-1, 1, (count, 3))
        scene = po.Scene(po.Particles(centers, 0.1, 0.02), po.DirectionalLight(LIGHT))
        for budget in (0.02, 1e-6):
            technique = po.technique("auto", error_budget=budget)
            notes[count, budget] = T_of(scene, 64, technique)[1]
    assert notes[50, 0.02].startswith("exact: some ") and "MiB" in notes[50, 0.02]
    assert notes[20000, 0.02].startswith("adaptive_opacity_maps, 4 layers: ")
    assert notes[20000, 1e-6].endswith("layers miss error_budget 1e-06")


def test_what_it_picks_has_its_parameters_and_answers_the_same() -> None:
    scene = po.Scene(random_shapes(5), po.DirectionalLight(LIGHT))
    common = {"filter": "gaussian", "filter_radius": 2.0, "bias": 0.01}
    ways = {
        po.technique("auto", **common): po.technique("exact", **common),
        po.technique("auto", memory=1, layers=6, **common): po.technique(
            "adaptive_opacity_maps", layers=6, **common
        ),
    }
    for auto, other in ways.items():
        assert (T_of(scene, 512, auto)[0] == T_of(scene, 512, other)[0]).all()


def test_the_choice_is_told_once_and_made_again_when_the_scene_moves() -> None:
    scene = po.Scene(random_shapes(5), po.DirectionalLight(LIGHT))
    technique = po.technique("auto")
    with po.Renderer(scene, device="cpu", technique=technique, map_size=64) as renderer:
        point = np.zeros((1, 3))
        status = []
        for layers in (None, None, 5):
            if layers is not None:
                technique.layers, technique.memory = layers, 1
                scene.shapes[0].transform = 40.0 * np.eye(4) + np.diag([0, 0, 0, -39.0])
            renderer.transmittance(point)
            row = next(row for row in renderer.report if row.name == "technique")
            status.append(row.status)
        assert status == ["ran", "cached", "ran"]


def test_solids_alone_need_no_choice() -> None:
    ground = po.Mesh(np.eye(3), np.array([[0, 1, 2]]))
    scene = po.Scene(ground, po.DirectionalLight(LIGHT))
    with po.Renderer(scene, device="cpu", technique="auto", map_size=32) as renderer:
        renderer.transmittance(np.zeros((1, 3)))
        row = next(row for row in renderer.report if row.name == "technique")
        assert row.status == "culled" and row.why == "no translucent casters"
