// 1, cos pi z, cos 2 pi z ..: what lies beyond either end is a mirror image, so that nothing is the
// neighbour of what lies at the other end. GLSL: lib/bases/cosine.glsl.
#pragma once

#include "map/basis.hpp"
#include "map/harmonics.hpp"

namespace opacity::cosine {

inline void means(float begin, float end, std::span<float> f) {
    HarmonicMeans harmonics{0.5f * begin, 0.5f * end};
    f[0] = 1.f;
    for (std::size_t k = 1; k < f.size(); ++k) {
        harmonics.turn_on();
        f[k] = harmonics.at().cosine * harmonics.spread(k);
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

inline constexpr Basis basis{"cosine", means, integrals};

}  // namespace opacity::cosine
