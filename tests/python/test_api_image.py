"""Pictures in files."""

import pathlib
import struct
import zlib
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import pyopacity as po


def read_png(path: pathlib.Path) -> npt.NDArray[np.uint8]:
    """The pixels of an 8-bit RGBA PNG, by the specification (filters included)."""
    data, at, packed = path.read_bytes(), 8, b""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    width = height = 0
    while at < len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", body[:10])
            assert (depth, color) == (8, 6)
        packed += body if kind == b"IDAT" else b""
        at += 12 + length
    lines = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + 4 * width)
    pixels = np.zeros((height, 4 * width), np.int64)
    for y, line in enumerate(lines.astype(np.int64)):
        above = pixels[y - 1] if y else np.zeros(4 * width, np.int64)
        for x in range(4 * width):
            left = pixels[y, x - 4] if x >= 4 else 0
            corner = above[x - 4] if x >= 4 else 0
            up = above[x]
            near = min((left, up, corner), key=lambda v: abs(left + up - corner - v))
            guess = (0, left, up, (left + up) // 2, near)[line[0]]
            pixels[y, x] = (line[1 + x] + guess) % 256
    return pixels.astype(np.uint8).reshape(height, width, 4)


def test_png_is_srgb_with_straight_alpha(tmp_path: pathlib.Path) -> None:
    image = np.zeros((2, 3, 4), np.float32)
    image[0, 0] = (0.2140, 0.2140, 0.2140, 1.0)  # half grey, as sRGB sees it
    image[0, 1] = (0.25, 0.0, 0.5, 0.5)  # premultiplied
    image[1, 2] = (7.0, -1.0, np.nan, 1.0)
    path = tmp_path / "picture.png"
    po.save_image(path, image)
    pixels = read_png(path)
    assert pixels[0, 0].tolist() == [127, 127, 127, 255]
    assert pixels[0, 1].tolist() == [188, 0, 255, 128]
    assert pixels[1, 2].tolist() == [255, 0, 0, 255]
    assert pixels[1, 0].tolist() == [0, 0, 0, 0]


def test_png_of_three_channels_is_opaque(tmp_path: pathlib.Path) -> None:
    po.save_image(tmp_path / "a.PNG", np.ones((2, 2, 3)))
    assert (read_png(tmp_path / "a.PNG") == 255).all()


def test_npy_is_exact(tmp_path: pathlib.Path) -> None:
    image = np.random.default_rng(0).normal(size=(3, 4, 4)).astype(np.float32)
    po.save_image(str(tmp_path / "a.npy"), image[::-1])
    assert np.array_equal(np.load(tmp_path / "a.npy"), image[::-1])
    po.save_image(tmp_path / "a.npy", image)
    assert np.array_equal(np.load(tmp_path / "a.npy"), image)
    assert [path.name for path in tmp_path.iterdir()] == ["a.npy"]


@pytest.mark.parametrize("name", ["a.jpg", "a", "a.png.txt", "missing/a.png", "missing/a.npy"])
def test_paths_that_cannot_be_saved(tmp_path: pathlib.Path, name: str) -> None:
    with pytest.raises(po.ParameterError) as error:
        po.save_image(tmp_path / name, np.zeros((2, 2, 4), np.float32))
    assert "folder" in error.value.fix or ".png or .npy" in error.value.fix
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "image",
    [
        [[0.0]],
        None,
        np.zeros((2, 2)),
        np.zeros((2, 2, 2)),
        np.zeros((2, 2, 4), np.uint8),
        np.zeros((0, 2, 4), np.float32),
    ],
)
def test_images_that_are_none(tmp_path: pathlib.Path, image: Any) -> None:
    with pytest.raises(po.ParameterError, match="image"):
        po.save_image(tmp_path / "a.png", image)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_is_not_written_over(tmp_path: pathlib.Path) -> None:
    for name in ("a.png", "a.npy"):
        (tmp_path / name).mkdir()
        with pytest.raises(po.ParameterError, match="cannot be written"):
            po.save_image(tmp_path / name, np.zeros((2, 2, 4), np.float32))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.npy", "a.png"]
