// A particle becomes the square of all texels that its disc touches.
#include "lib/quad.glsl"

layout(std430) readonly buffer b_points { vec4 points[]; };  // w: radius
uniform float u_width_scale;  // shape's units to world units

precise flat out vec3 v_center;  // light space
precise flat out float v_radius_texels;
#ifdef OPTICAL_DEPTH
flat out float v_opacity;
#endif

void main() {
    int particle = quad_index();
    vec4 p = points[particle];
    v_center = (u_light_from_local * vec4(p.xyz, 1.0)).xyz;
    v_radius_texels = p.w * (u_width_scale * u_light_texels_per_unit);
#ifdef OPTICAL_DEPTH
    v_opacity = opacity[particle * u_opacity_stride];
#endif
    vec2 low = floor(v_center.xy - v_radius_texels), high = ceil(v_center.xy + v_radius_texels);
    gl_Position = clip_from_texels(mix(low, high, quad_corner()));
}
