// 1 in the k-th of equal cells, 0 elsewhere: the slices of Kim and Neumann 2001 (Jansen and Bavoil
// 2010, section 5.1). A caster between two cells is of the one behind. C++:
// map/bases/piecewise_constant.hpp.
#include "lib/interval.glsl"

struct Means {
    float begin, end;
};
struct Integrals {
    float cells;
};

Means means_over(float begin, float end) { return Means(begin, end); }

// The part of a caster behind the k-th border, which it may lie on.
float part_behind(Means means, int k) {
    if (k == 0) return 1.0;
    if (k >= COEFFICIENTS) return 0.0;
    float border = float(k) / float(COEFFICIENTS);
    if (means.end > means.begin) return 1.0 - part_in_front(means.begin, means.end, border);
    return means.begin >= border ? 1.0 : 0.0;
}

float next_mean(inout Means means, int k) { return part_behind(means, k) - part_behind(means, k + 1); }

Integrals integrals_to(float d) { return Integrals(d * float(COEFFICIENTS)); }

float next_integral(inout Integrals integrals, int k) { return clamp(integrals.cells - float(k), 0.0, 1.0); }

float whole_integral(int k) { return 1.0; }
