"""The folder is the architecture: who may include whom, and how long a file gets."""

import pathlib
import re
from collections.abc import Iterator

import pytest

import pyopacity as po

ROOT = pathlib.Path(__file__).resolve().parents[2]
CPP = ROOT / "cpp"

# docs/architecture.md: includes point only to the left. What comes last uses all of them.
ROOMS = ["core", "scene", "io", "rays", "map", "gl", "graph", "techniques", "render"]
CONSUMERS = ["bindings", "demo"]
WITHOUT_OPENGL = ["core", "scene", "io", "rays", "map", "graph", "techniques"]

# Public headers that lie in no room: each belongs beside the last room that it includes.
ROOM_OF_HEADER = {
    "trace.hpp": "rays",
    "look_up.hpp": "techniques",
    "technique.hpp": "techniques",
    "technique_description.hpp": "techniques",
    "plugin.hpp": "techniques",
    "render_settings.hpp": "render",
    "renderer.hpp": "render",
    "opacity.hpp": "demo",
}

# version() is declared in the umbrella header and defined beside what has no room to the left.
ALLOWED = {("cpp/src/core/version.cpp", "opacity/opacity.hpp")}

MOST_LINES = 400
MOST_LINES_OF_A_PUBLIC_HEADER = 150


def relative(path: pathlib.Path) -> str:
    return path.relative_to(ROOT).as_posix()


def files(*folders: str, suffixes: str) -> list[pathlib.Path]:
    found = [path for folder in folders for path in (ROOT / folder).rglob("*")]
    return sorted(path for path in found if path.suffix in suffixes.split())


SOURCES = files("cpp/include", "cpp/src", "cpp/demo", suffixes=".cpp .hpp")


def rank(room: str) -> int:
    return len(ROOMS) if room in CONSUMERS else ROOMS.index(room)


def room_of(path: str) -> str:
    """The room of a file, from its path below cpp/, or as it stands in an #include."""
    parts = pathlib.PurePosixPath(path.removeprefix("include/").removeprefix("src/")).parts
    parts = parts[1:] if parts[0] == "opacity" else parts
    return ROOM_OF_HEADER[parts[0]] if len(parts) == 1 else parts[0]


def includes(path: pathlib.Path) -> Iterator[tuple[str, str]]:
    """(kind, file) of each: kind is < or "."""
    text = path.read_text("utf-8")
    yield from re.findall(r'^\s*#\s*include\s*(["<])([^">]+)[">]', text, re.MULTILINE)


def is_public(path: pathlib.Path) -> bool:
    return relative(path).startswith("cpp/include/")


def test_every_file_lies_in_a_room() -> None:
    rooms = {room_of(path.relative_to(CPP).as_posix()) for path in SOURCES}
    assert rooms == {*ROOMS, *CONSUMERS}
    order = "  ->  ".join(ROOMS)
    assert order in (ROOT / "docs/architecture.md").read_text("utf-8")


@pytest.mark.parametrize("path", SOURCES, ids=relative)
def test_includes_point_to_the_left(path: pathlib.Path) -> None:
    room = room_of(path.relative_to(CPP).as_posix())
    for kind, included in includes(path):
        beside = "/" not in included and (path.parent / included).exists()
        if kind == "<" or beside or (relative(path), included) in ALLOWED:
            continue
        other = room_of(included)
        assert rank(other) <= rank(room), f"{room} includes {included}"
        assert other not in CONSUMERS or room in (other, *CONSUMERS), included
        if room in WITHOUT_OPENGL:
            assert other != "gl", f"{room} knows no OpenGL, and includes {included}"


@pytest.mark.parametrize("path", SOURCES, ids=relative)
def test_opengl_is_included_where_it_is_known(path: pathlib.Path) -> None:
    room = room_of(path.relative_to(CPP).as_posix())
    opengl = {"glad", "GL", "GLES3", "EGL", "KHR", "GLFW"}
    hidden = {*opengl, "glm", "stb", "pybind11"}  # no user of the library needs their headers
    for _, included in includes(path):
        library = included.partition("/")[0]
        if room in WITHOUT_OPENGL:
            assert library not in opengl, included
        if is_public(path) or room == "demo":
            assert library not in hidden, included


@pytest.mark.parametrize("path", files("cpp/demo", suffixes=".cpp .hpp"), ids=relative)
def test_the_demo_includes_public_headers_only(path: pathlib.Path) -> None:
    for kind, included in includes(path):
        public = (CPP / "include" / included).exists()
        assert kind == "<" or public or (path.parent / included).exists(), included


@pytest.mark.parametrize("path", [path for path in SOURCES if path.suffix == ".hpp"], ids=relative)
def test_headers_are_included_once_and_say_what_they_are(path: pathlib.Path) -> None:
    lines = path.read_text("utf-8").splitlines()
    assert lines[0].startswith("// ")
    assert "#pragma once" in lines


def test_files_are_short() -> None:
    folders = ("cpp", "python", "tests", "benchmarks", "scripts", "docs")
    lengths = {
        relative(path): len(path.read_text("utf-8").splitlines())
        for path in files(*folders, suffixes=".cpp .hpp .glsl .py .pyi")
    }
    assert len(lengths) > 100
    assert {name: length for name, length in lengths.items() if length > MOST_LINES} == {}
    headers = {name: n for name, n in lengths.items() if name.startswith("cpp/include/")}
    assert {k: n for k, n in headers.items() if n > MOST_LINES_OF_A_PUBLIC_HEADER} == {}


def test_the_registry_names_every_technique_once() -> None:
    folder = CPP / "src/techniques"
    lines = (folder / "CMakeLists.txt").read_text("utf-8")
    registered = re.findall(r"^opacity_add_technique\((\w+)( DELEGATES)?\)", lines, re.MULTILINE)
    assert [name for name, _ in registered] == list(po.techniques())
    shared = {"registry", "technique", "layered", "drawn_layers", "layers_on_cpu", "histogram"}
    shared |= {"split_search", "local_splits", "smoothing", "packed_lists", "fragment_lists"}
    shared |= {"depth_bounds", "own_corrected", "clusters_on_cpu", "texel_spans", "sampled_texels"}
    shared |= {"coefficient_maps", "coefficients_on_cpu", "prefilter"}
    shared |= {"bounded_layers", "transmittance_planes"}
    shared |= {"scatter", "scattered_layers", "caster_sizes"}
    shared |= {"plugin", "scripted_technique", "description_check", "description_words"}
    for place, suffix in (
        (folder, ".hpp"),
        (folder, ".cpp"),
        (CPP / "shaders/techniques", ".glsl"),
    ):
        stems = {path.stem for path in place.iterdir() if path.suffix == suffix}
        own = {name for name, delegates in registered if suffix != ".glsl" or not delegates}
        assert stems - shared == own, place


def test_nothing_else_names_a_technique_that_is_not_the_default() -> None:
    """A new technique is three files and one line: no list of them stands anywhere else."""
    # "auto" is a value of many parameters, too.
    names = [name for name in po.techniques() if name not in ("bounding_opacity_maps", "auto")]
    own = {
        f"cpp/src/techniques/{name}{suffix}"
        for name in (*names, "auto")
        for suffix in (".hpp", ".cpp")
    }
    own |= {"python/pyopacity/technique.py"}  # the two ends of every comparison
    own |= {"python/pyopacity/benchmark/ways.py"}  # the papers' as published, and ours
    own |= {"python/pyopacity/stress/exceptions.py"}  # what cannot hold by a technique's nature
    # "exact" is a way of compositing, too.
    own |= {"cpp/include/opacity/render_settings.hpp", "cpp/src/render/scene_lists.cpp"}
    code = [*SOURCES, *files("python", suffixes=".py .pyi")]
    naming = [
        relative(path)
        for path in code
        if relative(path) not in own
        and any(f'"{name}"' in path.read_text("utf-8") for name in names)
    ]
    assert naming == []
