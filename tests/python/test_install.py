"""What an installed wheel gives to others: a CMake package, and a program on the path."""

import importlib.metadata
import pathlib
import shutil
import subprocess
import sys
import sysconfig

import pytest

CONSUMER = pathlib.Path(__file__).parents[1] / "consumer"


def output_of(*command: str | pathlib.Path) -> str:
    result = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert result.returncode == 0, f"{command}\n{result.stdout}\n{result.stderr}"
    return result.stdout


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("cmake") is None, reason="needs cmake")
def test_cmake_package_builds_a_consumer(tmp_path: pathlib.Path) -> None:
    package = output_of(sys.executable, "-m", "pyopacity", "--cmake-dir").strip()
    output_of("cmake", "-S", CONSUMER, "-B", tmp_path, f"-Dopacity_DIR={package}")
    output_of("cmake", "--build", tmp_path)

    version = importlib.metadata.version("pyopacity")
    assert output_of(tmp_path / "consumer").split() == [version, "1", "2"]


def test_viewer_is_installed_and_finds_its_library() -> None:
    viewer = pathlib.Path(sysconfig.get_path("scripts")) / "opacity_demo"
    assert "--headless" in output_of(viewer, "--help")
