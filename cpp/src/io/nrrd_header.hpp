// What an NRRD file says it holds: http://teem.sourceforge.net/nrrd/format.html
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "io/scalar.hpp"
#include "opacity/core/math.hpp"

namespace opacity {

enum class NrrdEncoding { raw, gzip };

// Of three axes; x is the one whose voxels follow each other.
struct NrrdHeader {
    ScalarType type = ScalarType::float32;
    NrrdEncoding encoding = NrrdEncoding::raw;
    std::endian order = std::endian::little;
    std::array<std::uint64_t, 3> sizes{};  // x, y, z
    // From one voxel to the next along each axis, and the middle of the first.
    std::array<double3, 3> directions{double3{1, 0, 0}, double3{0, 1, 0}, double3{0, 0, 1}};
    double3 origin{0, 0, 0};
    bool from_the_end = false;  // byte skip -1: the data ends with the file
    std::size_t size = 0;       // bytes, the empty line included
};

// FileFormatError that begins with `name`, and names what is not read.
NrrdHeader read_nrrd_header(std::string_view content, const std::string& name);

}  // namespace opacity
