// Legendre polynomials of 2 z - 1, whose factors 2 k + 1 stand in g. C++: map/bases/legendre.hpp.

// Over an interval of half length h about m, means A and differences D over it, by its length, of one
// polynomial after the other: t P_k has the mean m A + h^2 D, and the difference m D + A. So no digits
// are lost, however short it is. D of P_(k+1) less D of P_(k-1) is 2 k + 1 times the mean of P_k.
struct Means {
    vec2 before, here;  // A and D
    float m, h;
};
struct Integrals {
    float before, here;
    float t;
};

Means means_over(float begin, float end) {
    return Means(vec2(0.0), vec2(1.0, 0.0), begin + end - 1.0, end - begin);
}

float next_mean(inout Means means, int k) {
    vec2 by_t = means.m * means.here + vec2(means.h * means.h * means.here.y, means.here.x);
    vec2 ahead = (float(2 * k + 1) * by_t - float(k) * means.before) / float(k + 1);
    float mean = (ahead.y - means.before.y) / float(2 * k + 1);
    means.before = means.here;
    means.here = ahead;
    return mean;
}

// The one before the first is -1, so that the first integral is d too.
Integrals integrals_to(float d) { return Integrals(-1.0, 1.0, 2.0 * d - 1.0); }

float next_integral(inout Integrals integrals, int k) {
    float t = integrals.t, before = integrals.before, here = integrals.here;
    float ahead = k == 0 ? t : (float(2 * k + 1) * t * here - float(k) * before) / float(k + 1);
    integrals.before = here;
    integrals.here = ahead;
    return 0.5 * (ahead - before);
}

float whole_integral(int k) { return k == 0 ? 1.0 : 0.0; }
