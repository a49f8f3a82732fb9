// Light space: x and y in texels of the light's map, z the linear distance along the light as a
// fraction of the casters' range. lib/light.glsl says the same.
#pragma once

#include "opacity/core/math.hpp"

namespace opacity {

struct LightSpace {
    double4x4 from_world = identity;
    int map_size_px = 1;
    double depth_range = 1.0;      // world units from z = 0 to z = 1
    double texels_per_unit = 1.0;  // 1 / the side of a texel in world units
    double least_bias = 0.0;       // world units
    bool operator==(const LightSpace&) const = default;
};

double4x4 world_from(const LightSpace& space);

}  // namespace opacity
