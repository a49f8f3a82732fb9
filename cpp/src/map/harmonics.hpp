// Cosine and sine of the multiples of an angle: each is the one before, turned once more (Jansen
// and Bavoil 2010, section 4.1). The angle is reduced first, since float32 rounds large ones. GLSL:
// lib/harmonics.glsl.
#pragma once

#include <cmath>
#include <numbers>

namespace opacity {

inline constexpr float two_pi = 2.f * std::numbers::pi_v<float>;

struct Turn {
    float cosine = 1.f, sine = 0.f;
};

// 1 is all the way round.
inline Turn turn_of(float turns) {
    const float angle = two_pi * (turns - std::round(turns));
    return {std::cos(angle), std::sin(angle)};
}

inline Turn turned(const Turn& turn, const Turn& by) {
    return {turn.cosine * by.cosine - turn.sine * by.sine,
            turn.sine * by.cosine + turn.cosine * by.sine};
}

// How much smaller a harmonic is on average over an interval than in its middle: sin(x) / x. A
// point, which takes no turn, is not.
inline float spread(float sine, float angle) {
    return angle > 0.f ? sine / angle : 1.f;
}

}  // namespace opacity
