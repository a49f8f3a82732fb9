// 1 in the k-th of equal cells, 0 elsewhere: the slices of Kim and Neumann 2001 (Jansen and Bavoil
// 2010, section 5.1). A caster between two cells is of the one behind. GLSL:
// lib/bases/piecewise_constant.glsl.
#pragma once

#include <algorithm>

#include "map/basis.hpp"
#include "map/interval.hpp"

namespace opacity::piecewise_constant {

// The part of a caster behind the k-th border, which it may lie on.
inline float part_behind(float begin, float end, std::size_t k, std::size_t count) {
    if (k == 0) return 1.f;
    if (k == count) return 0.f;
    const float border = float(k) / float(count);
    if (end > begin) return 1.f - part_in_front(begin, end, border);
    return begin >= border ? 1.f : 0.f;
}

inline void means(float begin, float end, std::span<float> f) {
    for (std::size_t k = 0; k < f.size(); ++k)
        f[k] = part_behind(begin, end, k, f.size()) - part_behind(begin, end, k + 1, f.size());
}

inline void integrals(float d, std::span<float> g) {
    for (std::size_t k = 0; k < g.size(); ++k)
        g[k] = std::clamp(d * float(g.size()) - float(k), 0.f, 1.f);
}

inline float whole(std::size_t) {
    return 1.f;
}
inline double frequency(std::size_t) {
    return 0.0;
}

inline constexpr Basis basis{"piecewise_constant", means, integrals, whole, frequency};

}  // namespace opacity::piecewise_constant
