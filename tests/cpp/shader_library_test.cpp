// Shader text: includes, line numbers that lead back to the file, hot reload.
#include "gl/shader_library.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "opacity/core/error.hpp"
#include "scratch_folder.hpp"

using opacity::gl::ExpandedShader;
using opacity::gl::ShaderLibrary;

namespace {

int count(const std::string& text, const std::string& part) {
    int found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

// What a preprocessor would number the line that holds `part`: "file:line".
std::string place_of(const ExpandedShader& shader, const std::string& part) {
    const std::size_t at = shader.text.find(part);
    REQUIRE(at != std::string::npos);
    const std::size_t directive = shader.text.rfind("#line ", at);
    std::size_t line = 0, index = 0;
    REQUIRE(std::sscanf(shader.text.c_str() + directive, "#line %zu %zu", &line, &index) == 2);
    line +=
        std::size_t(std::count(shader.text.begin() + directive, shader.text.begin() + at, '\n')) -
        1;
    return shader.files.at(index) + ":" + std::to_string(line);
}

}  // namespace

TEST_CASE("an include is replaced by its text, and lines keep their places") {
    ShaderLibrary library;
    library.add("test/main.glsl", "int first;\n#include \"test/part.glsl\"\nint second;\n");
    library.add("test/part.glsl", "\nint inner;\n");
    const ExpandedShader shader =
        library.expand("test/main.glsl", {{"LAYERS", "16"}, {"PASS_opacity", ""}});
    CHECK(shader.text.starts_with("#version 450 core\n#define LAYERS 16\n#define PASS_opacity\n"));
    CHECK(place_of(shader, "int first") == "test/main.glsl:1");
    CHECK(place_of(shader, "int inner") == "test/part.glsl:2");
    CHECK(place_of(shader, "int second") == "test/main.glsl:3");
}

TEST_CASE("a file counts once, and cycles end") {
    ShaderLibrary library;
    library.add("test/a.glsl", "#include \"test/b.glsl\"\n#include \"test/b.glsl\"\nint a;\n");
    library.add("test/b.glsl", "#include \"test/a.glsl\"\nint b;\n");
    const ExpandedShader shader = library.expand("test/a.glsl");
    CHECK(count(shader.text, "int a;") == 1);
    CHECK(count(shader.text, "int b;") == 1);
}

TEST_CASE("an include in a branch that may be skipped is there for the next branch too") {
    ShaderLibrary library;
    library.add("test/main.glsl",
                "#ifdef PASS_a\n#include \"test/part.glsl\"\n#endif\n#ifdef PASS_b\n"
                "#  include \"test/part.glsl\"\nint after;\n#endif\nint end;\n");
    library.add("test/part.glsl", "int part;\nint more;\n");
    const ExpandedShader shader = library.expand("test/main.glsl");
    CHECK(count(shader.text, "int part;") == 2);  // the guard around them leaves the compiler one
    CHECK(count(shader.text, "#ifndef INCLUDED_FILE_1\n") == 2);
    CHECK(place_of(shader, "int after") == "test/main.glsl:6");
    CHECK(place_of(shader, "int end") == "test/main.glsl:8");
}

TEST_CASE("an alias stands for a file") {
    ShaderLibrary library;
    library.add("test/main.glsl", "#include \"technique.glsl\"\n");
    library.add("test/deep.glsl", "float shadow;\n");
    const ExpandedShader shader =
        library.expand("test/main.glsl", {}, {{"technique.glsl", "test/deep.glsl"}});
    CHECK(place_of(shader, "float shadow") == "test/deep.glsl:1");
}

TEST_CASE("a missing include names the line and the nearest path") {
    ShaderLibrary library;
    library.add("test/main.glsl", "// nothing\n#include \"test/prat.glsl\"\n");
    library.add("test/part.glsl", "");
    try {
        library.expand("test/main.glsl");
        FAIL("expanded a missing include");
    } catch (const opacity::ShaderError& error) {
        CHECK(error.problem().find("test/main.glsl:2") != std::string::npos);
        CHECK(error.fix().find("test/part.glsl") != std::string::npos);
    }
    library.add("test/main.glsl", "#include lib\n");
    CHECK_THROWS_AS(library.expand("test/main.glsl"), opacity::ShaderError);
    CHECK_THROWS_AS(library.text("test/mian.glsl"), opacity::ShaderError);
}

TEST_CASE("compilers' messages get file names") {
    const ExpandedShader shader{"", {"main.glsl", "lib/deposit.glsl"}};
    CHECK(shader.with_file_names("1:12(7): error: x") == "lib/deposit.glsl:12: error: x\n");
    CHECK(shader.with_file_names("0(3) : error C0000: x") == "main.glsl:3 : error C0000: x\n");
    CHECK(shader.with_file_names("ERROR: 1:4: x\nplain") ==
          "ERROR: lib/deposit.glsl:4: x\nplain\n");
    CHECK(shader.with_file_names("").empty());
}

TEST_CASE("the embedded table holds still") {
    ShaderLibrary library{""};
    const auto revision = library.revision();
    CHECK(library.revision() == revision);
    library.add("test/new.glsl", "int x;");
    const auto moved = library.revision();
    CHECK(moved != revision);
    library.add("test/new.glsl", "int x;");
    CHECK(library.revision() == moved);
    for (const std::string& path : library.paths()) CHECK_FALSE(path.empty());
}

TEST_CASE("a changed file moves the revision") {
    const ScratchFolder directory;
    std::filesystem::create_directory(directory.file("lib"));
    directory.write("lib/part.glsl", "int before;\n");
    ShaderLibrary library{directory.path()};
    const auto revision = library.revision();
    CHECK(library.revision() == revision);
    CHECK(library.text("lib/part.glsl") == "int before;\n");

    directory.write("lib/part.glsl", "int afterwards;\n");
    const auto changed = library.revision();
    CHECK(changed != revision);
    CHECK(library.revision() == changed);
    CHECK(library.text("lib/part.glsl") == "int afterwards;\n");

    directory.write("another.glsl", "");
    CHECK(library.revision() != changed);
    CHECK(library.paths() == std::vector<std::string>{"another.glsl", "lib/part.glsl"});
}

TEST_CASE("OPACITY_SHADER_DIR names the directory, which must exist") {
    const ScratchFolder directory;
    directory.write("only.glsl", "int only;\n");
    setenv("OPACITY_SHADER_DIR", directory.path().c_str(), 1);
    CHECK(ShaderLibrary{}.paths() == std::vector<std::string>{"only.glsl"});
    setenv("OPACITY_SHADER_DIR", "/nonexistent", 1);
    CHECK_THROWS_AS(ShaderLibrary{}, opacity::ShaderError);
    unsetenv("OPACITY_SHADER_DIR");
}
