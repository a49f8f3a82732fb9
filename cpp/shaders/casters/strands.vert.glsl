// A segment becomes the parallelogram that holds every texel which its ribbon touches.
#include "lib/segment.glsl"

uniform float u_width_scale;  // shape's units to world units

precise flat out vec3 v_root, v_tip;   // light space
precise flat out vec2 v_width_texels;  // at both ends
#ifdef OPTICAL_DEPTH
flat out vec2 v_opacity;
#endif

void main() {
    uint first = segments[segment_index()];
    vec4 root = points[first], tip = points[first + 1u];
    v_root = (u_light_from_local * vec4(root.xyz, 1.0)).xyz;
    v_tip = (u_light_from_local * vec4(tip.xyz, 1.0)).xyz;
    v_width_texels = vec2(root.w, tip.w) * (u_width_scale * u_light_texels_per_unit);
#ifdef OPTICAL_DEPTH
    int i = int(first) * u_opacity_stride;
    v_opacity = vec2(opacity[i], opacity[i + u_opacity_stride]);
#endif

    vec2 a = v_root.xy, d = v_tip.xy - v_root.xy;
    bool steep = abs(d.y) > abs(d.x);
    if (steep) a = a.yx, d = d.yx;
    if (d.x == 0.0) {  // along the light: no area, no texel
        gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
        return;
    }
    float slope = d.y / d.x;
    float half_width = 0.5 * max(v_width_texels.x, v_width_texels.y) * sqrt(1.0 + slope * slope);
    float reach = half_width + 0.5 + 1.0 / 64.0;  // more than rasterisers round corners by
    vec2 corner = segment_corner();
    vec2 columns = vec2(floor(min(a.x, a.x + d.x)), ceil(max(a.x, a.x + d.x)));
    float x = mix(columns.x, columns.y, corner.x);
    vec2 p = vec2(x, a.y + slope * (x - a.x) + corner.y * reach);
    gl_Position = clip_from_texels(steep ? p.yx : p);
}
