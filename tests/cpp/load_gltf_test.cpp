#include <doctest/doctest.h>

#include "gltf_file.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/particles.hpp"
#include "picture_file.hpp"

using namespace opacity;
using doctest::Approx;

namespace {

struct Loader {
    ScratchFolder folder;
    std::vector<std::string> warnings;

    std::vector<ShapePtr> operator()(const std::string& content,
                                     const std::string& name = "m.glb") {
        return load(folder.write(name, content).string(),
                    [&](LogLevel, std::string_view message) { warnings.emplace_back(message); });
    }
    std::shared_ptr<Mesh> mesh(const Quad& quad) { return all<Mesh>((*this)(quad.glb())).at(0); }
    std::string refused(const Quad& quad) { return refusal(folder, "m.glb", quad.glb()); }
};

// The quad with more bytes behind its own, in a view of their own, number 2.
Quad with_bytes(const Quad& quad, const std::string& bytes) {
    const std::string length = std::to_string(bytes.size());
    Quad more =
        quad.but(R"("byteLength":12}])",
                 R"("byteLength":12},{"buffer":0,"byteOffset":112,"byteLength":)" + length + "}]")
            .but(R"([{"byteLength":112)",
                 R"([{"byteLength":)" + std::to_string(112 + bytes.size()));
    more.binary += bytes;
    return more;
}

Quad with_material(const Quad& quad, const std::string& material, const std::string& picture) {
    return with_bytes(
        quad.but(R"("indices":2)", R"("indices":2,"material":0)")
            .but(R"("accessors")", R"("materials":[)" + material +
                                       R"(],"textures":[{"source":0}],"images":[{"bufferView":2,)"
                                       R"("mimeType":"image/png"}],"accessors")"),
        picture);
}

const std::string textured = R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0}})";

}  // namespace

TEST_CASE("a GLB's interleaved quad has the vertices that it uses, with v as the file has it") {
    Loader load;
    const auto mesh = load.mesh({});
    CHECK(mesh->points().size() == 4);
    CHECK(mesh->points()[1] == double3{1, 0, 0});
    CHECK(mesh->triangles() == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
    CHECK(mesh->uvs() == std::vector<float2>{{0, 1}, {1, 1}, {1, 0}, {0, 0}});
    CHECK(mesh->normals()[0] == float3{0, 0, 1});
    CHECK(mesh->color() == std::vector<float3>{{1, 1, 1}});
    CHECK(mesh->opaque());
    CHECK(load.warnings.empty());
}

TEST_CASE("a .gltf finds its buffer beside it, or holds it") {
    Loader load;
    const Quad quad;
    load.folder.write("my quad.bin", quad.binary);
    const auto beside = quad.but(R"("buffers":[{)", R"("buffers":[{"uri":"my%20quad.bin",)");
    CHECK(all<Mesh>(load(beside.json, "m.gltf"))[0]->points().size() == 4);
    const auto outside = quad.but(R"("buffers":[{)", R"("buffers":[{"uri":"../quad.bin",)");
    CHECK(contains(refusal(load.folder, "m.gltf", outside.json), "../quad.bin"));
    CHECK(contains(refusal(load.folder, "m.gltf", quad.json), "buffers[0] has no bytes"));

    // Three vertices of "AAAAAAAAAAAAAIA/..." by hand: (0,0,0) (1,0,0) (0,1,0), no indices.
    const std::string document =
        R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,)"
        R"("uri":"data:application/octet-stream;base64,)"
        R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
    const auto mesh = all<Mesh>(load(document, "embedded.gltf"))[0];
    CHECK(mesh->points()[1] == double3{1, 0, 0});
    CHECK(mesh->points()[2] == double3{0, 1, 0});
    const std::string damaged = with(document, "AAAAgD8", "AAAA~D8");
    CHECK(contains(refusal(load.folder, "m.gltf", damaged), "base64"));
}

TEST_CASE("nodes place instances of their meshes, turned, scaled and moved by all above them") {
    Loader load;
    const Quad quad = Quad{}.but(
        R"("nodes":[{"mesh":0}])",
        R"("nodes":[{"translation":[10,0,0],"children":[1,2]},)"
        R"({"mesh":0,"rotation":[0,0,0.7071067811865476,0.7071067811865476],"scale":[2,3,4]},)"
        R"({"mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1]},{"mesh":0}])");
    const auto meshes = all<Mesh>(load(quad.glb()));
    REQUIRE(meshes.size() == 2);  // the scene does not hold the last node
    const double3 turned = transform_point(meshes[0]->transform(), {1, 1, 1});
    CHECK(turned[0] == Approx(7));
    CHECK(turned[1] == Approx(2));
    CHECK(turned[2] == Approx(4));
    CHECK(transform_point(meshes[1]->transform(), {1, 1, 1}) == double3{16, 7, 8});
    CHECK(&meshes[0]->triangles() == &meshes[1]->triangles());

    const auto hidden = Quad{}.but(R"("nodes":[{)", R"("nodes":[{"scale":[0,0,0],)");
    CHECK(contains(load.refused(hidden), "neither triangles nor points"));
    CHECK(contains(load.refused(quad.but("[1,2]", "[1,0]")), "two parents"));
    CHECK(contains(load.refused(quad.but("[1,2]", "[1,1]")), "two parents"));
    CHECK(contains(load.refused(quad.but("[1,2]", "[1,9]")), "is 9, of 4 nodes"));
}

TEST_CASE("indices and attributes of every component type are read") {
    Loader load;
    const auto of_type = [&](const std::string& code, auto zero) {
        std::string bytes;
        for (const int i : {1, 2, 3, 1, 3, 4}) append(bytes, decltype(zero)(i));
        return load.mesh(with_bytes(Quad{}, bytes)
                             .but(R"({"bufferView":1,"componentType":5123)",
                                  R"({"bufferView":2,"componentType":)" + code));
    };
    CHECK(of_type("5121", std::uint8_t{})->triangles().size() == 6);
    CHECK(of_type("5123", std::uint16_t{})->triangles().size() == 6);
    CHECK(of_type("5125", std::uint32_t{})->triangles().size() == 6);
    CHECK(contains(load.refused(Quad{}.but("5123", "5124")), "is not a type"));
    CHECK(contains(load.refused(Quad{}.but("5123", "5126")), "does not"));

    std::string uvs;
    for (const int i : {0, 0, 0, 255, 255, 255, 255, 0, 0, 0}) append(uvs, std::uint8_t(i));
    const auto normalized =
        load.mesh(with_bytes(Quad{}, uvs)
                      .but(R"({"bufferView":0,"byteOffset":12,"componentType":5126,)",
                           R"({"bufferView":2,"componentType":5121,"normalized":true,)"));
    CHECK(normalized->uvs() == std::vector<float2>{{0, 1}, {1, 1}, {1, 0}, {0, 0}});
}

TEST_CASE("strips and fans become triangles that face one way") {
    Loader load;
    const auto triangles = [&](const std::string& mode) {
        return load.mesh(Quad{}.but(R"("indices":2)", R"("mode":)" + mode))->triangles();
    };
    CHECK(triangles("4") == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(triangles("5") == std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3, 2, 3, 4});
    CHECK(triangles("6") == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 0, 3, 4});
    CHECK(contains(load.refused(Quad{}.but(R"("indices":2)", R"("mode":7)")), "mode is not"));
    CHECK(!load.refused(Quad{}.but(R"("indices":2)", R"("mode":1)")).empty());  // lines alone
}

TEST_CASE("points become particles that just touch") {
    Loader load;
    const auto particles =
        all<Particles>(load(Quad{}.but(R"("indices":2)", R"("indices":2,"mode":0)").glb()))[0];
    CHECK(particles->points().size() == 4);
    CHECK(particles->radius() == std::vector{0.5f});
}

TEST_CASE("a material's base colour and alpha are read, and its picture's alpha by its mode") {
    Loader load;
    const std::string png = png_file(2, 1, 4, {255, 255, 255, 51, 0, 0, 0, 255});
    const auto of = [&](const std::string& material, const std::string& picture) {
        return load.mesh(with_material({}, "{" + material + "}", picture));
    };
    const auto opaque = of(textured, png);
    CHECK(opaque->opaque());
    CHECK(opaque->color_map()->values[0] == 1.f);
    const auto mask = of(textured + R"(,"alphaMode":"MASK","alphaCutoff":0.25)", png);
    CHECK(mask->has_alpha());
    CHECK(mask->alpha_mode() == AlphaMode::mask);
    CHECK(mask->alpha_cutoff() == 0.25f);
    CHECK(mask->alpha_map()->values == std::vector{0.2f, 1.f});
    CHECK(of(textured + R"(,"alphaMode":"MASK")", png)->alpha_cutoff() == 0.5f);
    const std::string factors =
        R"("pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,0.5],"baseColorTexture":)"
        R"({"index":0}},"alphaMode":)";
    const auto blend = of(factors + R"("BLEND")", png);
    CHECK(blend->alpha_mode() == AlphaMode::blend);
    CHECK(blend->opacity() == std::vector{0.5f});
    CHECK(blend->color() == std::vector<float3>{{0.5f, 0.25f, 1}});
    // Texels of .5 x 1 reach a cutoff of .4, which is .8 of their own.
    CHECK(of(factors + R"("MASK","alphaCutoff":0.4)", png)->alpha_cutoff() == Approx(0.8));
    CHECK(of(factors + R"("MASK","alphaCutoff":0.6)", png)->opacity() == std::vector{0.f});
    CHECK(!of(textured + R"(,"alphaMode":"MASK")", png_file(1, 1, 3, {1, 2, 3}))->has_alpha());

    const auto refused = [&](const std::string& material) {
        return load.refused(with_material({}, "{" + material + "}", png));
    };
    CHECK(contains(refused(R"("alphaMode":"HOLES")"), "alphaMode is no alpha mode"));
    CHECK(contains(refused(R"("pbrMetallicRoughness":{"baseColorFactor":[1,1,1,2]})"), "is 2"));
    CHECK(contains(refused(R"("pbrMetallicRoughness":{"baseColorFactor":[1,1,1]})"), "3 elements"));
}

TEST_CASE("a picture that is moved moves the texture coordinates") {
    Loader load;
    const auto mesh = load.mesh(
        with_material({},
                      R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":)"
                      R"({"KHR_texture_transform":{"offset":[0.5,0.25],"scale":[2,4]}}}}})",
                      png_file(1, 1, 3, {1, 2, 3})));
    CHECK(mesh->uvs() ==
          std::vector<float2>{{0.5f, 4.25f}, {2.5f, 4.25f}, {2.5f, 0.25f}, {0.5f, 0.25f}});
}

TEST_CASE("vertex colours are a factor, with alpha where the surface is blended") {
    Loader load;
    std::string colors;
    for (int vertex = 0; vertex < 5; ++vertex)
        for (const int c : {255, 51, 0, 51 * vertex}) append(colors, std::uint8_t(c));
    const Quad quad =
        with_material({}, R"({"alphaMode":"BLEND"})", colors)
            .but(R"("TEXCOORD_0":1)", R"("TEXCOORD_0":1,"COLOR_0":3)")
            .but(R"("type":"SCALAR"})", R"("type":"SCALAR"},{"bufferView":2,"componentType":5121,)"
                                        R"("normalized":true,"count":5,"type":"VEC4"})");
    const auto mesh = load.mesh(quad);
    CHECK(mesh->color() == std::vector<float3>(4, float3{1, 0.2f, 0}));
    CHECK(mesh->opacity() == std::vector{0.2f, 0.4f, 0.6f, 0.8f});
}

TEST_CASE("a missing picture leaves a grey surface and a warning") {
    Loader load;
    const Quad quad =
        with_material({}, "{" + textured + "}", "").but(R"("bufferView":2,)", R"("uri":"no.png",)");
    CHECK(load.mesh(quad)->color() == std::vector<float3>{{0.7f, 0.7f, 0.7f}});
    REQUIRE(load.warnings.size() == 1);
    CHECK(contains(load.warnings[0], "no.png"));
    const auto webp = with_material({}, "{" + textured + "}", "").but(R"({"source":0})", "{}");
    CHECK(!load.mesh(webp)->color_map());
    CHECK(load.warnings.size() == 2);
}
