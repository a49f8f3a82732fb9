// The slope of surfaces in the map, and how far the map for bare points moves them away from the
// light: by their own slope over one texel, the reach of the look-up's taps, at most by eight
// texels. GLSL: lib/surface.glsl.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "opacity/scene/light_space.hpp"

namespace opacity {

using Slope = std::array<float, 2>;

// As a part of the depth range.
inline float largest_surface_margin(float texels_per_unit, double depth_range) {
    return 8.f / (texels_per_unit * float(depth_range));
}

// `slope` is the change of depth by texel along x and y; `largest` as above.
inline float surface_margin(const Slope& slope, float largest) {
    return std::min(std::abs(slope[0]) + std::abs(slope[1]), largest);
}

// The slope of the plane that two vectors of light space span; beyond every margin where the light
// grazes it.
template <class Vector>
Slope surface_slope(const Vector& a, const Vector& b) {
    const auto x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2];
    const auto z = a[0] * b[1] - a[1] * b[0];
    if (!(std::abs(z) > 1e-20)) return {1e20f, 1e20f};
    return {float(-x / z), float(-y / z)};
}

// How far the plane of a receiver is believed to go on along the light, x, y texels away; `largest`
// margin as above.
inline float plane_limit(float x, float y, float largest) {
    return largest * std::max({1.f, std::abs(x), std::abs(y)});
}

// How much deeper it lies there.
inline float plane_change(const Slope& slope, float x, float y, float largest) {
    const float limit = plane_limit(x, y, largest);
    return std::clamp(slope[0] * x + slope[1] * y, -limit, limit);
}

}  // namespace opacity
