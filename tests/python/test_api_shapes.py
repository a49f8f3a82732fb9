"""Strands and meshes: what they take, refuse and give back."""

import inspect
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pyopacity as po

POINTS = np.array([[0, 0, 0], [0, 0, 1], [0, 0, 2], [1, 0, 0], [1, 0, 1]], np.float64)
OFFSETS = np.array([0, 3, 5])


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_points_stay_what_they_are(dtype: type[np.floating[Any]]) -> None:
    strands = po.Strands(POINTS.astype(dtype), OFFSETS)
    assert strands.points.dtype == dtype
    assert np.array_equal(strands.points, POINTS)


@pytest.mark.parametrize("dtype", [np.int64, np.int32, np.uint32, np.uint8])
def test_offsets_of_any_integer_dtype(dtype: type[np.integer[Any]]) -> None:
    strands = po.Strands(POINTS, OFFSETS.astype(dtype))
    assert strands.offsets.tolist() == [0, 3, 5]
    assert strands.segment_count == 3


@pytest.mark.parametrize(
    ("points", "named"),
    [
        (POINTS.tolist(), "a list"),
        (None, "None"),
        (POINTS.astype(np.float16), "float16"),
        (POINTS.astype(np.int64), "int64"),
        (POINTS.astype(np.complex128), "complex128"),
        (POINTS.astype(object), "object"),
        (POINTS.astype(">f8"), ">f8"),
        (np.ma.masked_array(POINTS), "masked"),
        (POINTS.ravel(), "(15,)"),
        (POINTS[:, :2].copy(), "(5, 2)"),
        (np.asfortranarray(POINTS), "not C-contiguous"),
        (np.repeat(POINTS, 2, axis=0)[::2], "not C-contiguous"),
    ],
)
def test_other_points_are_named_and_refused(points: Any, named: str) -> None:
    with pytest.raises(po.ParameterError) as error:
        po.Strands(points, OFFSETS)
    assert error.value.what.startswith("points is") and named in error.value.what
    assert "numpy" in error.value.fix or "shape" in error.value.fix


@pytest.mark.parametrize("dtype", [bool, np.float64, object])
def test_offsets_are_integers(dtype: Any) -> None:
    with pytest.raises(po.ParameterError, match="offsets is an? "):
        po.Strands(POINTS, OFFSETS.astype(dtype))


@pytest.mark.parametrize(
    "offsets", [[], [0], [1, 5], [0, 4], [0, 6], [0, 3, 2, 5], [0, 2**63], [-1, 5]]
)
def test_offsets_that_do_not_fit_the_points(offsets: list[int]) -> None:
    dtype = np.uint64 if offsets[-1:] == [2**63] else np.int64
    with pytest.raises(po.ParameterError, match="offsets"):
        po.Strands(POINTS, np.array(offsets, dtype))


def test_numbers_for_all_and_arrays_one_a_point() -> None:
    strands = po.Strands(POINTS, OFFSETS, width=0.3, opacity=np.float32(0.7), color=(0.1, 0.2, 0.3))
    assert (strands.width, strands.opacity, strands.color) == (0.3, 0.7, (0.1, 0.2, 0.3))
    strands.width = np.linspace(0.1, 0.2, 5)
    strands.opacity = np.linspace(0.0, 1.0, 5, dtype=np.float32)
    strands.color = np.full((5, 3), 0.5)
    assert strands.width.dtype == np.float32
    assert np.allclose(strands.width, np.linspace(0.1, 0.2, 5))
    assert strands.opacity.tolist() == [0.0, 0.25, 0.5, 0.75, 1.0]
    assert strands.color.shape == (5, 3)


@pytest.mark.parametrize("name", ["width", "opacity", "color"])
@pytest.mark.parametrize("value", [None, "0.1", True, [0.1], np.ones(4), np.ones(5, np.int64)])
def test_other_attributes_are_refused(name: str, value: Any) -> None:
    strands = po.Strands(POINTS, OFFSETS)
    before = getattr(strands, name)
    with pytest.raises(po.ParameterError, match=name):
        setattr(strands, name, value)
    assert getattr(strands, name) == before


@pytest.mark.parametrize("bad", [-0.1, 1.5, np.nan, np.inf, -np.inf])
def test_bad_opacity_is_named_by_its_index(bad: float) -> None:
    opacity = np.full(5, 0.5)
    opacity[3] = bad
    with pytest.raises(po.ParameterError, match=r"opacity\[3\]"):
        po.Strands(POINTS, OFFSETS, opacity=opacity)


@pytest.mark.parametrize("bad", [np.nan, np.inf, 1e30])
def test_bad_points_are_named_by_their_index(bad: float) -> None:
    points = POINTS.copy()
    points[2, 1] = bad
    with pytest.raises(po.ParameterError, match=r"points\[2\]"):
        po.Strands(points, OFFSETS)


def test_what_comes_back_cannot_be_written_to(tuft: Callable[..., po.Strands]) -> None:
    strands = tuft()
    for array in (strands.points, strands.offsets, strands.transform):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
        with pytest.raises(ValueError):
            array.flags.writeable = True


def test_every_part_is_settable(tuft: Callable[..., po.Strands]) -> None:
    strands = tuft()
    strands.points = strands.points + 1.0
    assert np.allclose(strands.points, tuft().points + 1.0)
    strands.transform = np.diag([2.0, 2.0, 2.0, 1.0])
    assert np.allclose(strands.bounds.max, 2.0 * (tuft().bounds.max + 1.0))
    strands.casts, strands.receives = False, np.bool_(False)
    assert (strands.casts, strands.receives) == (False, False)
    with pytest.raises(po.ParameterError, match="casts is 1|casts is an int"):
        strands.casts = 1


def test_the_number_of_points_stays(tuft: Callable[..., po.Strands]) -> None:
    strands = tuft()
    with pytest.raises(po.ParameterError, match="points"):
        strands.points = strands.points[:-1]


@pytest.mark.parametrize(
    "transform",
    [np.eye(3), np.zeros((4, 4)), np.full((4, 4), np.nan), np.eye(4).tolist(), np.eye(4)[::-1]],
)
def test_bad_transforms(transform: Any, tuft: Callable[..., po.Strands]) -> None:
    strands = tuft()
    with pytest.raises(po.ParameterError, match="transform"):
        strands.transform = transform
    assert np.array_equal(strands.transform, np.eye(4))


def test_a_misspelt_attribute_is_an_error_with_the_nearest(tuft: Callable[..., po.Strands]) -> None:
    strands = tuft()
    with pytest.raises(po.ParameterError, match='did you mean "points"'):
        strands.poitns = POINTS
    with pytest.raises(AttributeError, match='did you mean "width"'):
        _ = strands.widht
    with pytest.raises(po.ParameterError, match="offsets cannot be set"):
        strands.offsets = OFFSETS
    assert not hasattr(strands, "nothing")


@pytest.mark.parametrize(
    ("make", "named"),
    [
        (lambda **more: po.Strands(POINTS, OFFSETS, **more), "width"),
        (lambda **more: po.Strands(points=POINTS, **more), "width"),
        (lambda **more: po.Mesh(POINTS, np.array([[0, 1, 2]]), **more), "triangles"),
        (lambda **more: po.DirectionalLight((0, 0, -1), **more), "direction"),
        (lambda **more: po.Scene(**more), "by position"),
    ],
)
def test_a_misspelt_keyword_is_an_error_with_the_nearest(
    make: Callable[..., object], named: str
) -> None:
    with pytest.raises(po.UnknownNameError, match='"widht"') as error:
        make(widht=0.3)
    assert named in error.value.fix


def test_other_arguments_are_pythons_business() -> None:
    with pytest.raises(TypeError, match="offsets"):
        po.Strands(POINTS)
    with pytest.raises(TypeError, match="positional"):
        po.DirectionalLight((0, 0, -1), (1, 1, 1), 1.0, None)
    with pytest.raises(TypeError, match="multiple values"):
        po.Strands(POINTS, OFFSETS, points=POINTS)
    assert list(inspect.signature(po.Strands).parameters) == [
        *("points", "offsets", "width", "opacity", "color")
    ]
    assert inspect.signature(po.Mesh).parameters["color"].default == (0.7, 0.7, 0.7)


def test_mesh_makes_normals_and_takes_them(sheet: Callable[..., po.Mesh]) -> None:
    mesh = sheet()
    assert mesh.opaque and mesh.triangles.dtype == np.uint32
    assert np.allclose(mesh.normals, [0, 0, 1])
    mesh.normals = np.tile([3.0, 0.0, 0.0], (4, 1))
    assert np.allclose(mesh.normals, [1, 0, 0])
    mesh.normals = None
    assert np.allclose(mesh.normals, [0, 0, 1])
    mesh.opacity = 0.5
    assert not mesh.opaque


@pytest.mark.parametrize("bad", [-1, 4, 2**40])
def test_triangles_that_name_no_point(bad: int) -> None:
    with pytest.raises(po.ParameterError, match=r"triangles\[1\]\[2\]"):
        po.Mesh(np.zeros((4, 3)), np.array([[0, 1, 2], [0, 1, bad]]))


def test_a_shape_without_points() -> None:
    strands = po.Strands(np.zeros((0, 3)), np.array([0]))
    mesh = po.Mesh(np.zeros((0, 3)), np.zeros((0, 3), np.int64))
    assert strands.segment_count == 0 and len(mesh.triangles) == 0
    assert strands.bounds.empty and mesh.bounds.empty
