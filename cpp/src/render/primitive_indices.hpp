// Index buffers of primitives: triangles by their corners, all else two triangles over the four
// vertices of a quadrilateral, k for primitive k (lib/segment.glsl, lib/quad.glsl).
#pragma once

#include <cstdint>
#include <vector>

#include "scene/primitives.hpp"

namespace opacity::render {

std::vector<std::uint32_t> indices_of(const Primitives& primitives,
                                      const std::vector<std::uint32_t>& numbers);
// Of quadrilaterals 0 .. count - 1.
std::vector<std::uint32_t> quad_triangles(std::size_t count);

}  // namespace opacity::render
