// A volume as the slabs in which it is drawn into maps: across each of its axes, so that light
// meets them one after the other whatever its direction, and without what is empty around them.
#pragma once

#include <vector>

#include "map/voxels.hpp"

namespace opacity {

// The voxels from `begin` up to `end`, along x, y and z.
struct Slab {
    int axis;  // that it lies across
    Voxel begin, end;
};

// A texel gets one deposit of each slab; thicker ones would blur the depths of their voxels.
inline constexpr int most_slabs = 64;  // across one axis

// Of all three axes, one after the other; each holds a voxel that is not empty, and is the smallest
// box around those in its layers.
std::vector<Slab> slabs_of(const Volume& volume);

}  // namespace opacity
