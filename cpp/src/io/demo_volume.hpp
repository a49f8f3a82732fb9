// Volumes of generated scenes, voxel by voxel.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <memory>

#include "opacity/scene/volume.hpp"

namespace opacity::demo {

// A box filled with at most so many voxels, as nearly cubes as their number allows, and as many as
// that. `extinction` is asked at their middles, on all cores.
std::shared_ptr<Volume> volume(const Box& box, std::size_t most_voxels, float3 color,
                               const std::function<double(const glm::dvec3&)>& extinction);

}  // namespace opacity::demo
