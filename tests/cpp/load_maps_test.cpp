// Pictures, and how an .obj hangs them on its meshes.
#include <doctest/doctest.h>

#include "io/picture_maps.hpp"
#include "load_help.hpp"
#include "opacity/scene/mesh.hpp"
#include "picture_file.hpp"

using namespace opacity;
using doctest::Approx;

namespace {

Picture decoded(const std::string& file) {
    return decode_picture(std::as_bytes(std::span{file}), "a picture");
}

std::string picture_refusal(const std::string& file) {
    return message_of<FileFormatError>([&] { decoded(file); });
}

// Left half covered, right half not.
const Texels half_covered{10, 20, 30, 255, 40, 50, 60, 0};

// A square that shows its picture once, of the material that the text makes.
struct Model {
    ScratchFolder folder;
    std::vector<std::string> warnings;

    std::shared_ptr<Mesh> mesh(const std::string& material) {
        folder.write("m.mtl", "newmtl a\n" + material + "\n");
        const auto path =
            folder.write("m.obj",
                         "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                         "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
        const Logger log = [&](LogLevel level, std::string_view message) {
            CHECK(level == LogLevel::warning);
            warnings.emplace_back(message);
        };
        return all<Mesh>(load(path.string(), log)).at(0);
    }
};

}  // namespace

TEST_CASE("colours are linear, alpha and greys are as they are stored") {
    PictureMaps maps{decoded(png_file(2, 1, 4, half_covered))};
    CHECK(maps.color()->width == 2);
    CHECK(maps.color()->height == 1);
    CHECK(maps.color()->channels == 3);
    CHECK(maps.color()->values[0] == Approx(0.003035).epsilon(1e-3));  // of 10
    CHECK(maps.color()->values[5] == Approx(0.045186).epsilon(1e-3));  // of 60
    CHECK(maps.alpha()->values == std::vector{1.f, 0.f});
    CHECK(maps.alpha_varies());
    CHECK(maps.color() == maps.color());

    PictureMaps grey{decoded(png_file(2, 1, 1, {0, 102}))};
    CHECK(grey.luminance()->values == std::vector{0.f, 0.4f});
    CHECK(grey.alpha() == grey.luminance());
    CHECK(grey.color()->values[3] == grey.color()->values[5]);
    CHECK(!grey.alpha_varies());

    PictureMaps rgb{decoded(png_file(1, 1, 3, {255, 0, 0}))};
    CHECK(rgb.luminance()->values[0] == Approx(0.2126));
    PictureMaps pair{decoded(png_file(2, 1, 2, {255, 51, 255, 51}))};
    CHECK(pair.alpha()->values == std::vector{0.2f, 0.2f});
    CHECK(!pair.alpha_varies());
}

TEST_CASE("a JPEG is read") {
    PictureMaps maps{decoded(jpeg_file(8, 8, 3, Texels(8 * 8 * 3, 188)))};
    CHECK(maps.color()->values[100] == Approx(0.5).epsilon(0.02));
    CHECK(!maps.has_alpha());
}

TEST_CASE("a picture cut anywhere is refused") {
    const Texels noise = [] {
        std::mt19937 random{1};
        Texels texels(16 * 16 * 3);
        for (auto& texel : texels) texel = static_cast<unsigned char>(random());
        return texels;
    }();
    for (const std::string& whole : {png_file(16, 16, 3, noise), jpeg_file(16, 16, 3, noise)}) {
        CHECK(picture_refusal(whole).empty());
        CHECK(picture_refusal(whole + "what follows is not looked at").empty());
        for (std::size_t size = 0; size < whole.size(); ++size)
            CHECK(contains(picture_refusal(whole.substr(0, size)), "a picture"));
    }
    CHECK(contains(picture_refusal("GIF89a"), "PNG"));
}

TEST_CASE("a damaged picture is one or is refused") {
    std::mt19937 random{7};
    const Texels texels(24 * 24 * 3, 77);
    for (const std::string& whole : {png_file(24, 24, 3, texels), jpeg_file(24, 24, 3, texels)})
        for (int round = 0; round < 3000; ++round) {
            std::string damaged = whole;
            for (std::uint32_t hits = 1 + random() % 6; hits > 0; --hits)
                damaged[random() % damaged.size()] = char(random() % 256);
            picture_refusal(damaged);
        }
}

TEST_CASE("a JPEG with more Huffman codes than a table holds is refused") {
    std::string jpeg = jpeg_file(8, 8, 3, Texels(8 * 8 * 3, 77));
    const std::size_t table = jpeg.find("\xFF\xC4");
    REQUIRE(table != jpeg.npos);
    for (std::size_t bits = 0; bits < 16; ++bits) jpeg[table + 5 + bits] = '\xFF';
    CHECK(contains(picture_refusal(jpeg), "damaged"));
}

TEST_CASE("a header that announces more pixels than its bytes can hold costs no memory") {
    std::string png = png_file(1, 1, 3, {1, 2, 3});
    png[16 + 2] = 0x40, png[20 + 2] = 0x40;  // 16385 x 16385
    CHECK(contains(picture_refusal(png), "16385 x 16385"));
    png[16 + 2] = 0x20, png[20 + 2] = 0x20;
    CHECK(contains(picture_refusal(png), "8193 x 8193"));
}

TEST_CASE("an .obj's v runs up, a map's down") {
    Model model;
    const auto mesh = model.mesh("Kd 1 1 1");
    CHECK(mesh->uvs() == std::vector<float2>{{0, 1}, {1, 1}, {1, 0}, {0, 0}});
    CHECK(!mesh->color_map());
    CHECK(mesh->opaque());
    CHECK(model.warnings.empty());
}

TEST_CASE("points on a seam are split, and a corner without a place on the map is at its corner") {
    const ScratchFolder folder;
    const auto path = folder.write("m.obj",
                                   "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt .25 .25\nvt .5\n"
                                   "f 1/1 2/1 3/1\nf 1/2 3/-1 4\n");
    const auto mesh = all<Mesh>(load(path.string()))[0];
    CHECK(mesh->points().size() == 6);
    CHECK(mesh->uvs() ==
          std::vector<float2>{
              {0.25f, 0.75f}, {0.5f, 1}, {0.25f, 0.75f}, {0.25f, 0.75f}, {0.5f, 1}, {0, 0}});
}

TEST_CASE("a seam of the maps is no edge of the surface") {
    const ScratchFolder folder;
    const auto normals = [&](const std::string& first, const std::string& second) {
        const std::string text =
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 -1\nvt 0 0\nvt 1 1\nf " + first + "\nf " + second;
        return all<Mesh>(load(folder.write("m.obj", text).string()))[0]->normals();
    };
    const auto whole = normals("1 2 3", "1 4 2"), split = normals("1/1 2/1 3/1", "1/2 4/2 2/2");
    REQUIRE(split.size() == 6);
    for (const std::size_t i : {0u, 1u})
        for (const std::size_t side : {2 * i, 2 * i + 1})
            for (std::size_t c = 0; c < 3; ++c) CHECK(split[side][c] == Approx(whole[i][c]));
}

TEST_CASE("map_d is a mask from the channel that it names, or from the one that says something") {
    Model model;
    model.folder.write("cut out.png", png_file(2, 1, 4, half_covered));
    model.folder.write("solid.png", png_file(2, 1, 4, {255, 255, 255, 255, 0, 0, 0, 255}));
    model.folder.write("grey.png", png_file(2, 1, 1, {255, 51}));
    const auto alpha = [&](const std::string& map_d) {
        const auto mesh = model.mesh("Kd 1 1 1\n" + map_d);
        CHECK(mesh->has_alpha());
        CHECK(!mesh->opaque());
        CHECK(mesh->alpha_mode() == AlphaMode::mask);
        CHECK(mesh->alpha_cutoff() == 0.5f);
        return mesh->alpha_map()->values;
    };
    CHECK(alpha("map_d grey.png") == std::vector{1.f, 0.2f});
    CHECK(alpha("map_d -imfchan m grey.png") == std::vector{1.f, 0.2f});
    CHECK(alpha("map_d cut out.png") == std::vector{1.f, 0.f});
    CHECK(alpha("map_d -clamp on -imfchan m -s 1 1 1 -mm 0 1 cut out.png") ==
          std::vector{1.f, 0.f});
    CHECK(alpha("map_d -o .5 -imfchan l cut out.png")[0] == Approx(0.0752).epsilon(0.01));
    CHECK(alpha("map_d solid.png") == std::vector{1.f, 0.f});
    CHECK(alpha("map_Kd cut out.png") == std::vector{1.f, 0.f});
    CHECK(alpha("map_Kd cut out.png\nmap_d grey.png") == std::vector{1.f, 0.2f});
    CHECK(!model.mesh("map_Kd solid.png")->has_alpha());
    CHECK(model.warnings.empty());
}

TEST_CASE("a colour map is multiplied with Kd, or stands alone") {
    Model model;
    model.folder.write("a.jpg", jpeg_file(8, 8, 3, Texels(8 * 8 * 3, 255)));
    const auto tinted = model.mesh("Kd .5 .25 1\nmap_Kd a.jpg\nd .5");
    CHECK(tinted->color() == std::vector<float3>{{0.5f, 0.25f, 1}});
    CHECK(tinted->opacity() == std::vector{0.5f});
    CHECK(tinted->color_map()->width == 8);
    CHECK(model.mesh("map_Kd .\\a.jpg")->color() == std::vector<float3>{{1, 1, 1}});
}

TEST_CASE("materials share a picture that is read once") {
    const ScratchFolder folder;
    folder.write("p.png", png_file(2, 1, 4, half_covered));
    folder.write("m.mtl", "newmtl a\nmap_Kd p.png\nnewmtl b\nmap_Kd ./p.png\n");
    const auto path = folder.write("m.obj",
                                   "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\n"
                                   "usemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 3/1 2/1\n");
    const auto parts = all<Mesh>(load(path.string()));
    CHECK(parts[0]->color_map() == parts[1]->color_map());
    CHECK(parts[0]->alpha_map() == parts[1]->alpha_map());
}

TEST_CASE("a missing picture leaves a grey surface and a warning, and none elsewhere is opened") {
    Model model;
    std::filesystem::create_directory(model.folder.file("inner"));
    model.folder.write("inner/a.tga", "x");
    for (const std::string& name :
         {std::string{"none.png"}, std::string{"../a.png"}, std::string{"inner/a.tga"},
          std::string{"inner"}, model.folder.file("m.obj").string(),
          std::string{"C:\\textures\\a.png"}}) {
        model.warnings.clear();
        const auto mesh = model.mesh("Kd 1 0 0\nmap_Kd " + name + "\nmap_d " + name);
        CHECK(mesh->color() == std::vector<float3>{{0.7f, 0.7f, 0.7f}});
        CHECK(mesh->opaque());
        REQUIRE(model.warnings.size() == 2);
        CHECK(contains(model.warnings[0], name));
        CHECK(contains(model.warnings[0], "m.obj"));
    }
    model.folder.write("bad.png", png_file(2, 1, 4, half_covered).substr(0, 40));
    CHECK(contains(message_of<FileFormatError>([&] { model.mesh("map_Kd bad.png"); }), "bad.png"));
}
