"""Total error on small scenes of each kind of caster, and what the benchmark looks at."""

import sys
from pathlib import Path

import numpy as np
import pytest

import pyopacity as po

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "benchmarks"))
import scene_errors
import small_scenes

KINDS = {
    "strands": "strands",
    "mask leaves": "leaves",
    "blend leaves": "leaves",
    "particles": "particles",
    "voxels": "voxels",
}


@pytest.fixture(autouse=True)
def few(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(scene_errors, "RECEIVERS", 300)


@pytest.mark.parametrize("light", ["directional", "spot"])
@pytest.mark.parametrize("kind", KINDS)
def test_the_goal_holds(kind: str, light: str) -> None:
    scene = scene_errors.small_scene(small_scenes.CASTERS[kind](), small_scenes.LIGHTS[light])
    found = scene_errors.errors(scene)
    assert list(found) == [KINDS[kind], "ground"]
    for techniques in found.values():
        assert max(one.rmse for one in techniques) <= scene_errors.GOAL


def test_voxels_that_receive_hold_something() -> None:
    smoke = small_scenes.voxels()
    scene = scene_errors.small_scene(smoke, po.DirectionalLight())
    found = scene_errors.receivers_by_kind(scene)
    ((shape, own),) = found["voxels"].chosen
    assert shape is smoke and len(own) == 300
    assert (smoke.extinction.ravel()[own] > 0.0).all()
    corner = np.array(np.unravel_index(own, smoke.extinction.shape))[::-1].T
    np.testing.assert_allclose(found["voxels"].points, smoke.origin + corner * smoke.spacing)


def test_the_ground_holds_the_shadow() -> None:
    casters: list[po.Shape] = [small_scenes.particles()]
    model = scene_errors.Model(lambda: casters, light=(0.5, 0.3, -0.8), ground=-2.0)
    scene = po.Scene(
        [*casters, scene_errors.ground_below(casters, model)], po.DirectionalLight(model.light)
    )
    ground = scene.shapes[1]
    assert isinstance(ground, po.Mesh) and (ground.points[:, 2] == -2.0).all()
    T = po.trace_transmittance(scene, ground)
    edge = (np.abs(ground.points - ground.points.mean(axis=0))).max(axis=1)
    assert T.min() < 0.5 and (T[edge == edge.max()] == 1.0).all()
