// Small glTF files, whose every part may lie.
#pragma once

#include <cstdint>
#include <string>

#include "load_help.hpp"

inline std::string glb_file(std::string json, std::string binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    std::string file = "glTF";
    append(file, std::uint32_t{2});
    append(file, std::uint32_t(28 + json.size() + binary.size()));
    append(file, std::uint32_t(json.size()));
    file += "JSON" + json;
    append(file, std::uint32_t(binary.size()));
    return file + std::string{"BIN\0", 4} + binary;
}

// Replaces what stands once in a text.
inline std::string with(std::string text, const std::string& old, const std::string& fresh) {
    const std::size_t at = text.find(old);
    REQUIRE_MESSAGE(at != text.npos, old);
    return text.replace(at, old.size(), fresh);
}

// A quad: five positions, of which the indices use four, and texture coordinates between them.
struct Quad {
    std::string binary = [] {
        std::string bytes;
        // x y z u v: interleaved, 20 bytes a vertex.
        for (const float f : {9.f, 9.f, 9.f, 9.f, 9.f, 0.f, 0.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f,
                              1.f, 1.f, 1.f, 1.f, 0.f, 1.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f})
            append(bytes, f);
        for (const std::uint16_t i : {1, 2, 3, 1, 3, 4}) append(bytes, i);
        return bytes;
    }();
    std::string json =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2}]}],)"
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"},)"
        R"({"bufferView":0,"byteOffset":12,"componentType":5126,"count":5,"type":"VEC2"},)"
        R"({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":100,"byteStride":20},)"
        R"({"buffer":0,"byteOffset":100,"byteLength":12}],"buffers":[{"byteLength":112}]})";

    // The same file with one part of its document replaced.
    Quad but(const std::string& old, const std::string& fresh) const {
        return {binary, with(json, old, fresh)};
    }
    std::string glb() const { return glb_file(json, binary); }
};
