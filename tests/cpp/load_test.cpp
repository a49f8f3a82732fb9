#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include "opacity/core/error.hpp"
#include "opacity/io/load.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/strands.hpp"
#include "scratch_folder.hpp"

using namespace opacity;
using doctest::Approx;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

template <class T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// A .hair file written field by field; each may lie.
struct HairFile {
    std::string magic = "HAIR";
    std::uint32_t strands = 2, points = 5, arrays = 31, default_segments = 9;
    float thickness = 0.2f, transparency = 0.25f;
    float3 color{0.1f, 0.2f, 0.3f};
    std::vector<std::uint16_t> segments{1, 2};
    std::vector<float> xyz{0, 0, 0, 1, 0, 0, 5, 0, 0, 6, 0, 0, 7, 0, 0};
    std::vector<float> widths{0.1f, 0.2f, 0.3f, 0.4f, 0.5f};
    std::vector<float> transparencies{0, 0.25f, 0.5f, 0.75f, 1};
    std::vector<float> colors = std::vector<float>(15, 0.5f);

    std::string bytes() const {
        std::string result = magic;
        for (const std::uint32_t field : {strands, points, arrays, default_segments})
            append(result, field);
        append(result, thickness);
        append(result, transparency);
        append(result, color);
        result.resize(128);
        if (arrays & 1)
            for (const std::uint16_t s : segments) append(result, s);
        if (arrays & 2) append_all(result, xyz);
        if (arrays & 4) append_all(result, widths);
        if (arrays & 8) append_all(result, transparencies);
        if (arrays & 16) append_all(result, colors);
        return result;
    }
    static void append_all(std::string& bytes, const std::vector<float>& values) {
        for (const float value : values) append(bytes, value);
    }
};

// The message of the FileFormatError that loading `content` gives; empty when it loads.
std::string refusal(const ScratchFolder& folder, const std::string& name,
                    const std::string& content) {
    const auto path = folder.write(name, content);
    return message_of<FileFormatError>([&] { load(path.string()); });
}

std::vector<std::shared_ptr<Mesh>> meshes(const ScratchFolder& folder, const std::string& content) {
    std::vector<std::shared_ptr<Mesh>> result;
    for (const ShapePtr& shape : load(folder.write("a.obj", content).string())) {
        result.push_back(std::dynamic_pointer_cast<Mesh>(shape));
        REQUIRE(result.back());
    }
    return result;
}

std::shared_ptr<Strands> strands_of(const std::vector<ShapePtr>& shapes) {
    REQUIRE(!shapes.empty());
    auto strands = std::dynamic_pointer_cast<Strands>(shapes[0]);
    REQUIRE(strands);
    return strands;
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

// Real models, where this machine has them.
std::filesystem::path real_file(const std::string& name) {
    const char* folder = std::getenv("PYOPACITY_DATA");
    const std::filesystem::path data =
        folder ? folder
               : std::filesystem::path{OPACITY_SOURCE_DIR}.parent_path() / "shared" / "data";
    if (std::filesystem::exists(data / name)) return data / name;
    MESSAGE("skipped, no file: " << (data / name).string());
    return {};
}

}  // namespace

TEST_CASE("a .hair file with every array") {
    const ScratchFolder folder;
    const auto hair = strands_of(load(folder.write("a.hair", HairFile{}.bytes()).string()));
    CHECK(hair->offsets() == std::vector<std::int64_t>{0, 2, 5});
    CHECK(hair->points()[2] == double3{5, 0, 0});
    CHECK(hair->width() == std::vector<float>{0.1f, 0.2f, 0.3f, 0.4f, 0.5f});
    CHECK(hair->opacity() == std::vector<float>{1, 0.75f, 0.5f, 0.25f, 0});
    CHECK(hair->color() == std::vector<float3>(5, float3{0.5f, 0.5f, 0.5f}));
}

TEST_CASE("a .hair file of points only takes the header's defaults") {
    const ScratchFolder folder;
    HairFile file;
    file.arrays = 2, file.strands = 1, file.default_segments = 4;
    const auto hair = strands_of(load(folder.write("a.HAIR", file.bytes()).string()));
    CHECK(hair->offsets() == std::vector<std::int64_t>{0, 5});
    CHECK(hair->width() == std::vector<float>{0.2f});
    CHECK(hair->opacity() == std::vector<float>{0.75f});
    CHECK(hair->color() == std::vector<float3>{{0.1f, 0.2f, 0.3f}});
}

TEST_CASE("every combination of arrays is read in its place") {
    const ScratchFolder folder;
    for (std::uint32_t arrays = 2; arrays < 32; ++arrays) {
        if (!(arrays & 2)) continue;
        HairFile file;
        file.arrays = arrays;
        if (!(arrays & 1)) file.strands = 1, file.default_segments = 4;
        const auto hair = strands_of(load(folder.write("a.hair", file.bytes()).string()));
        CHECK(hair->points()[4] == double3{7, 0, 0});
        CHECK(hair->width().size() == (arrays & 4 ? 5 : 1));
        CHECK(hair->opacity().back() == (arrays & 8 ? 0.f : 0.75f));
        CHECK(hair->color()[0][0] == (arrays & 16 ? 0.5f : 0.1f));
    }
}

TEST_CASE("a .hair file cut anywhere, or with bytes too many, is refused with both sizes") {
    const ScratchFolder folder;
    const std::string whole = HairFile{}.bytes();
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const std::string message = refusal(folder, "cut.hair", whole.substr(0, size));
        CHECK(contains(message, "cut.hair"));
        CHECK(contains(message, std::to_string(size)));
    }
    const std::string message = refusal(folder, "long.hair", whole + "x");
    CHECK(contains(message, std::to_string(whole.size() + 1)));
    CHECK(contains(message, std::to_string(whole.size())));
}

TEST_CASE("a .hair header that lies is refused before it costs memory") {
    const ScratchFolder folder;
    const auto with = [&](auto change) {
        HairFile file;
        change(file);
        return refusal(folder, "lie.hair", file.bytes());
    };
    const std::uint32_t billions = 0xFFFF'FFFF;
    CHECK(contains(with([&](HairFile& f) { f.points = billions; }), "announces 137438"));
    CHECK(contains(with([&](HairFile& f) { f.strands = billions; }), "announces"));
    CHECK(contains(with([&](HairFile& f) { f.segments = {1, 3}; }), "6 points"));
    CHECK(contains(with([&](HairFile& f) { f.magic = "HARE"; }), "HAIR"));
    CHECK(contains(with([&](HairFile& f) { f.arrays = 29; }), "no points"));
    CHECK(contains(with([&](HairFile& f) { f.arrays = 63; }), "unknown"));
    CHECK(!with([&](HairFile& f) { f.arrays = 2, f.default_segments = billions; }).empty());
    CHECK(!with([&](HairFile& f) {
               f.arrays = 2, f.default_segments = f.strands = billions;
           }).empty());
}

TEST_CASE("a bad number in a .hair file is named by array and index") {
    const ScratchFolder folder;
    const auto with = [&](auto change) {
        HairFile file;
        change(file);
        return refusal(folder, "bad.hair", file.bytes());
    };
    CHECK(contains(with([](HairFile& f) { f.xyz[3 * 4] = not_a_number; }), "point[4]"));
    CHECK(contains(with([](HairFile& f) { f.widths[2] = -1; }), "thickness[2]"));
    CHECK(contains(with([](HairFile& f) { f.transparencies[1] = 1.5f; }), "transparency[1] = 1.5"));
    CHECK(contains(with([](HairFile& f) { f.colors[5] = not_a_number; }), "colour[1]"));
    CHECK(contains(with([](HairFile& f) { f.arrays = 27, f.thickness = not_a_number; }),
                   "default thickness"));
    // A default that an array stands in for is not read.
    CHECK(with([](HairFile& f) { f.thickness = not_a_number; }).empty());
}

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

TEST_CASE("damaged bytes load or are refused, and never do anything else") {
    const ScratchFolder folder;
    folder.write("m.mtl", "newmtl a\nKd 1 0 0\n");
    const std::string obj =
        "mtllib m.mtl\n" + square +
        "vn 0 0 1\nvt 0 0\nusemtl a\nf 1//1 2//1 3//1\nf 1/1/1 3/1/1 -1/1/1\nf 1 2 \\\n3 4\n";
    std::mt19937 random{20240607};
    for (const auto& [name, whole] :
         {std::pair{"m.hair", HairFile{}.bytes()}, std::pair{"m.obj", obj}}) {
        int refused = 0;
        for (int round = 0; round < 2000; ++round) {
            std::string damaged = whole;
            for (std::uint32_t hits = 1 + random() % 4; hits > 0; --hits)
                damaged[random() % damaged.size()] = char(random() % 256);
            if (random() % 4 == 0) damaged.resize(random() % (damaged.size() + 1));
            refused += !refusal(folder, name, damaged).empty();
        }
        CHECK(refused > 200);
        CHECK(refused < 2000);
    }
    for (std::size_t size = 0; size < obj.size(); ++size)
        refusal(folder, "m.obj", obj.substr(0, size));
}

TEST_CASE("real hair is what its index says") {
    const auto path = real_file("hair/straight.hair");
    if (path.empty()) return;
    const auto hair = strands_of(load(path.string()));
    CHECK(hair->strand_count() == 10'000);
    CHECK(hair->segments().size() == 150'000);
    CHECK(hair->width() == std::vector{0.1f});
    CHECK(hair->opacity()[0] == Approx(1.0 - 0.3558).epsilon(1e-3));
    CHECK(hair->color().size() == hair->points().size());
    // Roots lie on a head, which the index gives as the sphere that fits it best.
    double mean_radius = 0.0;
    for (std::size_t strand = 0; strand < hair->strand_count(); ++strand) {
        const double3 root = hair->points()[std::size_t(hair->offsets()[strand])];
        mean_radius += std::hypot(root[0] + 0.06, root[1] + 0.23, root[2] - 38.63);
    }
    mean_radius /= double(hair->strand_count());
    CHECK(mean_radius == Approx(20.45).epsilon(0.005));
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
    CHECK(is(triangles("foliage/urtica_dioica_1.obj", 3), 12'159));
}
