"""opacity_demo: the command's picture in a window and without one, and what it refuses."""

import os
import pathlib
import shutil
import struct
import subprocess
import sys
import zlib
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
import pytest

Pixels = npt.NDArray[np.uint8]

DEMO = "demo:hair?segments=500"
VIEWER = pathlib.Path(sys.executable).with_name("opacity_demo")
NO_DISPLAY = {name: value for name, value in os.environ.items() if "DISPLAY" not in name}
BACKGROUND = (0.75, 0.78, 0.82)  # of the window, linear
TRIANGLE = "v 0 0 60\nv 30 0 60\nv 0 30 70\nf 1 2 3\n"

pytestmark = pytest.mark.skipif(not VIEWER.exists(), reason="opacity_demo was not installed")


def run(
    cwd: pathlib.Path, *command: str | pathlib.Path, **environment: str
) -> subprocess.CompletedProcess[str]:
    """Without a display, so that nothing can open a window and wait for somebody to close it."""
    return subprocess.run(
        command,
        cwd=cwd,
        env={**NO_DISPLAY, **environment},
        capture_output=True,
        text=True,
        timeout=120,
    )


def unfiltered(kind: int, line: bytearray, above: Sequence[int]) -> bytearray:
    """One line of a PNG with four bytes a pixel, by the specification's five filters."""
    corner_of, left_of = bytes(4) + bytes(above), bytearray(4)
    for x, byte in enumerate(line):
        left, up, corner = left_of[x], above[x], corner_of[x]
        if kind == 4:
            to_left, to_up, to_corner = (
                abs(up - corner),
                abs(left - corner),
                abs(left + up - 2 * corner),
            )
            nearest = up if to_up <= to_corner else corner
            guess = left if to_left <= to_up and to_left <= to_corner else nearest
        else:
            guess = (0, left, up, (left + up) // 2)[kind]
        left_of.append((byte + guess) & 255)
    return left_of[4:]


def read_png(path: pathlib.Path) -> Pixels:
    """(H, W, 4) of an 8-bit RGBA file."""
    data, at, packed = path.read_bytes(), 8, b""
    width, height, depth, color = struct.unpack(">IIBB", data[16:26])
    assert (depth, color) == (8, 6)
    while at < len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        packed += data[at + 8 : at + 8 + length] if data[at + 4 : at + 8] == b"IDAT" else b""
        at += 12 + length
    raw, stride = zlib.decompress(packed), 1 + 4 * width
    assert len(raw) == stride * height
    lines: list[Sequence[int]] = [bytes(4 * width)]
    for start in range(0, len(raw), stride):
        line = bytearray(raw[start + 1 : start + stride])
        lines.append(unfiltered(raw[start], line, lines[-1]))
    return np.array([list(line) for line in lines[1:]], np.uint8).reshape(height, width, 4)


def srgb_byte(linear: float) -> int:
    return round(255 * (1.055 * linear ** (1 / 2.4) - 0.055))


# ---- the picture ----


@pytest.mark.gl
@pytest.mark.skipif(shutil.which("xvfb-run") is None, reason="needs xvfb-run to have a display")
def test_a_window_shows_the_headless_picture_before_its_background(tmp_path: pathlib.Path) -> None:
    scene = (DEMO, "--set", "antialiasing=1", "--set", "map_size=64")
    scene += ("--set", "compositing=opaque")
    window = run(tmp_path, "xvfb-run", "-a", VIEWER, *scene, "--frames", "3", "-o", "window.png")
    assert (window.returncode, window.stderr) == (0, "")
    shown = read_png(tmp_path / "window.png")
    height, width = shown.shape[:2]
    assert f"window.png: {width}x{height}" in window.stdout

    size = ("--set", f"width={width}", "--set", f"height={height}")
    headless = run(tmp_path, VIEWER, *scene, *size, "--headless", "-o", "headless.png")
    assert (headless.returncode, headless.stderr) == (0, "")
    drawn = read_png(tmp_path / "headless.png")
    opaque = drawn[..., 3] == 255
    assert 0.1 < opaque.mean() < 0.9  # one sample a pixel: shapes and background, nothing between
    assert not drawn[~opaque].any()
    assert np.array_equal(shown[opaque], drawn[opaque])
    assert (shown[~opaque] == [*map(srgb_byte, BACKGROUND), 255]).all()


@pytest.mark.gl
@pytest.mark.parametrize(
    "options",
    [
        (),
        ("--technique", "exact", "--param", "bias=0.2", "--light", "-.5,.3,-.8"),
        ("--param", "layers=5", "--param", "split=hybrid", "--param", "split_ratio=.3"),
        ("--up", "y"),
        ("triangle.obj", "--light", "0,1,-1"),
    ],
    ids=lambda options: options[0] if options else "default",
)
def test_without_a_window_the_picture_is_the_commands(
    tmp_path: pathlib.Path, options: tuple[str, ...]
) -> None:
    (tmp_path / "triangle.obj").write_text(TRIANGLE)
    ours = ("--set", "width=48", "--set", "height=32", "--set", "map_size=32")
    theirs = ("--size", "48x32", "--map-size", "32")
    demo = run(tmp_path, VIEWER, DEMO, *options, *ours, "--headless", "-o", "demo.png")
    assert (demo.returncode, demo.stderr) == (0, "")
    command = (sys.executable, "-m", "pyopacity", "render")
    other = run(tmp_path, *command, DEMO, *options, *theirs, "-o", "command.png")
    assert (other.returncode, other.stderr) == (0, "")

    pixels = read_png(tmp_path / "demo.png")
    assert pixels.shape == (32, 48, 4)
    assert np.array_equal(pixels, read_png(tmp_path / "command.png"))
    assert pixels[..., 3].max() == 255
    # Transparent behind everything; with --up y one looks down, and the ground fills the picture.
    assert pixels[..., 3].min() == (255 if "--up" in options else 0)


@pytest.mark.gl
def test_without_a_window_every_pass_is_reported(tmp_path: pathlib.Path) -> None:
    small = ("--set", "width=16", "--set", "height=16", "--set", "map_size=16")
    result = run(tmp_path, VIEWER, DEMO, *small, "--headless", "-o", "a.png")
    assert result.returncode == 0
    assert "lighting" in result.stdout and " ran " in result.stdout
    assert "a.png: 16x16 on " in result.stdout


# ---- what is refused ----

HEADLESS = (DEMO, "--headless", "-o", "a.png")


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (("--nope",), "--nope"),
        (("--headless",), "-o"),
        (("--headless", "-o"), "-o"),
        (("--frames",), "--frames"),
        (("--frames", "x"), "--frames"),
        (("--frames", "-1"), "--frames"),
        (("--frames", "0"), "--frames"),
        (("--frames", "3x"), "--frames"),
        (("--frames", "1000000001"), "1..1000000000"),
        (("--up", "w"), "--up"),
        (("--light", "1,2"), "--light"),
        (("--light", "1,2,3,4"), "--light"),
        ((*HEADLESS, "--light", "0,0,0"), "direction"),
        (("--param", "layers"), "--param"),
        (("--set", "=5"), "--set"),
        ((*HEADLESS, "--technique", "exakt"), '"exact"'),
        ((*HEADLESS, "--param", "layesr=8"), '"layers"'),
        ((*HEADLESS, "--param", "layers=4000"), "1..64"),
        ((*HEADLESS, "--set", "map_sise=8"), '"map_size"'),
        ((*HEADLESS, "--set", "width=0"), "1..16384"),
        (("nothing.hair", "--headless", "-o", "a.png"), "nothing.hair"),
        (("nothing.bmp", "--headless", "-o", "a.png"), ".hair"),
    ],
)
def test_bad_usage_is_one_line_with_the_fix(
    tmp_path: pathlib.Path, arguments: tuple[str, ...], named: str
) -> None:
    result = run(tmp_path, VIEWER, *arguments)
    assert (result.returncode, result.stdout) == (2, ""), result.stderr
    assert len(result.stderr.splitlines()) == 1
    assert result.stderr.startswith("opacity_demo: ") and "; fix: " in result.stderr
    assert named in result.stderr
    assert list(tmp_path.iterdir()) == []


def test_no_memory_is_exit_code_4(tmp_path: pathlib.Path) -> None:
    little = f"ulimit -v 1000000; exec {VIEWER} 'demo:hair?segments=100000000' --headless -o a.png"
    result = run(tmp_path, "bash", "-c", little)
    assert (result.returncode, result.stdout) == (4, ""), result.stderr
    assert len(result.stderr.splitlines()) == 1 and "; fix: " in result.stderr


@pytest.mark.gl
@pytest.mark.parametrize("output", ["no/such/folder/a.png", "a.bmp"])
def test_a_picture_that_cannot_be_saved_is_refused(tmp_path: pathlib.Path, output: str) -> None:
    small = ("--set", "width=16", "--set", "height=16", "--set", "map_size=16")
    result = run(tmp_path, VIEWER, DEMO, *small, "--headless", "-o", output)
    assert result.returncode == 2 and len(result.stderr.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


def test_no_display_is_exit_code_3(tmp_path: pathlib.Path) -> None:
    result = run(tmp_path, VIEWER, DEMO)
    assert (result.returncode, result.stdout) == (3, "")
    assert len(result.stderr.splitlines()) == 1 and "; fix: " in result.stderr
    assert "DISPLAY" in result.stderr


def test_no_context_is_exit_code_3(tmp_path: pathlib.Path) -> None:
    result = run(tmp_path, VIEWER, *HEADLESS, OPACITY_EGL_DEVICE="97")
    assert (result.returncode, result.stdout) == (3, "")
    assert len(result.stderr.splitlines()) == 1 and "; fix: " in result.stderr
    nothing = run(tmp_path, VIEWER, *HEADLESS, OPACITY_LIBEGL="/nonexistent/libEGL.so.1")
    assert nothing.returncode == 3 and len(nothing.stderr.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []
