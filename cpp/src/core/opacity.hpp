// Opacity and optical depth: tau = -log(1 - opacity), T = exp(-tau). GLSL: lib/opacity.glsl.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>

namespace opacity {

// The largest opacity that still has an optical depth (16.6); 1 itself is for the opaque depth map.
inline constexpr double largest_opacity = 1.0 - 1.0 / 16777216.0;

template <std::floating_point T>
T optical_depth_of(T opacity) {
    return -std::log1p(-std::clamp(opacity, T(0), T(largest_opacity)));
}

// 1 - exp(-tau).
template <std::floating_point T>
T opacity_of(T optical_depth) {
    return -std::expm1(-optical_depth);
}

}  // namespace opacity
