// The slope of surfaces in the map. A receiver on a surface knows its own, and looks texels up along
// that plane. For points that may lie on any surface the opaque casters have a second depth map, in
// which each is moved away from the light by its slope over one texel, the reach of the look-up's
// taps, so that no texel shadows its neighbour on the same plane; at silhouettes, where the slope is
// unbounded, by eight texels. C++: map/surface.hpp.
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

// How far the plane of a receiver is believed to go on along the light, `offset` texels away.
float plane_limit(vec2 offset, float texels_per_unit) {
    return largest_surface_margin(texels_per_unit) * max(1.0, max(abs(offset.x), abs(offset.y)));
}

// How much deeper it lies there.
float plane_change(vec2 slope, vec2 offset, float texels_per_unit) {
    float limit = plane_limit(offset, texels_per_unit);
    return clamp(dot(slope, offset), -limit, limit);
}
