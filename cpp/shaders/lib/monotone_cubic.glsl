// A cubic between the middle two of four points that rises wherever they do, so that T never grows
// along the light (Steffen 1990). C++: map/monotone_cubic.hpp.

// At a point between two secants, none below 0, over so wide steps.
float monotone_slope(vec2 secant, vec2 width) {
    float parabola = dot(secant, width.yx) / (width.x + width.y);
    return min(parabola, 2.0 * min(secant.x, secant.y));
}

float monotone_cubic(vec4 places, vec4 values, float x) {
    vec3 width = places.yzw - places.xyz;
    vec3 secant = max((values.yzw - values.xyz) / width, 0.0);
    float t = (x - places.y) / width.y, rest = 1.0 - t;
    float begin = monotone_slope(secant.xy, width.xy), end = monotone_slope(secant.yz, width.yz);
    return values.y + (values.z - values.y) * t * t * (3.0 - 2.0 * t) + width.y * t * rest * (begin * rest - end * t);
}
