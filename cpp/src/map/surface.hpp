// How far a surface is moved away from the light in the map: by its own slope over one texel, the
// reach of the look-up's taps, at most by eight texels. GLSL: lib/surface.glsl.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "opacity/scene/light_space.hpp"

namespace opacity {

// As a part of the depth range.
inline float largest_surface_margin(const LightSpace& space) {
    return 8.f / (float(space.texels_per_unit) * float(space.depth_range));
}

// `slope` is the change of depth by texel along x and y.
inline float surface_margin(const std::array<float, 2>& slope, const LightSpace& space) {
    return std::min(std::abs(slope[0]) + std::abs(slope[1]), largest_surface_margin(space));
}

// No steeper than what the margin makes up for.
inline std::array<float, 2> limited_slope(const std::array<float, 2>& slope,
                                          const LightSpace& space) {
    const float steepness = std::abs(slope[0]) + std::abs(slope[1]);
    const float limit = largest_surface_margin(space);
    if (!(steepness > limit)) return slope;
    return {slope[0] * (limit / steepness), slope[1] * (limit / steepness)};
}

}  // namespace opacity
