#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "load_help.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/particles.hpp"

using namespace opacity;
using doctest::Approx;

namespace {

// The same file in three encodings: numbers are written as their properties say.
struct PlyFile {
    enum Encoding { ascii, little, big } encoding;
    std::string text;  // the header after its format, and then the numbers

    template <class T>
    void add(T value) {
        if (encoding == ascii) {
            text += std::to_string(+value) + (sizeof(T) == 1 ? "\n" : " ");
            return;
        }
        std::string bytes;
        append(bytes, value);
        if (encoding == big) std::reverse(bytes.begin(), bytes.end());
        text += bytes;
    }
    std::string file() const {
        constexpr const char* names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
        return std::string{"ply\nformat "} + names[encoding] + " 1.0\ncomment a test\n" + text;
    }
};

const std::string vertex = "property float x\nproperty float y\nproperty float z\n";

// A quad behind an element that is of no use, with a normal, a colour and an alpha a vertex.
std::string quad(PlyFile::Encoding encoding) {
    PlyFile ply{encoding,
                "element junk 2\nproperty list uchar short a\nproperty double b\n"
                "element vertex 4\n" +
                    vertex +
                    "property list uchar uchar tags\n"
                    "property double nx\nproperty double ny\nproperty double nz\n"
                    "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                    "property uchar alpha\n"
                    "element face 1\nproperty uchar flags\n"
                    "property list uchar int vertex_indices\nend_header\n"};
    for (int junk = 0; junk < 2; ++junk) {
        ply.add(std::uint8_t(junk));
        for (int i = 0; i < junk; ++i) ply.add(std::int16_t(-1));
        ply.add(0.5);
    }
    for (int i = 0; i < 4; ++i) {
        for (const float x : {float(i == 1 || i == 2), float(i >= 2), 3.f}) ply.add(x);
        ply.add(std::uint8_t(0));
        for (const double n : {0.0, 0.0, 2.0}) ply.add(n);
        for (const int c : {255, 0, 188, 51 * i}) ply.add(std::uint8_t(c));
    }
    ply.add(std::uint8_t(7));
    ply.add(std::uint8_t(4));
    for (const std::int32_t corner : {0, 1, 2, 3}) ply.add(corner);
    return ply.file();
}

std::string cloud(const std::string& properties, const std::string& rows, int count) {
    return PlyFile{PlyFile::ascii, "element vertex " + std::to_string(count) + "\n" + vertex +
                                       properties + "end_header\n" + rows}
        .file();
}

template <class Kind>
std::shared_ptr<Kind> one(const ScratchFolder& folder, const std::string& content) {
    return all<Kind>(load(folder.write("a.ply", content).string())).at(0);
}

}  // namespace

TEST_CASE("a PLY's faces are a mesh, in every encoding") {
    const ScratchFolder folder;
    for (const auto encoding : {PlyFile::ascii, PlyFile::little, PlyFile::big}) {
        const auto mesh = one<Mesh>(folder, quad(encoding));
        CHECK(mesh->points().size() == 4);
        CHECK(mesh->points()[2] == double3{1, 1, 3});
        CHECK(mesh->triangles() == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
        CHECK(mesh->normals()[0] == float3{0, 0, 1});
        CHECK(mesh->opacity() == std::vector{0.f, 0.2f, 0.4f, 0.6f});
        CHECK(mesh->color()[0][0] == 1.f);
        CHECK(mesh->color()[0][2] == Approx(0.5029).epsilon(1e-3));
    }
}

TEST_CASE("a PLY cut anywhere is refused, and one of text unless the last number is what is cut") {
    const ScratchFolder folder;
    check_cuts(folder, "cut.ply", quad(PlyFile::little));
    check_cuts(folder, "cut.ply", quad(PlyFile::big));
    const std::string text = quad(PlyFile::ascii);
    check_cuts(folder, "cut.ply", text.substr(0, text.find_last_not_of(" \n")));
    for (const auto encoding : {PlyFile::ascii, PlyFile::little, PlyFile::big})
        check_damage(folder, "damaged.ply", quad(encoding));
}

TEST_CASE("a PLY without faces is particles that just touch, or of the radius that it has") {
    const ScratchFolder folder;
    const auto touching = one<Particles>(folder, cloud("", "0 0 0 2 0 0 2 2 0 0 2 0 0 2 0", 5));
    CHECK(touching->radius() == std::vector{1.f});
    CHECK(touching->points().size() == 5);
    CHECK(one<Particles>(folder, cloud("", "1 2 3", 1))->radius() == std::vector{0.5f});
    const auto sized = one<Particles>(
        folder, cloud("property float radius\nproperty float opacity\nproperty float red\n"
                      "property float green\nproperty float blue\nproperty uchar class\n",
                      "0 0 0 .5 .25 1 2 3 9\n1 0 0 .75 1 0 0 0 2\n", 2));
    CHECK(sized->radius() == std::vector{0.5f, 0.75f});
    CHECK(sized->opacity() == std::vector{0.25f, 1.f});
    CHECK(sized->color()[0] == float3{1, 2, 3});
}

TEST_CASE("strips of triangles are read, and float64 keeps the digits of map coordinates") {
    const ScratchFolder folder;
    const std::string corners =
        "property double x\nproperty double y\nproperty double z\nelement tristrips 1\n"
        "property list int int vertex_indices\nend_header\n"
        "500000.125 0 0 1 0 0 0 1 0 1 1 0\n8 0 1 2 3 -1 2 1 0\n";
    const auto mesh =
        one<Mesh>(folder, PlyFile{PlyFile::ascii, "element vertex 4\n" + corners}.file());
    CHECK(mesh->triangles() == std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3, 2, 1, 0});
    CHECK(mesh->points()[0][0] == 500000.125);
}

TEST_CASE("a PLY that lies is refused by name, before it costs memory") {
    const ScratchFolder folder;
    const auto refused = [&](const std::string& content) {
        return refusal(folder, "bad.ply", content);
    };
    const auto faces = [&](const std::string& face) {
        return refused(PlyFile{PlyFile::ascii, "element vertex 3\n" + vertex +
                                                   "element face 1\nproperty list uchar int "
                                                   "vertex_index\nend_header\n"
                                                   "0 0 0 1 0 0 0 1 0 " +
                                                   face}
                           .file());
    };
    CHECK(faces("3 0 1 2").empty());
    CHECK(contains(faces("3 0 1 3"), "vertex 3 of 3"));
    CHECK(contains(faces("3 0 1 -1"), "vertex -1"));
    CHECK(contains(faces("3 0 1 .5"), "vertex 0.5"));
    CHECK(contains(faces("2 0 1"), "2 corners"));
    CHECK(contains(faces("200 0 1 2"), "list"));
    CHECK(contains(faces("-3 0 1 2"), "list"));
    CHECK(contains(faces("x 0 1 2"), "\"x\""));

    CHECK(contains(refused(cloud("", "0 0 0", 2)), "announces 2"));
    CHECK(contains(refused(cloud("", "0 0 0", 2'000'000'000)), "announces"));
    CHECK(contains(refused(cloud("", "0 0 nan", 1)), "z = nan"));
    CHECK(contains(refused(cloud("", "0 2e18 0", 1)), "y = 2e+18"));
    CHECK(contains(refused(cloud("property float radius\n", "0 0 0 -1", 1)), "radius = -1"));
    CHECK(contains(refused(cloud("property float opacity\n", "0 0 0 1.5", 1)), "opacity = 1.5"));
    CHECK(contains(refused(cloud("property uchar alpha\n", "0 0 0 256", 1)), "alpha = 256"));
    CHECK(contains(refused(cloud("", "", 0)), "no vertices"));

    const auto header = [&](const std::string& line) {
        return refused("ply\nformat ascii 1.0\n" + line + "\nend_header\n0 0 0\n");
    };
    CHECK(contains(header("element vertex 1"), "announces"));
    CHECK(contains(header("element vertex 1\nproperty float x"), "x, y and z"));
    CHECK(contains(header("element vertex x"), "bad.ply:3"));
    CHECK(contains(header("element vertex"), "bad.ply:3"));
    CHECK(contains(header("property float x"), "bad.ply:3"));
    CHECK(contains(header("element vertex 1\nproperty quad x"), "\"quad\""));
    CHECK(contains(header("element face 1\nproperty list float int vertex_index"), "bad.ply:4"));
    CHECK(contains(header("element face 1\nproperty int vertex_index"), "without a list"));
    CHECK(contains(header("nonsense"), "nonsense"));
    CHECK(contains(refused("ply\nformat binary 1.0\nend_header\n"), "bad.ply:2"));
    CHECK(contains(refused("ply\nend_header\n"), "format"));
    CHECK(contains(refused("plain"), "header"));
}
