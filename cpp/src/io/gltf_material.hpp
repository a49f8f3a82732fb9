// glTF's materials, as far as shadows need them.
#pragma once

#include <cstdint>

#include "io/gltf_file.hpp"
#include "io/surface.hpp"

namespace opacity {

struct GltfMaterial {
    Surface surface;
    std::uint64_t uv_set = 0;  // the TEXCOORD_n of its picture
    // u' = m[0] u + m[1] v + m[2] and v' = m[3] u + m[4] v + m[5] (KHR_texture_transform).
    std::array<double, 6> uv_transform{1, 0, 0, 0, 1, 0};
};

// Of a primitive; one that names no material is white, as the specification says.
GltfMaterial read_gltf_material(GltfFile& file, const JsonValue& index);

}  // namespace opacity
