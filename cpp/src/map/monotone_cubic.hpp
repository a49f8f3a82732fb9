// A cubic between the middle two of four points that rises wherever they do, so that T never grows
// along the light (Steffen 1990). GLSL: lib/monotone_cubic.glsl.
#pragma once

#include <algorithm>
#include <array>

namespace opacity {

// At a point between two secants, none below 0, over so wide steps.
inline float monotone_slope(float secant_before, float secant_behind, float width_before,
                            float width_behind) {
    const float parabola = (secant_before * width_behind + secant_behind * width_before) /
                           (width_before + width_behind);
    return std::min(parabola, 2.f * std::min(secant_before, secant_behind));
}

inline float monotone_cubic(const std::array<float, 4>& places, const std::array<float, 4>& values,
                            float x) {
    const auto width = [&](int i) { return places[i + 1] - places[i]; };
    const auto secant = [&](int i) {
        return std::max((values[i + 1] - values[i]) / width(i), 0.f);
    };
    const float t = (x - places[1]) / width(1), rest = 1.f - t;
    const float begin = monotone_slope(secant(0), secant(1), width(0), width(1));
    const float end = monotone_slope(secant(1), secant(2), width(1), width(2));
    return values[1] + (values[2] - values[1]) * t * t * (3.f - 2.f * t) +
           width(1) * t * rest * (begin * rest - end * t);
}

}  // namespace opacity
