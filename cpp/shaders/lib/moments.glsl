// Power moments of where optical depth lies along a texel (Muenstermann et al. 2018): sums of it times
// z^k, z from -1 to 1; MOMENTS of them, besides the sum itself. Of all ways to lay out casters with
// these moments, the one that has a caster at the place asked about (the canonical one) has the most
// of them there, and the least, or with it the most, in front. C++, in float64: map/moments.hpp.

const int half_moments = MOMENTS / 2;  // casters of that layout, besides the one at the place

// Over an interval of half length h about m, means A and differences D over it, by its length, of one
// power after the other: z^(k+1) has the mean m A + h^2 D and the difference m D + A, which is k + 1
// times the mean of z^k.
struct Means {
    float mean, difference;
    float m, h;
};

Means caster_means(float begin, float end) { return Means(1.0, 0.0, begin + end - 1.0, end - begin); }

float next_mean(inout Means means, int k) {
    float ahead = means.m * means.difference + means.mean;
    means.mean = means.m * means.mean + means.h * means.h * means.difference;
    means.difference = ahead;
    return ahead / float(k + 1);
}

#ifndef PASS_coefficients
struct Sums {
    float b[MOMENTS + 1];
    float z;
};

Sums sums_at(float x) {
    Sums sums;
    sums.z = 2.0 * x - 1.0;
    return sums;
}

void add(inout Sums sums, int k, float c) { sums.b[k] = c; }

float whole_optical_depth(Sums sums) { return sums.b[0]; }

// Moved a little toward the moments of an even layout, so that rounding leaves them possible:
// Muenstermann et al. 2018, table 1.
#if MOMENTS == 4
const float bias_part = 5e-7;
const float bias_moments[MOMENTS] = float[MOMENTS](0.0, 0.375, 0.0, 0.375);
#elif MOMENTS == 6
const float bias_part = 5e-6;
const float bias_moments[MOMENTS] = float[MOMENTS](0.0, 0.48, 0.0, 0.451, 0.0, 0.45);
#else
const float bias_part = 5e-5;
const float bias_moments[MOMENTS] = float[MOMENTS](0.0, 0.75, 0.0, 0.67666666, 0.0, 0.63, 0.0, 0.60030303);
#endif

const float overestimation = 0.25;  // of what may lie at the place itself, or in front of it
const float far = 8.0;              // what lies beyond holds next to nothing
const float least_pivot = 0.1;      // of the bias's part: below, moments are of no layout
const int refinements = 24;

// Polynomials that are orthonormal by the moments, of degrees 0 .. half_moments, by their recurrence:
//     step_k p_(k+1) = (x - middle_k) p_k - step_(k-1) p_(k-1)
// Whatever rounding makes of its numbers, they are those of some layout.
struct Orthonormal {
    float middle[half_moments], step[half_moments];
};

// From the Cholesky factor of the matrix b_(i+j), whose pivots are no less than `least`.
Orthonormal orthonormal(float b[MOMENTS + 1], float least) {
    float factor[half_moments + 1][half_moments + 1];
    for (int i = 0; i <= half_moments; ++i)
        for (int j = 0; j <= i; ++j) {
            float rest = b[i + j];
            for (int k = 0; k < j; ++k) rest -= factor[i][k] * factor[j][k];
            factor[i][j] = i == j ? sqrt(max(rest, least)) : rest / factor[j][j];
        }
    Orthonormal o;
    float before = 0.0;
    for (int k = 0; k < half_moments; ++k) {
        float here = factor[k + 1][k] / factor[k][k];
        o.middle[k] = here - before;
        o.step[k] = factor[k + 1][k + 1] / factor[k][k];
        before = here;
    }
    return o;
}

// All of them at x.
float[half_moments + 1] values(Orthonormal o, float x) {
    float p[half_moments + 1];
    p[0] = 1.0;
    for (int k = 0; k < half_moments; ++k) {
        float before = k > 0 ? o.step[k - 1] * p[k - 1] : 0.0;
        p[k + 1] = ((x - o.middle[k]) * p[k] - before) / o.step[k];
    }
    return p;
}

// The most that may lie at x: Christoffel's number.
float most_at(Orthonormal o, float x) {
    float p[half_moments + 1] = values(o, x);
    float sum = 0.0;
    for (int i = 0; i <= half_moments; ++i) sum += p[i] * p[i];
    return 1.0 / sum;
}

// The sum of y_k p_k, by powers: where it is 0 the others of a canonical layout lie.
float[half_moments + 1] kernel(Orthonormal o, float y[half_moments + 1]) {
    float p[half_moments + 1][half_moments + 1], sum[half_moments + 1];
    for (int i = 0; i <= half_moments; ++i) {
        sum[i] = i == 0 ? y[0] : 0.0;
        p[0][i] = i == 0 ? 1.0 : 0.0;
    }
    for (int k = 0; k < half_moments; ++k)
        for (int i = 0; i <= half_moments; ++i) {
            float times_x = i > 0 ? p[k][i - 1] : 0.0;
            float before = k > 0 ? o.step[k - 1] * p[k - 1][i] : 0.0;
            p[k + 1][i] = (times_x - o.middle[k] * p[k][i] - before) / o.step[k];
            sum[i] += y[k + 1] * p[k + 1][i];
        }
    return sum;
}

float bounded_quotient(float above, float below) {
    if (abs(above) < far * abs(below)) return above / below;
    return (above < 0.0) == (below < 0.0) ? far : -far;
}

// Of c + b x + a x^2, without the digits that the usual formula loses.
vec2 quadratic_roots(float c, float b, float a) {
    float root = sqrt(max(b * b - 4.0 * a * c, 0.0));
    float t = -0.5 * (b < 0.0 ? b - root : b + root);
    float first = bounded_quotient(t, a), second = t == 0.0 ? first : bounded_quotient(c, t);
    return vec2(min(first, second), max(first, second));
}

#if MOMENTS > 4
// Of a polynomial of up to the fourth degree, by powers.
float value_of(float p[5], float x) { return p[0] + x * (p[1] + x * (p[2] + x * (p[3] + x * p[4]))); }
float slope_of(float p[5], float x) { return p[1] + x * (2.0 * p[2] + x * (3.0 * p[3] + x * 4.0 * p[4])); }

// Where p changes sign between two places, by Newton's steps while they stay between.
float root_between(float p[5], float low, float high, float otherwise) {
    bool rises = value_of(p, low) < 0.0;
    if (rises == value_of(p, high) < 0.0) return otherwise;
    float x = 0.5 * (low + high);
    for (int i = 0; i < refinements; ++i) {
        float y = value_of(p, x);
        if ((y < 0.0) == rises) low = x;
        else high = x;
        float former = x;
        x -= y / slope_of(p, x);
        if (!(x > low && x < high)) x = 0.5 * (low + high);
        if (x == former) break;
    }
    return x;
}

// Between those of the derivative, in their order. Only the outer ones can be farther.
vec3 cubic_roots(float p[5]) {
    vec2 turns = quadratic_roots(p[1], 2.0 * p[2], 3.0 * p[3]);
    return vec3(root_between(p, -far, turns.x, -far), root_between(p, turns.x, turns.y, turns.y),
                root_between(p, turns.y, far, far));
}

vec4 quartic_roots(float p[5]) {
    vec3 turns = cubic_roots(float[5](p[1], 2.0 * p[2], 3.0 * p[3], 4.0 * p[4], 0.0));
    return vec4(root_between(p, -far, turns.x, -far), root_between(p, turns.x, turns.y, turns.y),
                root_between(p, turns.y, turns.z, turns.z), root_between(p, turns.z, far, far));
}
#endif

// Where the others of the layout lie; those that are none are far.
vec4 other_places(float q[half_moments + 1]) {
#if MOMENTS == 4
    return vec4(quadratic_roots(q[0], q[1], q[2]), far, far);
#elif MOMENTS == 6
    return vec4(cubic_roots(float[5](q[0], q[1], q[2], q[3], 0.0)), far);
#else
    return quartic_roots(q);
#endif
}

// One of Newton's steps toward the kernel's root, by the recurrence, which rounds less than powers do:
// what may lie at a place falls off steeply beside it.
float polished(Orthonormal o, float y[half_moments + 1], float x) {
    float p[half_moments + 1] = values(o, x);
    float value = y[0], slope = 0.0;
    vec2 slopes = vec2(0.0);  // of p_(k-1) and p_k
    for (int k = 0; k < half_moments; ++k) {
        float before = k > 0 ? o.step[k - 1] * slopes.x : 0.0;
        slopes = vec2(slopes.y, ((x - o.middle[k]) * slopes.y + p[k] - before) / o.step[k]);
        value += y[k + 1] * p[k + 1];
        slope += y[k + 1] * slopes.y;
    }
    float moved = x - value / slope;
    return abs(moved - x) < 0.1 ? moved : x;
}

// Rounding is that of all the texel holds, also of what was taken out.
float optical_depth_before(Sums sums, float all) {
    float others = sums.b[0];
    if (!(others > 0.0)) return 0.0;
    float part_of_bias = min(bias_part * max(all / others, 1.0), 1.0);
    float b[MOMENTS + 1];
    b[0] = 1.0;
    for (int k = 1; k <= MOMENTS; ++k) b[k] = mix(sums.b[k] / others, bias_moments[k - 1], part_of_bias);
    Orthonormal o = orthonormal(b, least_pivot * part_of_bias);
    float y[half_moments + 1] = values(o, sums.z);
    vec4 places = other_places(kernel(o, y));
    float part = overestimation * most_at(o, sums.z);
    for (int i = 0; i < half_moments; ++i)
        if (places[i] < sums.z) part += most_at(o, polished(o, y, polished(o, y, places[i])));
    return others * part;
}
#endif
