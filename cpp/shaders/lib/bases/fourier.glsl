// 1, cos 2 pi z, sin 2 pi z, cos 4 pi z ..: Jansen and Bavoil 2010, equations 1 to 3, 5 and 6, whose
// factors 2 stand in g. With an even number of coefficients the last sine is left out. C++:
// map/bases/fourier.hpp.
#include "lib/harmonics.glsl"

struct Means {
    vec2 at, wide;       // of the harmonic so far
    vec2 middle, width;  // of the first
    float half_turns;
};
struct Integrals {
    vec2 at, step;
};

Means means_over(float begin, float end) {
    float half_turns = 0.5 * (end - begin);
    vec2 middle = turn_of(begin + half_turns), width = turn_of(half_turns);
    return Means(vec2(1.0, 0.0), vec2(1.0, 0.0), middle, width, half_turns);
}

float next_mean(inout Means means, int k) {
    if (k == 0) return 1.0;
    int harmonic = (k + 1) / 2;
    bool is_cosine = k % 2 == 1;
    if (is_cosine) {
        means.at = turned(means.at, means.middle);
        means.wide = turned(means.wide, means.width);
    }
    float part = spread(means.wide.y, two_pi * means.half_turns * float(harmonic));
    return part * (is_cosine ? means.at.x : means.at.y);
}

Integrals integrals_to(float d) { return Integrals(vec2(1.0, d), turn_of(d)); }

float next_integral(inout Integrals integrals, int k) {
    if (k == 0) {
        float d = integrals.at.y;
        integrals.at.y = 0.0;
        return d;
    }
    bool is_cosine = k % 2 == 1;
    if (is_cosine) integrals.at = turned(integrals.at, integrals.step);
    return (is_cosine ? integrals.at.y : 1.0 - integrals.at.x) * (2.0 / (two_pi * float((k + 1) / 2)));
}

float whole_integral(int k) { return k == 0 ? 1.0 : 0.0; }
