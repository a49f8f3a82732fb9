// One primitive of a glTF mesh as a shape.
#pragma once

#include "io/gltf_material.hpp"

namespace opacity {

// Triangles, strips and fans as a mesh, points as particles that just touch; null for lines.
ShapePtr read_gltf_primitive(GltfFile& file, const JsonValue& primitive,
                             const GltfMaterial& material);

}  // namespace opacity
