// 1, cos 2 pi z, sin 2 pi z, cos 4 pi z ..: Jansen and Bavoil 2010, equations 1 to 3, 5 and 6, whose
// factors 2 stand in g. With an even number of coefficients the last sine is left out. C++:
// map/bases/fourier.hpp.
#include "lib/harmonics.glsl"

struct Integrals {
    vec2 at, step;
};

Means means_over(float begin, float end) { return harmonics_over(begin, end); }

float next_mean(inout Means means, int k) {
    if (k == 0) return 1.0;
    bool is_cosine = k % 2 == 1;
    if (is_cosine) turn_on(means);
    return spread_of(means, (k + 1) / 2) * (is_cosine ? means.at.x : means.at.y);
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
