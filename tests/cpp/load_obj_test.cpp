#include <doctest/doctest.h>

#include "load_help.hpp"
#include "opacity/scene/mesh.hpp"

using namespace opacity;

namespace {

std::vector<std::shared_ptr<Mesh>> meshes(const ScratchFolder& folder, const std::string& content) {
    return all<Mesh>(load(folder.write("a.obj", content).string()));
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("an .obj's corners in every notation are the same square") {
    const ScratchFolder folder;
    const std::string extras = "vt 0 0\nvn 0 0 2\n";
    for (const char* face :
         {"f 1 2 3 4", "f -4 -3 -2 -1", "f 1/1 2/1 3/1 4/1", "f 1//1 2//-1 3//1 4//1",
          "f 1/1/1 2/1/1 3/1/1 4/1/1", "f 1// 2// 3/ 4", "f 1 2 \\\n 3\\\r\n 4",
          "f\t1 2 3 4   # a square", "f 1 2 3 4\r"}) {
        const auto result = meshes(folder, square + extras + face + std::string{"\n"});
        REQUIRE(result.size() == 1);
        CHECK(result[0]->points().size() == 4);
        CHECK(result[0]->triangles() == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
        for (const float3& n : result[0]->normals()) CHECK(n == float3{0, 0, 1});
        CHECK(result[0]->opaque());
    }
}

TEST_CASE("the first statement counts, with or without a byte order mark and a last line break") {
    const ScratchFolder folder;
    for (const std::string& start :
         {std::string{}, std::string{"\xEF\xBB\xBF"}, std::string{"\r\n\n  "}}) {
        const auto result =
            meshes(folder, start + "v +7 1e1 -.5 1.0\nv 1 0 0 .1 .2 .3\nv 1 1 0\nf 1 2 3");
        CHECK(result[0]->points()[0] == double3{7, 10, -0.5});
    }
}

TEST_CASE("points with several normals are split, and those with none get one made") {
    const ScratchFolder folder;
    const auto split =
        meshes(folder, square + "vn 0 0 1\nvn 1 0 0\nf 1//1 2//1 3//1\nf 1//2 3//2 4//1\n");
    CHECK(split[0]->points().size() == 6);
    CHECK(split[0]->own_normals());
    const auto mixed = meshes(folder, square + "vn 1 0 0\nf 1//1 2 3\n");
    CHECK(mixed[0]->normals() == std::vector<float3>{{1, 0, 0}, {0, 0, 1}, {0, 0, 1}});
}

TEST_CASE("float64 keeps the digits of map coordinates") {
    const ScratchFolder folder;
    const auto far = meshes(folder, "v 500000.125 4000000.25 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    CHECK(far[0]->points()[0] == double3{500000.125, 4000000.25, 1});
}

TEST_CASE("each material in use is a mesh with its colour and opacity") {
    const ScratchFolder folder;
    folder.write(
        "my glass.mtl",
        "newmtl red\nKd 1 0 0\nnewmtl pane of glass\nd 0.25\nTr 0\nKd .5\nnewmtl veil\nTr 0.75\n"
        "newmtl halo\nd -halo 0.5\nnewmtl odd\nKd spectral x.rfl 1\n");
    const std::string materials = "mtllib my glass.mtl\n";
    const auto result =
        meshes(folder, square + materials +
                           "usemtl pane of glass\nf 1 2 3\nusemtl red\nf 1 3 4\n"
                           "usemtl unused\nusemtl veil\nf 1 2 4\nusemtl halo\nf 1 2 4\n"
                           "usemtl pane of glass\nf 2 3 4\nusemtl nowhere\nf 1 2 3\n");
    REQUIRE(result.size() == 5);
    CHECK(result[0]->opacity() == std::vector{0.25f});
    CHECK(result[0]->color() == std::vector<float3>{{0.5f, 0.5f, 0.5f}});
    CHECK(result[0]->triangles().size() == 6);
    CHECK(result[1]->color() == std::vector<float3>{{1, 0, 0}});
    CHECK(result[1]->opaque());
    CHECK(result[2]->opacity() == std::vector{0.25f});
    CHECK(result[3]->opacity() == std::vector{0.5f});
    CHECK(result[4]->opaque());
}

TEST_CASE("a missing .mtl leaves a grey model, and one outside the folder is not opened") {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder.file("inner"));
    folder.write("m.mtl", "newmtl red\nKd 1 0 0\n");
    folder.write("inner/m.mtl", "newmtl red\nKd 0 1 0\n");
    const auto color = [&](const std::string& name, const std::string& library) {
        const auto path =
            folder.write(name, square + "mtllib " + library + "\nusemtl red\nf 1 2 3\n");
        return load(path.string())[0]->color()[0];
    };
    const float3 grey{0.7f, 0.7f, 0.7f};
    CHECK(color("a.obj", "m.mtl") == float3{1, 0, 0});
    CHECK(color("a.obj", "none.mtl inner/m.mtl") == float3{0, 1, 0});
    CHECK(color("inner/a.obj", "../m.mtl") == grey);
    CHECK(color("inner/a.obj", "x/../../m.mtl") == grey);
    CHECK(color("inner/a.obj", folder.file("m.mtl").string()) == grey);
    CHECK(color("a.obj", "inner") == grey);
    CHECK(color("a.obj", "") == grey);
}

TEST_CASE("a bad .mtl is refused with its own name and line") {
    const ScratchFolder folder;
    const auto with = [&](const std::string& line) {
        folder.write("m.mtl", "newmtl a\n" + line + "\n");
        return refusal(folder, "a.obj", square + "mtllib m.mtl\nf 1 2 3\n");
    };
    CHECK(contains(with("Kd nan 0 0"), "m.mtl:2"));
    CHECK(contains(with("Kd -1 0 0"), "Kd is -1"));
    CHECK(contains(with("Kd 1 1"), "missing"));
    CHECK(contains(with("d 1.5"), "1.5"));
    CHECK(contains(with("Tr x"), "\"x\""));
}

TEST_CASE("a bad line of an .obj is named") {
    const ScratchFolder folder;
    const auto with = [&](const std::string& line) {
        return refusal(folder, "bad.obj", square + line);
    };
    for (const char* number :
         {"nan", "inf", "-inf", "1e999", "x", "1,5", "1e18x", "2e18", "", "0x10", "+-1"}) {
        const std::string message = with(std::string{"v 0 0 "} + number + "\nf 1 2 3\n");
        CAPTURE(number);
        CAPTURE(message);
        CHECK(contains(message, "bad.obj:5"));
    }
    CHECK(contains(with("f 1 2 9\n"), "\"9\" of 4"));
    for (const char* corner : {"0", "5", "-5", "x", "1x", "", "99999999999999999999", "1//1",
                               "1//x", "/1", "-9223372036854775808", "4294967297"})
        CHECK(!with(std::string{"f 1 2 "} + corner + "\n").empty());
    CHECK(contains(with("# comment\n\nf 1 2\n"), "bad.obj:7"));
    CHECK(contains(with("l 1 2\np 1\n"), "without a face"));
    CHECK(contains(with("vn 0 0 nan\nf 1 2 3\n"), "bad.obj:5"));
    CHECK(with("v 0 0 " + std::string(100'000, '9') + "\n").size() < 500);
}

TEST_CASE("a polygon of many corners is a fan of all its triangles") {
    const ScratchFolder folder;
    std::string text, face = "f";
    constexpr int corners = 20'000;
    for (int i = 1; i <= corners; ++i) {
        text += "v " + std::to_string(i) + " 0 0\n";
        face += " " + std::to_string(i);
    }
    const auto result = meshes(folder, text + face);
    CHECK(result[0]->triangles().size() == 3 * (corners - 2));
    CHECK(result[0]->triangles().back() == corners - 1);
}

TEST_CASE("a damaged .obj loads or is refused") {
    const ScratchFolder folder;
    folder.write("m.mtl", "newmtl a\nKd 1 0 0\n");
    const std::string whole =
        "mtllib m.mtl\n" + square +
        "vn 0 0 1\nvt 0 0\nusemtl a\nf 1//1 2//1 3//1\nf 1/1/1 3/1/1 -1/1/1\nf 1 2 \\\n3 4\n";
    check_damage(folder, "m.obj", whole);
    for (std::size_t size = 0; size < whole.size(); ++size)
        refusal(folder, "m.obj", whole.substr(0, size));
}
