// 1, cos pi z, cos 2 pi z ..: what lies beyond either end is a mirror image, so that nothing is the
// neighbour of what lies at the other end. C++: map/bases/cosine.hpp.
#include "lib/harmonics.glsl"

struct Integrals {
    vec2 at, step;
    float d;
};

Means means_over(float begin, float end) { return harmonics_over(0.5 * begin, 0.5 * end); }

float next_mean(inout Means means, int k) {
    if (k == 0) return 1.0;
    turn_on(means);
    return means.at.x * spread_of(means, k);
}

Integrals integrals_to(float d) { return Integrals(vec2(1.0, 0.0), turn_of(0.5 * d), d); }

float next_integral(inout Integrals integrals, int k) {
    if (k == 0) return integrals.d;
    integrals.at = turned(integrals.at, integrals.step);
    return 4.0 / (two_pi * float(k)) * integrals.at.y;
}

float whole_integral(int k) { return k == 0 ? 1.0 : 0.0; }
