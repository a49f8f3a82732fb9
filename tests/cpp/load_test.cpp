#include <doctest/doctest.h>

#include "load_help.hpp"
#include "opacity/scene/mesh.hpp"

using namespace opacity;

TEST_CASE("what is not a readable file is refused by name") {
    const ScratchFolder folder;
    for (const char* suffix : {".hair", ".obj"}) {
        const auto missing = folder.file(std::string{"missing"} + suffix);
        const std::string message = message_of<FileFormatError>([&] { load(missing.string()); });
        CHECK(contains(message, "does not exist"));
        CHECK(contains(message, missing.string()));
        const auto directory = folder.file(std::string{"folder"} + suffix);
        std::filesystem::create_directory(directory);
        CHECK(
            contains(message_of<FileFormatError>([&] { load(directory.string()); }), "not a file"));
        CHECK(!refusal(folder, std::string{"empty"} + suffix, "").empty());
    }
    CHECK(contains(refusal(folder, "a.fbx", "x"), ".hair, .obj"));
    CHECK(contains(message_of<FileFormatError>([] { load(""); }), ".hair, .obj"));
}

TEST_CASE("real models are what their index says") {
    const auto triangles = [](const std::string& name, std::size_t parts) {
        const auto path = real_file(name);
        if (path.empty()) return std::size_t{0};
        std::size_t sum = 0;
        const auto shapes = load(path.string());
        CHECK(shapes.size() == parts);
        for (const ShapePtr& shape : shapes)
            sum += dynamic_cast<Mesh&>(*shape).triangles().size() / 3;
        return sum;
    };
    const auto is = [](std::size_t found, std::size_t right) {
        return found == 0 || found == right;
    };
    CHECK(is(triangles("opaque/bear_body.obj", 1), 57'784));
    CHECK(is(triangles("opaque/ponytail_head.obj", 1), 17'894));
    CHECK(is(triangles("foliage/cs_selfshadow_tree.obj", 2), 3'702));
    CHECK(is(triangles("foliage/eztree_oak_large.obj", 2), 22'566));
    CHECK(is(triangles("foliage/cs_selfshadow_plant.obj", 1), 9'884));
    CHECK(is(triangles("foliage/cs_terrainf_tree.obj", 2), 712));
    CHECK(is(triangles("foliage/sanmiguel_tree_a_leaves.glb", 3), 151'981));
    CHECK(is(triangles("foliage/urtica_dioica_1.obj", 3), 12'159));
}
