// 1, cos pi z, cos 2 pi z ..: what lies beyond either end is a mirror image, so that nothing is the
// neighbour of what lies at the other end. GLSL: lib/bases/cosine.glsl.
#pragma once

#include "map/basis.hpp"
#include "map/harmonics.hpp"

namespace opacity::cosine {

inline void means(float begin, float end, std::span<float> f) {
    const float half_turns = 0.25f * (end - begin);
    const Turn middle = turn_of(0.5f * begin + half_turns), width = turn_of(half_turns);
    Turn at, wide;
    for (std::size_t k = 0; k < f.size(); ++k) {
        f[k] = at.cosine * spread(wide.sine, two_pi * half_turns * float(k));
        at = turned(at, middle), wide = turned(wide, width);
    }
}

inline void integrals(float d, std::span<float> g) {
    g[0] = d;
    const Turn step = turn_of(0.5f * d);
    Turn at = step;
    for (std::size_t k = 1; k < g.size(); ++k) {
        g[k] = 4.f / (two_pi * float(k)) * at.sine;
        at = turned(at, step);
    }
}

inline float whole(std::size_t k) {
    return k == 0 ? 1.f : 0.f;
}
inline double frequency(std::size_t k) {
    return double(k);
}
inline double margin(std::size_t) {
    return 0.0;
}

inline constexpr Basis basis{"cosine", means, integrals, whole, frequency, margin};

}  // namespace opacity::cosine
