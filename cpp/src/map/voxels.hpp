// A ray through voxels of constant extinction (3D-DDA, Amanatides and Woo 1987). GLSL:
// lib/voxels.glsl, in the same order of operations.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "opacity/core/math.hpp"
#include "opacity/scene/volume.hpp"

namespace opacity {

using Voxel = std::array<int, 3>;  // x, y, z

// At depth t it is at origin + t * direction, in voxels; nothing in front of `begin` is met.
struct VoxelRay {
    float3 origin, direction;
    float begin;
};

// From where it enters the first voxel that is not empty to where it leaves the last one.
struct VoxelChord {
    float begin = 0.f, end = 0.f;
    float optical_depth = 0.f;
};

struct VoxelGrid {
    Voxel size;
    std::span<const float> extinction;  // x first; per unit of length in the shape's coordinates
    float3 voxel_size;                  // in the shape's coordinates

    float at(const Voxel& voxel) const {
        const std::size_t row = std::size_t(voxel[2]) * size[1] + voxel[1];
        return extinction[row * size[0] + voxel[0]];
    }
};

// What the ray meets of the voxels from `low` up to `high`, if anything.
std::optional<VoxelChord> voxel_chord(const VoxelRay& ray, const VoxelGrid& grid, const Voxel& low,
                                      const Voxel& high);

// Coordinates in which a voxel is one unit long, and the first begins at 0, and those of a view;
// joined in float64.
struct VoxelSpace {
    double4x4 from_voxels = identity, to_voxels = identity;
};
double4x4 local_from_voxels(const Volume& volume);
VoxelSpace voxel_space(const double4x4& view_from_world, const double4x4& world_from_local,
                       const double4x4& local_from_voxels);

}  // namespace opacity
