// What a PLY file says it holds: http://paulbourke.net/dataformats/ply
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/scalar.hpp"

namespace opacity {

enum class PlyEncoding { ascii, little_endian, big_endian };

struct PlyProperty {
    std::string name;
    ScalarType type;
    std::optional<ScalarType> count_type{};  // of a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count;
    std::vector<PlyProperty> properties{};

    // The place of the first property of one of these names.
    std::optional<std::size_t> find(std::initializer_list<std::string_view> names) const;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::ascii;
    std::vector<PlyElement> elements{};
    std::size_t size = 0;  // bytes, its last line break included
};

// FileFormatError that begins with `name`.
PlyHeader read_ply_header(std::string_view content, const std::string& name);

}  // namespace opacity
