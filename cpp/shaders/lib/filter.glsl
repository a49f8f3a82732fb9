// How much each texel counts in a look-up: the integral of the filter's kernel over the texel, so
// that nothing jumps when a texel enters. On each axis alone. C++: map/filter.hpp.

uniform float u_filter_radius;  // texels
uniform float u_filter_width;   // world units; negative: as the radius says

const float largest_filter_radius = 32.0;  // texels

float wanted_radius_texels(float texels_per_unit) {
    return u_filter_width < 0.0 ? u_filter_radius : 0.5 * u_filter_width * texels_per_unit;
}

float filter_radius_texels(float texels_per_unit) {
    return clamp(wanted_radius_texels(texels_per_unit), 1.0 / 1024.0, largest_filter_radius);
}

// erf to 1.5e-7: Abramowitz and Stegun 1964, 7.1.26.
float error_function(float x) {
    float t = 1.0 / (1.0 + 0.3275911 * abs(x));
    float tail = t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429))));
    return sign(x) * (1.0 - tail * exp(-x * x));
}

// The part of the kernel left of u, where it reaches from -1 to 1.
float filter_sum(float u) {
    u = clamp(u, -1.0, 1.0);
#if defined(FILTER_bartlett)
    return u < 0.0 ? 0.5 * (1.0 + u) * (1.0 + u) : 1.0 - 0.5 * (1.0 - u) * (1.0 - u);
#elif defined(FILTER_gaussian)
    const float edge = 0.95449974;  // erf(2 / sqrt(2)): the radius is two standard deviations
    return 0.5 + 0.5 * error_function(1.41421356 * u) / edge;
#else
    return 0.5 + 0.5 * u;
#endif
}

// Of the texel from `begin` to begin + 1, beside a receiver at 0.
float filter_weight(float begin, float radius) {
    return filter_sum((begin + 1.0) / radius) - filter_sum(begin / radius);
}
