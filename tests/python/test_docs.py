"""What README and docs say can be done as it stands there."""

import pathlib
import re
import shlex
import struct
import subprocess
import sys

import numpy as np
import pytest

import pyopacity as po
from pyopacity import _native
from pyopacity.cli import text

ROOT = pathlib.Path(__file__).resolve().parents[2]
README = ROOT / "README.md"
PAGES = [README, *sorted((ROOT / "docs").rglob("*.md"))]

# Where a page may start the path of a source file.
SOURCE_ROOTS = ("", "cpp", "cpp/src", "cpp/include/opacity", "cpp/shaders")
# What docs/add_a_technique.md adds.
EXAMPLE, EXAMPLE_PARAMETER = "first_hit", "strength"


def blocks(page: pathlib.Path) -> list[tuple[str, str]]:
    """(language, content) of every fenced block."""
    return re.findall(r"^```(\w*)\n(.*?)^```", page.read_text("utf-8"), re.DOTALL | re.MULTILINE)


def prose(page: pathlib.Path) -> str:
    return re.sub(r"^```.*?^```", "", page.read_text("utf-8"), flags=re.DOTALL | re.MULTILINE)


def name_of(page: object) -> str:
    return str(page.relative_to(ROOT)) if isinstance(page, pathlib.Path) else ""


def run(cwd: pathlib.Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, *arguments], cwd=cwd, capture_output=True, text=True, timeout=300
    )


# ---- what can be run ----

PYTHON = [(page, code) for page in PAGES for language, code in blocks(page) if language == "python"]
COMMANDS = [
    (page, line.partition("#")[0].strip())
    for page in PAGES
    for language, code in blocks(page)
    if language in ("", "sh", "bash", "console")
    for line in code.splitlines()
    # Of plugins, which have to be built first: tests/python/test_plugins.py.
    if line.startswith("pyopacity ") and "--plugin" not in line
]


def test_there_are_examples() -> None:
    assert any(page == README for page, _ in PYTHON)
    assert {line.split()[1] for _, line in COMMANDS} >= {"render", "techniques", "info", "doctor"}


@pytest.mark.gl
@pytest.mark.parametrize(("page", "code"), PYTHON, ids=name_of)
def test_python_examples_run(tmp_path: pathlib.Path, page: pathlib.Path, code: str) -> None:
    result = run(tmp_path, "-W", "error", "-c", code)
    assert (result.returncode, result.stderr) == (0, "")
    for name in re.findall(r'save_image\("([^"]+)"', code):
        assert (tmp_path / name).stat().st_size > 0


def write_hair(path: pathlib.Path) -> None:
    """Two strands of four points in a cyHair file."""
    points = np.zeros((2, 4, 3), "<f4")
    points[..., 0] = [[0.0], [1.0]]
    points[..., 2] = np.arange(4)
    header = struct.pack("<4s4I5f88s", b"HAIR", 2, 8, 2, 3, 0.2, 0.5, 0.6, 0.4, 0.2, b"")
    path.write_bytes(header + points.tobytes())


@pytest.mark.gl
@pytest.mark.parametrize(("page", "line"), COMMANDS, ids=lambda value: name_of(value) or None)
def test_commands_run(tmp_path: pathlib.Path, page: pathlib.Path, line: str) -> None:
    arguments = shlex.split(line)[1:]
    for argument in arguments:
        if argument.endswith(".hair"):
            write_hair(tmp_path / argument)
    result = run(tmp_path, "-m", "pyopacity", *arguments)
    assert (result.returncode, result.stderr) == (0, "")
    if "-o" in arguments:
        assert (tmp_path / arguments[arguments.index("-o") + 1]).stat().st_size > 0


def test_targets_of_make_exist() -> None:
    targets = set(re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text("utf-8"), re.MULTILINE))
    for page in PAGES:
        # In code only: "to make a mistake" is no command.
        for target in re.findall(r"(?:^|`)make (\w+)", page.read_text("utf-8"), re.MULTILINE):
            assert target in targets, f"{name_of(page)}: make {target}"


# ---- what can be looked up ----


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_links_lead_to_files(page: pathlib.Path) -> None:
    words = prose(page)
    links = re.findall(r"\]\(([^)\s]+)\)", words) + re.findall(r'(?:src|href)="([^"]+)"', words)
    local = [link.partition("#")[0] for link in links if "://" not in link]
    missing = [link for link in local if link and not (page.parent / link).exists()]
    assert not missing


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_source_files_that_are_named_exist(page: pathlib.Path) -> None:
    spans = re.findall(r"`([\w.-]+/[\w./-]+\.(?:py|cpp|hpp|glsl|txt|md|cmake))`", prose(page))
    missing = [
        span
        for span in spans
        if EXAMPLE not in span and not any((ROOT / root / span).exists() for root in SOURCE_ROOTS)
    ]
    assert not missing


def test_the_readme_lists_the_registry() -> None:
    section = README.read_text("utf-8").partition("## Techniques")[2].partition("\n## ")[0]
    assert re.findall(r"^\| `(\w+)` \|", section, re.MULTILINE) == list(po.techniques())


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_parameters_that_are_named_take_the_value_beside_them(page: pathlib.Path) -> None:
    """`split = "auto"` in prose: some technique, or the renderer, has it and takes the value."""
    techniques = [_native.make_technique(name) for name in _native.technique_names()]
    owners = [_native.RenderSettings(), *techniques]
    value = r'"\w+"|-?[\d.]+|true|false'
    for name, given in re.findall(rf"`(?:--\w+ )?(\w+) ?= ?({value})`", prose(page)):
        if name == EXAMPLE_PARAMETER:
            continue
        having = [owner for owner in owners if name in {p.name for p in owner.parameters()}]
        assert having, f"nothing has {name}"
        # The same name may be of two techniques, with other words.
        assert any(takes(owner, name, given) for owner in having), f"nothing takes {name} = {given}"


def takes(owner: _native.ParamOwner, name: str, given: str) -> bool:
    try:
        owner.set(name, text.value(given.strip('"')))
    except po.ParameterError:
        return False
    return True


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_names_of_the_library_exist(page: pathlib.Path) -> None:
    """`po.name` and `pyopacity.name` in prose and examples."""
    for name in re.findall(r"\b(?:po|pyopacity)\.([a-z]\w+)\b(?!/)", page.read_text("utf-8")):
        assert hasattr(po, name), name
