"""Files that lie, absurd numbers: one typed error each, and everything as before after it."""

import pathlib
import struct
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pyopacity as po


def hair_file(
    strands: int = 2,
    points: int = 6,
    arrays: int = 2,
    segments: int = 2,
    magic: bytes = b"HAIR",
    thickness: float = 0.1,
    transparency: float = 0.5,
    body: bytes | None = None,
) -> bytes:
    """A .hair file: by default two strands of three points each."""
    header = struct.pack("<4s4I2f3f88s", magic, strands, points, arrays, segments, thickness,
                         transparency, 0.5, 0.4, 0.3, b"")  # fmt: skip
    if body is None:
        body = np.arange(3 * 6, dtype="<f4").tobytes()
    return header + body


POINTS = np.arange(18, dtype="<f4")


def with_value(value: float) -> bytes:
    points = POINTS.copy()
    points[7] = value
    return points.tobytes()


HOSTILE_HAIR = {
    "empty": b"",
    "header cut": hair_file()[:100],
    "body cut": hair_file()[:-1],
    "no body": hair_file(body=b""),
    "not hair": hair_file(magic=b"HARE"),
    "text": b"this is no hair file, although it is long enough to be the header of one" * 4,
    "no points array": hair_file(arrays=0),
    "more strands than points": hair_file(strands=5),
    "too few points": hair_file(points=5),
    "too many points": hair_file(points=7),
    "four billion strands": hair_file(strands=2**32 - 1, points=2**32 - 1),
    "four billion points": hair_file(points=2**32 - 1),
    "product wraps to the truth": hair_file(strands=2**31 + 1, points=6, segments=2),
    "segments array missing": hair_file(arrays=1 | 2),
    "segments array lies": hair_file(
        arrays=1 | 2, body=struct.pack("<2H", 65535, 65535) + POINTS.tobytes()
    ),
    "thickness array missing": hair_file(arrays=2 | 4),
    "colour array missing": hair_file(arrays=2 | 16),
    "NaN point": hair_file(body=with_value(np.nan)),
    "infinite point": hair_file(body=with_value(np.inf)),
    "negative thickness": hair_file(thickness=-1.0),
    "NaN thickness": hair_file(thickness=np.nan),
    "transparency 2": hair_file(transparency=2.0),
    "transparency NaN": hair_file(transparency=np.nan),
}

HOSTILE_OBJ = {
    "no vertex for a face": b"v 0 0 0\nf 1 2 3\n",
    "face of index 0": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n",
    "face before the start": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -4 -2 -1\n",
    "index beyond 64 bits": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999999\n",
    "vertex cut": b"v 0 0\n",
    "vertex of words": b"v a b c\n",
    "NaN vertex": b"v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "face of words": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf x y z\n",
    "bytes": bytes(range(256)) * 16,
    "not UTF-8": b"v 0 0 0\nf \xff\xfe\xfd\n",
    "zeros": b"\0" * 4096,
}


@pytest.mark.parametrize("name", HOSTILE_HAIR)
def test_hostile_hair(name: str, tmp_path: pathlib.Path) -> None:
    refuse(tmp_path / "hostile.hair", HOSTILE_HAIR[name])


@pytest.mark.parametrize("name", HOSTILE_OBJ)
def test_hostile_obj(name: str, tmp_path: pathlib.Path) -> None:
    refuse(tmp_path / "hostile.obj", HOSTILE_OBJ[name])


def refuse(path: pathlib.Path, content: bytes) -> None:
    path.write_bytes(content)
    with pytest.raises(po.FileFormatError) as error:
        po.load(path)
    assert error.value.what and error.value.fix
    assert path.name in error.value.what


def test_the_honest_file_is_read(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "honest.hair"
    path.write_bytes(hair_file())
    (strands,) = po.load(path)
    assert isinstance(strands, po.Strands)
    assert np.array_equal(strands.points, POINTS.reshape(-1, 3))
    assert (strands.width, strands.opacity, strands.offsets.tolist()) == (0.1, 0.5, [0, 3, 6])


@pytest.mark.parametrize("cut", range(0, 200, 7))
def test_a_cut_anywhere_is_an_error(cut: int, tmp_path: pathlib.Path) -> None:
    path = tmp_path / "cut.hair"
    path.write_bytes(hair_file()[: -1 - cut])
    with pytest.raises(po.FileFormatError):
        po.load(path)


@pytest.mark.parametrize("seed", range(40))
def test_flipped_bits_load_or_are_refused(seed: int, tmp_path: pathlib.Path) -> None:
    random = np.random.default_rng(seed)
    content = np.frombuffer(hair_file(), np.uint8).copy()
    at = random.integers(0, len(content), 4)
    content[at] ^= random.integers(1, 256, 4, dtype=np.uint8)
    path = tmp_path / "flipped.hair"
    path.write_bytes(content.tobytes())
    try:
        shapes = po.load(path)
    except po.FileFormatError:
        return
    assert all(np.isfinite(shape.points).all() for shape in shapes)


LIMITED = """
import resource, sys
import pyopacity as po
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
try:
    po.load(sys.argv[1])
except po.FileFormatError:
    after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    sys.exit(7 if after - before < 20_000 else 8)  # kilobytes
"""


@pytest.mark.parametrize("name", ["four billion strands", "four billion points"])
def test_memory_is_of_the_files_size(
    name: str, tmp_path: pathlib.Path, python: Callable[..., Any]
) -> None:
    path = tmp_path / "liar.hair"
    path.write_bytes(HOSTILE_HAIR[name])
    result = python("-c", LIMITED, str(path))
    assert result.returncode == 7, result.stderr


@pytest.mark.parametrize("path", ["missing.hair", "a.unknown", "", "."])
def test_paths_that_hold_nothing(path: str) -> None:
    with pytest.raises(po.FileFormatError):
        po.load(path)


@pytest.mark.parametrize(
    "name",
    [
        "demo:",
        "demo:hare",
        "demo:hair?size=3",
        "demo:hair?segments=-1",
        "demo:hair?segments=99999999999999999999",
        "a\0.hair",
    ],
)
def test_names_that_mean_nothing(name: str) -> None:
    with pytest.raises(po.ParameterError):
        po.load(name)


# ---- a renderer goes on after an error ----

NAN = np.full((3, 3), np.nan)


def set_(target: Callable[[po.Renderer], object], name: str, value: Any) -> Callable[..., object]:
    return lambda renderer: setattr(target(renderer), name, value)


def hair(renderer: po.Renderer) -> po.Shape:
    return renderer.scene.shapes[0]


def itself(renderer: po.Renderer) -> po.Renderer:
    return renderer


ABSURD: dict[str, Callable[[po.Renderer], object]] = {
    "size 0": set_(itself, "size", (0, 32)),
    "size 1,000,000": set_(itself, "size", (48, 1_000_000)),
    "size -1": set_(itself, "size", (-1, -1)),
    "size beyond 32 bits": set_(itself, "size", (2**40, 32)),
    "map_size 0": set_(itself, "map_size", 0),
    "map_size 1,000,000": set_(itself, "map_size", 1_000_000),
    "antialiasing 0": set_(itself, "antialiasing", 0),
    "ambient NaN": set_(itself, "ambient", np.nan),
    "background NaN": set_(itself, "background", (np.nan, 0, 0)),
    "layers 0": lambda r: setattr(r.technique, "layers", 0),
    "layers 4,000": lambda r: setattr(r.technique, "layers", 4_000),
    "layers misspelt": lambda r: setattr(r.technique, "layesr", 4),
    "technique misspelt": set_(itself, "technique", "bounding_opacity_map"),
    "camera None": set_(itself, "camera", None),
    "opacity 2": set_(hair, "opacity", 2.0),
    "opacity NaN": set_(hair, "opacity", np.nan),
    "width -1": set_(hair, "width", -1.0),
    "colour -1": set_(hair, "color", (-1.0, 0.0, 0.0)),
    "colour 1e30": set_(hair, "color", (0.0, 1e30, 0.0)),
    "points NaN": lambda r: setattr(hair(r), "points", hair(r).points * np.nan),
    "points too few": lambda r: setattr(hair(r), "points", hair(r).points[:3].copy()),
    "transform singular": set_(hair, "transform", np.zeros((4, 4))),
    "light without direction": lambda r: setattr(r.scene.lights[0], "direction", (0, 0, 0)),
    "question at NaN": lambda r: r.transmittance(NAN),
    "question of another light": lambda r: r.transmittance(np.zeros((1, 3)), light=3),
    "texture that is not there": lambda r: r.read("no/such/texture"),
    "picture of another size": lambda r: r.render(out=np.zeros((1, 1, 4), np.float32)),
}


@pytest.mark.gl
@pytest.mark.parametrize("name", ABSURD)
def test_after_an_error_the_picture_is_the_same(
    name: str, renderer: po.Renderer, same: Callable[..., bool]
) -> None:
    before = renderer.render()
    with pytest.raises(po.ParameterError) as error:
        ABSURD[name](renderer)
    assert error.value.what and error.value.fix
    assert same(before, renderer.render())
    renderer.invalidate()
    assert same(before, renderer.render())


@pytest.mark.gl
def test_nan_points_are_named_by_their_index(renderer: po.Renderer) -> None:
    points = np.zeros((5, 3))
    points[3, 1] = np.nan
    with pytest.raises(po.ParameterError, match=r"points\[3\]"):
        renderer.transmittance(points)


@pytest.mark.gl
def test_the_brightest_picture_is_finite(renderer: po.Renderer) -> None:
    light = renderer.scene.lights[0]
    light.color, light.intensity = (1e9, 1e9, 1e9), 1e9
    for shape in renderer.scene.shapes:
        shape.color = (1e9, 1e9, 1e9)
    picture = renderer.render()
    assert np.isfinite(picture).all() and picture.max() > 1e20
