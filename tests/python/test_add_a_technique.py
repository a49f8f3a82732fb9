"""docs/add_a_technique.md, done word for word in a copy of the sources."""

import os
import shutil
import sys
import sysconfig

import pytest

from guides import ADD_A_TECHNIQUE, ROOT, run
from guides import files as files_of

PROGRAM = """
#include <opacity/opacity.hpp>
#include <cstdio>
int main() {
    using namespace opacity;
    auto scene = std::make_shared<Scene>();
    scene->add(std::make_shared<Mesh>(Positions{std::vector<float>{-1, -1, 0, 1, -1, 0, 0, 1, 0}},
                                      std::vector<std::uint32_t>{0, 1, 2}));
    scene->shapes().front()->set_opacity({0.5f});
    scene->add(std::make_shared<DirectionalLight>(double3{0, 0, -1}));
    auto technique = std::shared_ptr<Technique>(make_technique("first_hit"));
    technique->param("strength").assign(2.0);
    Renderer renderer{scene, Camera::fit(*scene), technique};
    const auto t = renderer.transmittance(Positions{std::vector<double>{0, 0, 1, 0, 0, -1}});
    std::printf("%.4f %.4f\\n", t[0], t[1]);
}
"""


@pytest.mark.slow
def test_the_guide_adds_a_technique(needs_gl, tmp_path):
    copy = tmp_path / "copy"
    copy.mkdir()
    for name in ("cpp", "cmake"):
        shutil.copytree(ROOT / name, copy / name)
    shutil.copy(ROOT / "CMakeLists.txt", copy)
    files = files_of(ADD_A_TECHNIQUE)
    assert len(files) == 4
    for name, content in files.items():
        with (copy / name).open("a") as file:  # the registry gets a line, the others are new
            file.write(content)
    (tmp_path / "main.cpp").write_text(PROGRAM)

    # The folder and the compiler of the project's own build: ccache knows its objects.
    build = copy / "build" / "python"
    compiler = os.environ.get("CXX", sysconfig.get_config_var("CXX").split()[0])
    run(
        "cmake", "-S", copy, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
        f"-DPython_EXECUTABLE={sys.executable}", f"-DCMAKE_CXX_COMPILER={compiler}",
        "-DOPACITY_BUILD_DEMO=OFF", "-DOPACITY_BUILD_TESTS=OFF",
    )  # fmt: skip
    run("cmake", "--build", build, "--target", "opacity")
    library = next(build.rglob("libopacity.so"))
    program = tmp_path / "program"
    run(
        compiler, "-std=c++20", tmp_path / "main.cpp", "-I", copy / "cpp/include", library,
        f"-Wl,-rpath,{library.parent}", "-o", program,
    )  # fmt: skip
    # Half of the light passes the triangle; strength 2 squares it.
    assert run(program).split() == ["1.0000", "0.2500"]
