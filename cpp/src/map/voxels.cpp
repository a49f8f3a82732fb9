#include "map/voxels.hpp"

#include <algorithm>
#include <cmath>

#include "core/glm_matrix.hpp"

namespace opacity {
namespace {

struct Reach {
    float begin, end;
};

// Where the ray is inside the box.
std::optional<Reach> reach_inside(const VoxelRay& ray, const Voxel& low, const Voxel& high) {
    Reach reach{ray.begin, 1e30f};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float from = ray.origin[axis], along = ray.direction[axis];
        if (along == 0.f) {
            if (from < float(low[axis]) || !(from < float(high[axis]))) return {};
            continue;
        }
        const float a = (float(low[axis]) - from) / along, b = (float(high[axis]) - from) / along;
        reach.begin = std::max(reach.begin, std::min(a, b));
        reach.end = std::min(reach.end, std::max(a, b));
    }
    if (!(reach.begin < reach.end)) return {};
    return reach;
}

}  // namespace

std::optional<VoxelChord> voxel_chord(const VoxelRay& ray, const VoxelGrid& grid, const Voxel& low,
                                      const Voxel& high) {
    const auto reach = reach_inside(ray, low, high);
    if (!reach) return {};
    float t = reach->begin;
    Voxel voxel;
    for (std::size_t i = 0; i < 3; ++i) {
        const float entry = std::floor(ray.origin[i] + t * ray.direction[i]);
        voxel[i] = std::clamp(int(entry), low[i], high[i] - 1);
    }
    VoxelChord chord;
    float density = 0.f;  // extinction times depth
    bool met = false;
    const int most = (high[0] - low[0]) + (high[1] - low[1]) + (high[2] - low[2]);
    for (int turn = 0; turn < most; ++turn) {
        // Where the ray leaves the voxel, and through which face.
        float leaves = reach->end;
        int axis = -1;
        for (int i = 0; i < 3; ++i) {
            const float along = ray.direction[i];
            const float wall = (float(voxel[i] + (along > 0.f ? 1 : 0)) - ray.origin[i]) / along;
            if (along != 0.f && wall < leaves) leaves = wall, axis = i;
        }
        leaves = std::max(leaves, t);
        const float extinction = grid.at(voxel);
        if (extinction > 0.f && leaves > t) {
            if (!met) chord.begin = t;
            met = true;
            chord.end = leaves;
            density += extinction * (leaves - t);
        }
        t = leaves;
        if (axis < 0) break;
        voxel[axis] += ray.direction[axis] > 0.f ? 1 : -1;
        if (voxel[axis] < low[axis] || voxel[axis] >= high[axis]) break;
    }
    if (!met) return {};
    float squared = 0.f;
    for (std::size_t i = 0; i < 3; ++i) {
        const float unit = ray.direction[i] * grid.voxel_size[i];
        squared += unit * unit;
    }
    chord.optical_depth = density * std::sqrt(squared);
    return chord;
}

double4x4 local_from_voxels(const Volume& volume) {
    const double3 &origin = volume.origin(), &spacing = volume.spacing();
    double4x4 result = identity;
    for (std::size_t i = 0; i < 3; ++i) {
        result[5 * i] = spacing[i];
        result[4 * i + 3] = origin[i] - 0.5 * spacing[i];
    }
    return result;
}

VoxelSpace voxel_space(const double4x4& view_from_world, const double4x4& world_from_local,
                       const double4x4& local_from_voxels) {
    const glm::dmat4 from_voxels =
        to_glm(view_from_world) * to_glm(world_from_local) * to_glm(local_from_voxels);
    return {from_glm(from_voxels), from_glm(glm::inverse(from_voxels))};
}

}  // namespace opacity
