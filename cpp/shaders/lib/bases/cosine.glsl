// 1, cos pi z, cos 2 pi z ..: what lies beyond either end is a mirror image, so that nothing is the
// neighbour of what lies at the other end. C++: map/bases/cosine.hpp.
#include "lib/harmonics.glsl"

struct Means {
    vec2 at, wide;       // of the harmonic so far
    vec2 middle, width;  // of the first
    float half_turns;
};
struct Integrals {
    vec2 at, step;
    float d;
};

Means means_over(float begin, float end) {
    float half_turns = 0.25 * (end - begin);
    vec2 middle = turn_of(0.5 * begin + half_turns), width = turn_of(half_turns);
    return Means(vec2(1.0, 0.0), vec2(1.0, 0.0), middle, width, half_turns);
}

float next_mean(inout Means means, int k) {
    if (k == 0) return 1.0;
    means.at = turned(means.at, means.middle);
    means.wide = turned(means.wide, means.width);
    return means.at.x * spread(means.wide.y, two_pi * means.half_turns * float(k));
}

Integrals integrals_to(float d) { return Integrals(vec2(1.0, 0.0), turn_of(0.5 * d), d); }

float next_integral(inout Integrals integrals, int k) {
    if (k == 0) return integrals.d;
    integrals.at = turned(integrals.at, integrals.step);
    return 4.0 / (two_pi * float(k)) * integrals.at.y;
}

float whole_integral(int k) { return k == 0 ? 1.0 : 0.0; }
