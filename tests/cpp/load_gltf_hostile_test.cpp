// glTF files that lie.
#include <doctest/doctest.h>

#include "gltf_file.hpp"
#include "picture_file.hpp"

using namespace opacity;

namespace {

std::string refused(const ScratchFolder& folder, const std::string& old, const std::string& fresh) {
    return refusal(folder, "m.glb", Quad{}.but(old, fresh).glb());
}

}  // namespace

TEST_CASE("a GLB cut anywhere is refused") {
    const ScratchFolder folder;
    check_cuts(folder, "cut.glb", Quad{}.glb());
    const std::string json = Quad{}.json;
    for (std::size_t size = 0; size < json.size(); ++size)
        CHECK(!refusal(folder, "cut.gltf", json.substr(0, size)).empty());
}

TEST_CASE("a damaged GLB loads or is refused") {
    const ScratchFolder folder;
    check_damage(folder, "damaged.glb", Quad{}.glb());
}

TEST_CASE("extensions that a file requires are read or named") {
    const ScratchFolder folder;
    const auto requiring = [&](const std::string& extension) {
        return refused(folder, R"("scene":0)",
                       R"("extensionsRequired":[")" + extension + R"("],"scene":0)");
    };
    CHECK(contains(requiring("KHR_draco_mesh_compression"), "KHR_draco_mesh_compression"));
    CHECK(requiring("KHR_mesh_quantization").empty());
    CHECK(contains(refused(folder, R"("2.0")", R"("1.0")"), "asset.version is not 2.0"));
}

TEST_CASE("offsets, counts and strides that leave their buffer are refused") {
    const ScratchFolder folder;
    const auto is_refused = [&](const std::string& old, const std::string& fresh) {
        CAPTURE(fresh);
        CHECK(contains(refused(folder, old, fresh), "m.glb"));
    };
    const std::string huge = "1099511627776";
    is_refused(R"("count":5,"type":"VEC3")", R"("count":6,"type":"VEC3")");
    is_refused(R"("count":5,"type":"VEC3")", R"("count":)" + huge + R"(,"type":"VEC3")");
    is_refused(R"("count":5,"type":"VEC3")", R"("count":18446744073709551615,"type":"VEC3")");
    is_refused(R"("count":5,"type":"VEC3")", R"("count":-1,"type":"VEC3")");
    is_refused(R"("count":5,"type":"VEC3")", R"("count":4.5,"type":"VEC3")");
    is_refused(R"("count":5,"type":"VEC3")", R"("count":"5","type":"VEC3")");
    is_refused(R"("count":5,"type":"VEC3")", R"("count":4,"type":"VEC3")");  // fewer than the uvs
    is_refused(R"("type":"VEC3")", R"("type":"MAT4")");
    is_refused(R"("type":"VEC3")", R"("type":"VEC2")");
    is_refused(R"("byteOffset":12)", R"("byteOffset":13)");
    is_refused(R"("byteOffset":12)", R"("byteOffset":)" + huge);
    is_refused(R"("byteStride":20)", R"("byteStride":4)");
    is_refused(R"("byteStride":20)", R"("byteStride":)" + huge);
    is_refused(R"("byteOffset":100)", R"("byteOffset":101)");
    is_refused(R"("byteOffset":100)", R"("byteOffset":)" + huge);
    is_refused(R"("byteLength":112)", R"("byteLength":113)");
    is_refused(R"("byteLength":112)", R"("byteLength":1e300)");
    is_refused(R"("bufferView":1)", R"("bufferView":2)");
    is_refused(R"("bufferView":1)", R"("bufferView":0)");  // indices beyond the vertices
    is_refused(R"("bufferView":1,)", "");
    is_refused(R"({"buffer":0,"byteLength")", R"({"buffer":1,"byteLength")");
    is_refused(R"("indices":2)", R"("indices":3)");
    is_refused(R"("indices":2)", R"("indices":1)");
    is_refused(R"("POSITION":0)", R"("POSITION":1)");
    is_refused(R"("mesh":0)", R"("mesh":1)");
    is_refused(R"("scene":0)", R"("scene":1)");
    is_refused(R"("meshes":[)", R"("meshes":{},"unread":[)");
    is_refused(R"("bufferView":1)", R"("sparse":{},"bufferView":1)");
    is_refused(R"("nodes":[{)", R"("nodes":[{"rotation":[0,0,0,0],)");
    is_refused(R"("nodes":[{)", R"("nodes":[{"translation":[1e999,0,0],)");
}

TEST_CASE("a position that is not finite is named") {
    const ScratchFolder folder;
    Quad quad;
    const float infinite = std::numeric_limits<float>::infinity();
    quad.binary.replace(20, sizeof infinite, reinterpret_cast<const char*>(&infinite), 4);
    const std::string message = refusal(folder, "m.glb", quad.glb());
    CHECK(contains(message, "meshes[0].primitives[0]"));
    CHECK(contains(message, "points[0]"));
}

TEST_CASE("a document of many levels is read or refused, and nothing else") {
    const ScratchFolder folder;
    const std::string open(200'000, '['), close(200'000, ']');
    CHECK(!refusal(folder, "deep.gltf", open).empty());
    CHECK(!refusal(folder, "deep.gltf", open + close).empty());
}

TEST_CASE("a chain of nodes may be long") {
    const ScratchFolder folder;
    std::string nodes = R"("nodes":[)";
    constexpr int count = 20'000;
    for (int i = 1; i < count; ++i) nodes += R"({"children":[)" + std::to_string(i) + "]},";
    CHECK(refused(folder, R"("nodes":[{"mesh":0}])", nodes + R"({"mesh":0}])").empty());
}

TEST_CASE("a small file cannot unfold to any size") {
    const ScratchFolder folder;
    std::string primitive = R"({"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2})";
    std::string primitives = primitive, nodes, children;
    for (int i = 0; i < 1000; ++i) primitives += "," + primitive;
    for (int i = 0; i < 1000; ++i) {
        children += (i ? "," : "") + std::to_string(i);
        nodes += std::string{i ? "," : ""} + R"({"mesh":0})";
    }
    const Quad quad = Quad{}
                          .but(primitive, primitives)
                          .but(R"("nodes":[0])", R"("nodes":[)" + children + "]")
                          .but(R"("nodes":[{"mesh":0}])", R"("nodes":[)" + nodes + "]");
    CHECK(contains(refusal(folder, "m.glb", quad.glb()), "unfolds"));
}
