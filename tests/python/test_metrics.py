"""Error figures: closed forms, order of arguments, and what they refuse."""

import sys
from typing import Any

import numpy as np
import pytest

import pyopacity as po

METRICS = {name: getattr(po.metrics, name) for name in ("rmse", "mae", "bias", "p99", "maximum")}


def test_closed_forms() -> None:
    reference = np.zeros(4)
    measured = np.array([-1.0, 2.0, -3.0, 4.0])
    assert po.metrics.rmse(measured, reference) == pytest.approx(np.sqrt(30.0 / 4.0), abs=1e-15)
    assert po.metrics.mae(measured, reference) == 2.5
    assert po.metrics.bias(measured, reference) == 0.5
    assert po.metrics.maximum(measured, reference) == 4.0
    # Ranks 0 .. 3; 99 % of the way lies at 2.97, between 3 and 4.
    assert po.metrics.p99(measured, reference) == pytest.approx(3.97, abs=1e-15)


def test_the_percentile_leaves_out_one_in_a_hundred() -> None:
    measured = np.arange(101.0)  # rank r is the value r
    assert po.metrics.p99(measured, np.zeros(101)) == 99.0


def test_the_measured_comes_first() -> None:
    darker, lighter = np.full((2, 3), 0.25), np.full((2, 3), 0.75)
    assert po.metrics.bias(darker, lighter) == -0.5
    assert po.metrics.bias(lighter, darker) == 0.5


def test_errors_are_all_of_them() -> None:
    random = np.random.default_rng(0)
    measured, reference = random.uniform(size=(2, 5, 7, 4))
    found = po.metrics.errors(measured, reference)
    assert {name: getattr(found, name) for name in METRICS} == {
        name: metric(measured, reference) for name, metric in METRICS.items()
    }


@pytest.mark.parametrize("metric", METRICS.values(), ids=METRICS.keys())
def test_sums_are_of_float64(metric: Any) -> None:
    """In float32 these differences would vanish beside the values."""
    reference = np.full(10_000, 1e6)
    assert metric(reference + 1e-3, reference) == pytest.approx(1e-3, rel=1e-6)
    whole = np.array([2**40, 2**40], np.int64)
    assert metric(whole + 3, whole) == 3.0
    assert metric(np.array([5], np.uint8), np.array([2], np.uint8)) == 3.0
    assert metric(np.array([2], np.uint8), np.array([5], np.uint8)) in (3.0, -3.0)


@pytest.mark.parametrize("metric", METRICS.values(), ids=METRICS.keys())
def test_bad_arrays_are_refused(metric: Any) -> None:
    good = np.ones((2, 3))
    for bad, named in [
        (np.ones((3, 2)), r"\(3, 2\)"),
        (np.ones(6), r"\(6,\)"),
        (np.array([["a"] * 3] * 2), "real numbers"),
        (good + 1j, "real numbers"),
        ([[1, 2, 3], [4]], "real numbers"),
        (np.ma.masked_array(good), "real numbers"),
        (None, "real numbers"),
    ]:
        with pytest.raises(po.ParameterError, match="measured") as caught:
            metric(bad, good)
        assert caught.match(named)
    with pytest.raises(po.ParameterError, match="empty"):
        metric(np.empty((0, 3)), np.empty((0, 3)))


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_the_first_value_that_is_not_finite_is_named(value: float) -> None:
    bad = np.ones((2, 3))
    bad[1, 0] = bad[1, 2] = value
    with pytest.raises(po.ParameterError, match=r"reference\[1, 0\]"):
        po.metrics.rmse(np.ones((2, 3)), bad)
    with pytest.raises(po.ParameterError, match=r"measured\[1, 0\]"):
        po.metrics.rmse(bad, np.ones((2, 3)))
    with pytest.raises(po.ParameterError, match="measured = "):
        po.metrics.rmse(value, 1.0)


# ---- pictures ----


def picture(height: int = 48, width: int = 64) -> np.ndarray:
    """Soft waves and an edge, alpha 1."""
    y, x = np.mgrid[:height, :width] / 16.0
    rgb = 0.3 + 0.2 * np.stack([np.sin(x), np.cos(y), np.sin(x + y)], axis=-1)
    rgb[:, width // 2 :] *= 0.5
    return np.concatenate([rgb, np.ones((height, width, 1))], axis=-1).astype(np.float32)


def test_flip_of_a_picture_with_itself_is_zero() -> None:
    assert po.metrics.flip(picture(), picture()) == 0.0


def test_flip_of_black_and_white_is_nearly_one() -> None:
    black, white = np.zeros((32, 32, 3)), np.ones((32, 32, 3))
    assert 0.9 < po.metrics.flip(black, white) <= 1.0


def test_flip_grows_with_the_error() -> None:
    reference = picture()
    random = np.random.default_rng(0)
    noise = random.normal(size=reference.shape)
    found = [
        po.metrics.flip(reference, reference + np.float32(strength) * noise)
        for strength in (0.01, 0.05, 0.2)
    ]
    assert 0.0 < found[0] < found[1] < found[2] < 1.0


def test_flip_takes_linear_values_and_clamps_them() -> None:
    """A step of .02 is seen in the dark and hardly in the light; beyond 1 all is white."""
    dark, light = np.full((32, 32, 3), 0.01), np.full((32, 32, 3), 0.9)
    assert po.metrics.flip(dark, dark + 0.02) > 4.0 * po.metrics.flip(light, light + 0.02)
    assert po.metrics.flip(np.full((32, 32, 3), 5.0), np.ones((32, 32, 3))) == 0.0


def test_flip_is_of_colour_over_black() -> None:
    reference = picture()
    transparent = reference.copy()
    transparent[..., 3] = 0.5  # premultiplied: over black the colour is what it was
    assert po.metrics.flip(reference, transparent) == 0.0
    assert po.metrics.flip(reference, reference[..., :3]) == 0.0


@pytest.mark.parametrize(
    "bad",
    [
        np.ones((4, 5)),
        np.ones((4, 5, 2)),
        np.ones((0, 5, 3)),
        np.ones((4, 5, 3), np.uint8),
        [[[1.0, 1.0, 1.0]]],
        np.full((4, 5, 3), np.nan),
    ],
)
def test_flip_refuses_what_is_no_picture(bad: Any) -> None:
    with pytest.raises(po.ParameterError, match="image"):
        po.metrics.flip(np.ones((4, 5, 3)), bad)
    with pytest.raises(po.ParameterError, match="reference"):
        po.metrics.flip(bad, np.ones((4, 5, 3)))


def test_flip_refuses_pictures_of_two_sizes() -> None:
    with pytest.raises(po.ParameterError, match="shape"):
        po.metrics.flip(np.ones((4, 5, 3)), np.ones((5, 4, 3)))


def test_without_the_package_the_error_says_what_to_install(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, "flip_evaluator", None)
    with pytest.raises(po.Error, match=r"pip install 'pyopacity\[compare\]'"):
        po.metrics.flip(picture(), picture())
