"""Plugins that are refused, and what is registered while the program runs in processes of its own.

Nothing that is registered ever leaves: a test that does so must not share its process with others.
"""

import json
import os
import shutil
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import guides
import pyopacity as po
from pyopacity._cmake import cmake_dir
from pyopacity.cli.main import main

HERE = Path(__file__).parent
FAULTY = HERE.parent / "plugin"
slow_build = [pytest.mark.slow, pytest.mark.skipif(not shutil.which("cmake"), reason="needs cmake")]


def write_first_hit(source: Path) -> None:
    """What docs/plugins.md tells to write: its own file, and those of docs/add_a_technique.md."""
    (source / "techniques").mkdir(parents=True)
    for name, content in guides.files(guides.ADD_A_TECHNIQUE).items():
        (source / "techniques" / Path(name).name).write_text(content)
    for name, content in guides.files(guides.PLUGINS).items():
        (source / name).write_text(content)


@pytest.fixture(scope="module")
def plugin(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The library of docs/plugins.md, made by its commands."""
    source = tmp_path_factory.mktemp("first_hit") / "source"
    write_first_hit(source)
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    listed = guides.run(
        "bash", "-ec", f"cd {source}\n{guides.block(guides.PLUGINS, 'sh')}", PATH=path
    )
    assert "\nfirst_hit\n" in listed
    return source / "build" / "first_hit.so"


@pytest.fixture(scope="module")
def faulty(tmp_path_factory: pytest.TempPathFactory) -> Path:
    source = tmp_path_factory.mktemp("faulty") / "plugin"
    shutil.copytree(FAULTY, source)
    return guides.build(source, str(cmake_dir()))


BY_HAND = """
#include "techniques/first_hit.hpp"
using opacity::techniques::FirstHit;
const char first_hit_glsl[] = "";
"""
CMAKE_BY_HAND = """
add_library(by_hand MODULE by_hand.cpp techniques/first_hit.cpp)
target_include_directories(by_hand PRIVATE .)
target_compile_definitions(by_hand PRIVATE OPACITY_INTERFACE="${opacity_INTERFACE}")
target_link_libraries(by_hand PRIVATE opacity::opacity)
"""


@pytest.fixture(params=["registering/plugin.py", "registering/described.py"])
def tests_apart(request: pytest.FixtureRequest) -> str:
    return str(HERE / request.param)


def pytest_apart(*arguments: str, **environment: str) -> str:
    path = os.pathsep.join([str(HERE), os.environ.get("PYTHONPATH", "")])
    return guides.run(
        sys.executable, "-m", "pytest", "-q", *arguments, PYTHONPATH=path, **environment
    )


class TestBuilt:
    pytestmark = slow_build

    def test_what_is_registered_is_like_any_other(
        self, needs_gl: None, plugin: Path, tests_apart: str
    ) -> None:
        pytest_apart(tests_apart, FIRST_HIT=str(plugin))

    def test_the_entry_point_may_be_written_by_hand(
        self, tmp_path: Path, python: Callable[..., object]
    ) -> None:
        write_first_hit(tmp_path / "source")
        (tmp_path / "source" / "by_hand.cpp").write_text(
            BY_HAND + guides.block(guides.PLUGINS, "cpp")
        )
        with (tmp_path / "source" / "CMakeLists.txt").open("a") as file:
            file.write(CMAKE_BY_HAND)
        folder = guides.build(tmp_path / "source", str(cmake_dir()))
        load = "import sys, pyopacity as po; print(*po.load_plugin(sys.argv[1]))"
        assert python("-c", load, str(folder / "libby_hand.so")).stdout == "first_hit\n"

    def test_the_command_line_takes_plugins(
        self, needs_gl: None, plugin: Path, tmp_path: Path, python: Callable[..., object]
    ) -> None:
        command = ("-m", "pyopacity")
        listed = python(*command, "techniques", "--json", "--plugin", str(plugin))
        assert json.loads(listed.stdout)["first_hit"]["parameters"]["strength"]["default"] == 1.0
        drawn = python(
            *command, "render", "demo:hair?segments=500", "--size", "32x24", "--map-size", "32",
            "--plugin", str(plugin), "--technique", "first_hit", "--param", "strength=2",
            "-o", str(tmp_path / "hit.png"), "--json",
        )  # fmt: skip
        passes = {row["name"]: row["status"] for row in json.loads(drawn.stdout)["passes"]}
        assert passes["first_hit/total"] == "ran"

    @pytest.mark.parametrize(
        ("fault", "what", "fix"),
        [
            ("no_entry", "no function opacity_plugin", "opacity_add_plugin"),
            ("other_headers", "headers of pyopacity 9.9.9", "build it again"),
            ("other_engine", "another copy of the engine", "build it again"),
            ("taken_name", 'already a technique "exact", the engine\'s own', "another name"),
        ],
    )
    def test_a_faulty_one_is_refused_and_leaves_nothing(
        self, faulty: Path, fault: str, what: str, fix: str
    ) -> None:
        before = list(po.techniques())
        for _ in range(2):
            with pytest.raises(po.PluginError) as error:
                po.load_plugin(faulty / f"{fault}.so")
            assert what in error.value.what and f"{fault}.so" in error.value.what
            assert fix in error.value.fix
        assert list(po.techniques()) == before

    def test_techniques_are_made_when_they_are_asked_for(
        self, faulty: Path, python: Callable[..., object]
    ) -> None:
        """Until then nobody sees that these are not what their names say."""
        script = """
import sys, pyopacity as po
assert po.load_plugin(sys.argv[1]) == ("something", "none")
for name in ("something", "none"):
    try:
        po.technique(name)
    except po.PluginError as error:
        print(error.what)
"""
        result = python("-c", script, str(faulty / "false_names.so"))
        assert result.returncode == 0, result.stderr
        something, none = result.stdout.splitlines()
        assert something.endswith('makes "nothing" for the name "something"')
        assert none.endswith('makes nothing for the name "none"')


@pytest.mark.parametrize(
    ("name", "content", "what"),
    [
        ("absent.so", None, "there is no file"),
        ("text.so", b"not a library", "does not open as a shared library"),
        ("empty.so", b"", "does not open as a shared library"),
        ("cut.so", b"\x7fELF\x02\x01\x01" + bytes(40), "does not open as a shared library"),
        ("", None, "there is no file"),
    ],
)
def test_a_file_that_is_no_library_is_refused(
    tmp_path: Path, name: str, content: bytes | None, what: str
) -> None:
    path = tmp_path / name
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(po.PluginError, match=what) as error:
        po.load_plugin(path)
    assert isinstance(error.value, ImportError) and error.value.fix


@pytest.mark.parametrize("path", [None, 3, "zero\0byte"])
def test_a_path_that_is_none_is_refused(path: object) -> None:
    with pytest.raises(po.ParameterError):
        po.load_plugin(path)  # type: ignore[arg-type]


def test_the_command_line_says_so_in_a_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["techniques", "--plugin", "absent.so"]) == 2
    assert capsys.readouterr().err.startswith("pyopacity: there is no file absent.so; fix: ")


# Four layers of even depth end before the last sheet of the ladder.
GENERIC = "four_layers and not ladder"


def passed(printed: str) -> int:
    return int(printed.rpartition(" passed")[0].split()[-1])


@pytest.mark.slow
def test_a_described_technique_passes_the_tests_of_all(needs_gl: None) -> None:
    tests = [str(HERE / f"test_{name}.py") for name in ("techniques", "api_technique")]
    assert passed(pytest_apart("-p", "registering.four_layers", *tests, "-k", GENERIC)) >= 3


@pytest.mark.slow
def test_a_described_technique_bears_the_stress_suite(needs_gl: None) -> None:
    suite = str(HERE / "registering" / "stress_of_four_layers.py")
    assert passed(pytest_apart("-p", "registering.four_layers", suite)) >= 30
