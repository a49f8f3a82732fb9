"""The number of layers for a budget: of error against exact lists, of a frame's time."""

import json
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pyopacity as po
from layer_errors import hair, rmse
from pyopacity import tuning
from pyopacity.cli import main


def renderer(
    segments: int = 4000, technique: str | po.Technique = "bounding_opacity_maps"
) -> po.Renderer:
    scene, _ = hair(segments)
    return po.Renderer(scene, technique=technique, device="cpu", map_size=48)


def error_of(used: po.Renderer, layers: int) -> float:
    """Of T at all vertices of everything, without the function under test."""

    def ask(technique: po.Technique) -> np.ndarray:
        used.technique = technique
        return np.concatenate([used.transmittance(shape) for shape in used.scene.shapes])

    own = used.technique
    exact = ask(po.technique("exact"))
    found = ask(po.technique(own.name, layers=layers))
    used.technique = own
    return rmse(found - exact)


@pytest.mark.parametrize("budget", [0.05, 0.02])
def test_the_fewest_layers_within_an_error(budget: float) -> None:
    with renderer() as used:
        tried: list[po.LayerTrial] = []
        choice = po.tune(used, error=budget, progress=tried.append)
        assert choice.fits and choice.trials == tuple(tried)
        assert used.technique.layers == choice.layers
        assert error_of(used, choice.layers) <= budget
        assert choice.layers == 1 or error_of(used, choice.layers - 1) > budget


def test_the_errors_that_it_tells_are_those_against_exact_lists() -> None:
    with renderer() as used:
        for trial in po.tune(used, error=0.02).trials:
            assert trial.error == pytest.approx(error_of(used, trial.layers), rel=1e-6)
            assert trial.fits == (trial.error <= 0.02)
            assert trial.ms is None


def test_an_error_that_no_number_meets_takes_the_most() -> None:
    with renderer(technique=po.technique("deep_opacity_maps")) as used:
        choice = po.tune(used, error=1e-9)
        assert (choice.fits, choice.layers, used.technique.layers) == (False, 64, 64)


@pytest.fixture
def clocked(monkeypatch: pytest.MonkeyPatch) -> Callable[[float], None]:
    """Frames that take so many milliseconds a layer, whatever the machine."""

    def set_clock(ms_a_layer: float) -> None:
        now = [0.0]

        class Clock(tuning._Clock):
            def _frame(self) -> None:
                now[0] += 1e-3 * ms_a_layer * self._renderer.technique.layers

        monkeypatch.setattr(tuning, "_Clock", Clock)
        monkeypatch.setattr(tuning.time, "perf_counter", lambda: now[0])

    return set_clock


@pytest.mark.parametrize(
    ("ms_a_layer", "layers", "fits"),
    [(1.0, 32, True), (0.5, 64, True), (2.5, 12, True), (40, 1, False)],
)
def test_layers_grow_while_the_frame_holds(
    clocked: Callable[[float], None], ms_a_layer: float, layers: int, fits: bool
) -> None:
    """33 ms a frame; not to the last layer, since four stand in one texture."""
    clocked(ms_a_layer)
    with renderer(500) as used:
        camera = used.camera
        choice = po.tune(used, budget_ms=33.0)
        assert used.camera == camera
    assert (choice.layers, choice.fits) == (layers, fits)
    for trial in choice.trials:
        assert trial.ms == pytest.approx(ms_a_layer * trial.layers)
        assert trial.error is None


def test_a_flight_goes_once_around_the_target() -> None:
    camera = po.Camera.look_at((3.0, 0.0, 2.0), (1.0, 0.0, 1.0), (0, 0, 1), 40.0)
    opposite, quarter = (tuning._flown(camera, part) for part in (0.5, 0.25))
    assert opposite.eye == pytest.approx((-1.0, 0.0, 2.0))
    assert quarter.eye == pytest.approx((1.0, 2.0, 2.0))
    assert quarter.target == camera.target and quarter.fov_deg == camera.fov_deg


@pytest.mark.gl
def test_real_frames_are_timed(needs_gl: None) -> None:
    scene, _ = hair(500)
    with po.Renderer(scene, size=(32, 32), map_size=32) as used:
        picture = used.render()
        choice = po.tune(used, budget_ms=1e6, frames=2)
        assert (choice.layers, choice.fits) == (64, True)
        assert all(trial.ms > 0 for trial in choice.trials)
        used.technique.layers = 16
        assert np.array_equal(used.render(), picture)


@pytest.mark.parametrize(
    "wrong",
    [
        {},
        {"budget_ms": 3, "error": 0.1},
        {"budget_ms": 0},
        {"budget_ms": -1},
        {"budget_ms": float("nan")},
        {"error": 0},
        {"error": 1.5},
        {"error": "little"},
        {"budget_ms": 3, "frames": 0},
        {"budget_ms": 3, "frames": 1.5},
    ],
)
def test_what_is_no_budget_is_an_error(wrong: dict[str, Any]) -> None:
    with renderer(200) as used, pytest.raises(po.ParameterError):
        po.tune(used, **wrong)


def test_a_technique_without_layers_is_an_error() -> None:
    with (
        renderer(200, "density_clustering") as used,
        pytest.raises(po.ParameterError, match="no layers"),
    ):
        po.tune(used, error=0.1)


def test_an_interrupted_choice_leaves_the_technique_as_it_was() -> None:
    def stop(trial: po.LayerTrial) -> None:
        if trial.layers == 4:
            raise KeyboardInterrupt

    with renderer(500) as used:
        kept = used.technique
        with pytest.raises(KeyboardInterrupt):
            po.tune(used, error=1e-9, progress=stop)
        assert used.technique is kept and kept.layers == 16


# ---- the command ----

SMALL = ["tune", "demo:hair?segments=500", "--device", "cpu", "--map-size", "32"]


def test_the_command_prints_each_trial_and_the_choice(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*SMALL, "--error", ".0005"]) == 0
    *trials, choice = capsys.readouterr().out.splitlines()
    assert choice.startswith("--technique bounding_opacity_maps --param layers=")
    assert trials[0].startswith("   1 layers  error 0.")
    assert {line.partition("  ")[2].rpartition("  ")[2] for line in trials} == {
        "fits",
        "does not fit",
    }


def test_the_command_tells_a_program_the_same(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*SMALL, "--budget-ms", "100000", "--frames", "1", "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert (record["layers"], record["fits"]) == (64, True)
    assert [trial["layers"] for trial in record["trials"]] == [1, 2, 4, 8, 16, 32, 64]


@pytest.mark.parametrize(
    "wrong", [[], ["--error", ".1", "--budget-ms", "3"], ["--error", "x"], ["--error", "2"]]
)
def test_the_command_refuses_what_is_no_budget(
    wrong: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*SMALL, *wrong]) == 2
    assert "fix: " in capsys.readouterr().err
