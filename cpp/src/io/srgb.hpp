// The transfer curve of sRGB, IEC 61966-2-1: pictures store its values, light adds up in linear
// ones.
#pragma once

#include <cmath>

namespace opacity {

// Both of a value in 0..1.
inline float srgb_from_linear(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.f / 2.4f) - 0.055f;
}

inline float linear_from_srgb(float stored) {
    return stored <= 0.04045f ? stored / 12.92f : std::pow((stored + 0.055f) / 1.055f, 2.4f);
}

}  // namespace opacity
