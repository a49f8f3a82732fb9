// What a layer holds, where its optical depth is known and the mean position of that. GLSL:
// lib/layer_held.glsl.
#pragma once

#include <algorithm>

#include "core/opacity.hpp"
#include "map/interval.hpp"

namespace opacity {

// Optical depth that grows evenly from one plane to the next. Rounding makes it nowhere more than
// what the next plane has: T never rises along the light.
inline float rising_line(float before, float behind, float along) {
    return std::min(before + along * (behind - before), behind);
}

struct LayerHeld {
    float optical_depth = 0.f, moment = 0.f;  // the same times position
};

// Its optical depth in front of x: it grows evenly about the mean position, as far as the nearer
// plane. Of few casters: the mean of T if it is that of two, each anywhere there.
inline float held_in_front(const LayerHeld& held, float low, float high, float x,
                           bool few_casters) {
    if (!(held.optical_depth > 0.f)) return 0.f;
    const float mean = std::clamp(held.moment / held.optical_depth, low, high);
    const float reach = std::min(mean - low, high - mean);
    const float met = part_in_front(mean - reach, mean + reach, x);
    if (!few_casters) return met * held.optical_depth;
    return 2.f * optical_depth_of(met * opacity_of(0.5f * held.optical_depth));
}

}  // namespace opacity
