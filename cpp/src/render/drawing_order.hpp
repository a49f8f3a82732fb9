// In which order a pass that keeps the nearest samples draws: what hides others comes first, so
// that they are not shaded. Any order gives the same picture, but for samples of one depth.
#pragma once

#include <cstddef>
#include <vector>

#include "opacity/graph/pass.hpp"
#include "scene/primitive_chunks.hpp"

namespace opacity::render {

// Whether a camera's pass does: one over its distance, the largest, remains.
bool keeps_nearest(const Pass& pass);
// Its shapes by number: strands before the bodies that they grow on, else as they come.
std::vector<std::size_t> drawing_order(const Pass& pass);
// Of a shape, by the distances of the eye to the middles of chunks; equally far ones by number.
ChunkRanges front_to_back(const PrimitiveChunks& chunks, const ChunkRanges& seen,
                          const double4x4& view_from_local);

}  // namespace opacity::render
