#include "io/demo_volume.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/parallel.hpp"

namespace opacity::demo {
namespace {

glm::dvec3 vec(const double3& p) {
    return {p[0], p[1], p[2]};
}

// In proportion to the box, then in whole numbers.
Volume::Size size_zyx(const glm::dvec3& extent, std::size_t most_voxels) {
    const double longest = std::max({extent.x, extent.y, extent.z});
    glm::i64vec3 best{1};
    for (std::int64_t cells = 1;; ++cells) {
        const glm::i64vec3 rounded{extent / longest * double(cells) + 0.5};
        const glm::i64vec3 size = glm::max(rounded, glm::i64vec3{1});
        if (std::uint64_t(size.x * size.y * size.z) > most_voxels) break;
        best = size;
    }
    // What is left over goes into height, where smoke and clouds have most to show.
    best.z = std::max(best.z, std::int64_t(most_voxels) / (best.x * best.y));
    return {int(best.z), int(best.y), int(best.x)};
}

}  // namespace

std::shared_ptr<Volume> volume(const Box& box, std::size_t most_voxels, float3 color,
                               const std::function<double(const glm::dvec3&)>& extinction) {
    const glm::dvec3 low = vec(box.min), extent = vec(box.max) - low;
    const Volume::Size size = size_zyx(extent, most_voxels);
    const auto rows = std::size_t(size[1]), columns = std::size_t(size[2]);
    const glm::dvec3 spacing = extent / glm::dvec3{size[2], size[1], size[0]};
    const glm::dvec3 origin = low + 0.5 * spacing;
    std::vector<float> values(std::size_t(size[0]) * rows * columns);
    parallel_for(std::size_t(size[0]), [&](std::size_t z) {
        for (std::size_t y = 0; y < rows; ++y)
            for (std::size_t x = 0; x < columns; ++x)
                values[(z * rows + y) * columns + x] =
                    float(extinction(origin + spacing * glm::dvec3{x, y, z}));
    });
    return std::make_shared<Volume>(size, std::move(values), double3{origin.x, origin.y, origin.z},
                                    double3{spacing.x, spacing.y, spacing.z}, color);
}

}  // namespace opacity::demo
