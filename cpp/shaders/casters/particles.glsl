// A particle as the light sees it: a disc in the face that it is drawn on.
#include "lib/drawn_caster.glsl"
#include "lib/sphere.glsl"

layout(std430) readonly buffer b_points { vec4 points[]; };  // w: radius
uniform float u_width_scale;  // shape's units to world units

TOLD vec3 v_center;  // light space
TOLD float v_radius_texels;
#ifdef LIGHT_FACES
TOLD vec4 v_sphere;  // light coordinates, w: radius
#endif
#ifdef OPTICAL_DEPTH
TOLD float v_opacity;
#endif

#ifndef STAGE_FRAGMENT
#ifdef LIGHT_FACES
// The square that a sphere covers on the face: all of it where the light is near.
void see_sphere(out vec2 low, out vec2 high) {
    vec3 r = seen_by(drawn_face(), v_sphere.xyz);
    float distance = length(r);
    low = vec2(0.0), high = vec2(u_light_map_size_px);
    v_center = vec3(0.0);
    v_radius_texels = 1e9;
    if (!(v_sphere.w < near_sphere * distance)) return;
    if (r.z < 2.0 * v_sphere.w + least_forward) {  // behind the face, or beside it beyond 170 degrees
        high = low;
        return;
    }
    v_center = place_by(drawn_face(), v_sphere.xyz);
    // The picture of a sphere is an ellipse: the circle of its area, and the square around it.
    float texels = focal_px(drawn_face()) * v_sphere.w / r.z, stretch = distance / r.z;
    v_radius_texels = texels * sqrt(stretch);
    low = floor(v_center.xy - texels * stretch * 1.1), high = ceil(v_center.xy + texels * stretch * 1.1);
}
#endif

// `low` to `high`: the square of all texels that its disc touches.
void place_particle(int particle, out vec2 low, out vec2 high) {
    vec4 p = points[particle];
    vec3 center = (u_light_from_local * vec4(p.xyz, 1.0)).xyz;
#ifdef OPTICAL_DEPTH
    v_opacity = opacity[particle * u_opacity_stride];
#endif
#ifdef LIGHT_FACES
    v_sphere = vec4(center, p.w * u_width_scale / u_light_depth_range);
    see_sphere(low, high);
#else
    v_center = drawn_place(center);
    v_radius_texels = p.w * (u_width_scale * drawn_texels_per_unit());
    low = floor(v_center.xy - v_radius_texels), high = ceil(v_center.xy + v_radius_texels);
#endif
}
#endif
