"""What the guides in docs/ say word for word, and the techniques that come out of it."""

import os
import re
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ADD_A_TECHNIQUE = ROOT / "docs" / "add_a_technique.md"
PLUGINS = ROOT / "docs" / "plugins.md"


def files(guide: Path) -> dict[str, str]:
    """File name -> content of every code block that follows a file's name."""
    pattern = r"^`([\w./]+)`\n\n```\w+\n(.*?)```"
    return dict(re.findall(pattern, guide.read_text("utf-8"), re.DOTALL | re.MULTILINE))


def block(guide: Path, language: str) -> str:
    """The one code block of a language that follows no file's name."""
    pattern = rf"(?<!`\n\n)^```{language}\n(.*?)^```"
    (content,) = re.findall(pattern, guide.read_text("utf-8"), re.DOTALL | re.MULTILINE)
    return content


def first_hit_shader() -> str:
    return files(ADD_A_TECHNIQUE)["cpp/shaders/techniques/first_hit.glsl"]


def register_four_layers() -> None:
    """Runs the example of docs/plugins.md up to its scene."""
    example = block(PLUGINS, "python").partition("scene =")[0]
    exec(compile(example, str(PLUGINS), "exec"), {})


def run(*command: object, **environment: str) -> str:
    result = subprocess.run(
        [str(part) for part in command],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, **environment},
    )
    assert result.returncode == 0, result.stdout[-4000:] + result.stderr[-4000:]
    return result.stdout


def build(source: Path, package: str) -> Path:
    """The folder of what CMake makes of a source folder with the installed package."""
    folder = source / "build"
    run("cmake", "-S", source, "-B", folder, "-G", "Ninja", f"-Dopacity_DIR={package}")
    run("cmake", "--build", folder)
    return folder
