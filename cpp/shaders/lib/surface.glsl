// A surface in the map is moved away from the light by its own slope over one texel, the reach of
// the look-up's taps, so that no texel shadows its neighbour on the same plane; at silhouettes,
// where the slope is unbounded, by eight texels. C++: map/surface.hpp.
#include "lib/light.glsl"

float largest_surface_margin(float texels_per_unit) { return 8.0 / (texels_per_unit * u_light_depth_range); }

// `slope` is the change of depth by texel along x and y.
float surface_margin(vec2 slope, float texels_per_unit) {
    return min(abs(slope.x) + abs(slope.y), largest_surface_margin(texels_per_unit));
}

// The slope of the plane that two vectors of light space span; beyond every margin where the light
// grazes it.
vec2 surface_slope(vec3 a, vec3 b) {
    vec3 normal = cross(a, b);
    return abs(normal.z) > 1e-20 ? -normal.xy / normal.z : vec2(1e20);
}

// No steeper than what the margin makes up for.
vec2 limited_slope(vec2 slope, float texels_per_unit) {
    float steepness = abs(slope.x) + abs(slope.y), limit = largest_surface_margin(texels_per_unit);
    return steepness > limit ? slope * (limit / steepness) : slope;
}
