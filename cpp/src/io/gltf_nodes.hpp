// Where the nodes of a glTF scene put its meshes.
#pragma once

#include <vector>

#include "io/gltf_file.hpp"
#include "opacity/core/math.hpp"

namespace opacity {

struct GltfPlacement {
    JsonValue mesh;  // its index
    double4x4 transform;
};

// Of the file's scene, or of all nodes where it has none, at rest.
std::vector<GltfPlacement> gltf_placements(const GltfFile& file);

}  // namespace opacity
