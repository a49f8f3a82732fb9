// Legendre polynomials of 2 z - 1, whose factors 2 k + 1 stand in g. GLSL: lib/bases/legendre.glsl.
#pragma once

#include "map/basis.hpp"

namespace opacity::legendre {

// Over an interval, of one polynomial after the other.
struct OverInterval {
    float mean = 0.f, difference = 0.f;  // of both ends; their difference by the interval's length
};

// P_(k + 1), of t P_k and P_(k - 1).
inline float next(std::size_t k, float by_t, float before) {
    return (float(2 * k + 1) * by_t - float(k) * before) / float(k + 1);
}

// Over an interval of half length h about m, t P_k has the mean m A + h^2 D, and the difference
// m D + A. So no digits are lost, however short it is. D of P_(k + 1) less D of P_(k - 1) is 2 k +
// 1 times the mean of P_k.
inline void means(float begin, float end, std::span<float> f) {
    const float m = begin + end - 1.f, h = end - begin;
    OverInterval before, here{1.f, 0.f};
    for (std::size_t k = 0; k < f.size(); ++k) {
        const OverInterval ahead{next(k, m * here.mean + h * h * here.difference, before.mean),
                                 next(k, m * here.difference + here.mean, before.difference)};
        f[k] = (ahead.difference - before.difference) / float(2 * k + 1);
        before = here, here = ahead;
    }
}

inline void integrals(float d, std::span<float> g) {
    const float t = 2.f * d - 1.f;
    float before = 1.f, here = t;
    g[0] = d;
    for (std::size_t k = 1; k < g.size(); ++k) {
        const float ahead = next(k, t * here, before);
        g[k] = 0.5f * (ahead - before);
        before = here, here = ahead;
    }
}

inline constexpr Basis basis{"legendre", means, integrals};

}  // namespace opacity::legendre
