// 1, cos 2 pi z, sin 2 pi z, cos 4 pi z ..: Jansen and Bavoil 2010, equations 1 to 3, 5 and 6,
// whose factors 2 stand in g. With an even number of coefficients the last sine is left out. GLSL:
// lib/bases/fourier.glsl.
#pragma once

#include "map/basis.hpp"
#include "map/harmonics.hpp"

namespace opacity::fourier {

inline void means(float begin, float end, std::span<float> f) {
    HarmonicMeans harmonics{begin, end};
    f[0] = 1.f;
    for (std::size_t k = 1; 2 * k - 1 < f.size(); ++k) {
        harmonics.turn_on();
        f[2 * k - 1] = harmonics.at().cosine * harmonics.spread(k);
        if (2 * k < f.size()) f[2 * k] = harmonics.at().sine * harmonics.spread(k);
    }
}

inline void integrals(float d, std::span<float> g) {
    g[0] = d;
    const Turn step = turn_of(d);
    Turn at;
    for (std::size_t k = 1; 2 * k - 1 < g.size(); ++k) {
        at = turned(at, step);
        const float scale = 2.f / (two_pi * float(k));
        g[2 * k - 1] = scale * at.sine;
        if (2 * k < g.size()) g[2 * k] = scale * (1.f - at.cosine);
    }
}

inline double frequency(std::size_t k) {
    return double((k + 1) / 2);
}
// Else a caster at one end loses half of its shadow to the other.
inline double margin(std::size_t count) {
    return 1.0 / (3.0 * frequency(count - 1));
}

inline constexpr Basis basis{"fourier", means, integrals, first_whole, frequency, margin};

}  // namespace opacity::fourier
