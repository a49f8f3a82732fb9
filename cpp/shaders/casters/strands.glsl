// A segment as the light sees it: a line in the face that it is drawn on, with a width at both ends.
#include "lib/drawn_caster.glsl"
#include "lib/ribbon.glsl"
#include "lib/segment.glsl"

uniform float u_width_scale;  // shape's units to world units

TOLD vec3 v_root, v_tip;   // light space
TOLD vec2 v_width_texels;  // at both ends
#ifdef LIGHT_FACES
TOLD vec3 v_root_q, v_tip_q;  // light coordinates
TOLD vec2 v_forward;          // of both ends, before the face
#endif
#ifdef OPTICAL_DEPTH
TOLD vec2 v_opacity;
#endif

#ifndef STAGE_FRAGMENT
#ifdef LIGHT_FACES
// Cuts off what is not before the face, and sees the rest through it; false where nothing is left.
bool see_segment(vec2 width) {
    float a = seen_by(drawn_face(), v_root_q).z, b = seen_by(drawn_face(), v_tip_q).z;
    const float least = 1.001 * least_forward;
    if (max(a, b) <= least) return false;
    vec2 ends = vec2(0.0, 1.0);
    if (a < least) ends.x = (least - a) / (b - a);
    if (b < least) ends.y = (least - a) / (b - a);
    vec3 root = v_root_q, along = v_tip_q - v_root_q;
    v_root_q = root + ends.x * along;
    v_tip_q = root + ends.y * along;
    v_forward = mix(vec2(a), vec2(b), ends);
    width = mix(width.xx, width.yy, ends);
#ifdef OPTICAL_DEPTH
    v_opacity = mix(v_opacity.xx, v_opacity.yy, ends);
#endif
    v_root = place_by(drawn_face(), v_root_q);
    v_tip = place_by(drawn_face(), v_tip_q);
    v_width_texels = vec2(ribbon_width_by(drawn_face(), v_root_q, along, width.x),
                          ribbon_width_by(drawn_face(), v_tip_q, along, width.y));
    return true;
}
#endif

// False where it leaves nothing in the map.
bool place_segment(int segment) {
    uint first = segments[segment];
    vec4 root = points[first], tip = points[first + 1u];
    vec3 root_ls = (u_light_from_local * vec4(root.xyz, 1.0)).xyz;
    vec3 tip_ls = (u_light_from_local * vec4(tip.xyz, 1.0)).xyz;
#ifdef OPTICAL_DEPTH
    int i = int(first) * u_opacity_stride;
    v_opacity = vec2(opacity[i], opacity[i + u_opacity_stride]);
#endif
#ifdef LIGHT_FACES
    v_root_q = root_ls, v_tip_q = tip_ls;
    if (!see_segment(vec2(root.w, tip.w) * u_width_scale / u_light_depth_range)) return false;
#else
    v_root = drawn_place(root_ls), v_tip = drawn_place(tip_ls);
    v_width_texels = vec2(root.w, tip.w) * (u_width_scale * drawn_texels_per_unit());
#endif
    return v_root.xy != v_tip.xy;  // along the light: no area
}

// Those that the segment reaches into, from the first to behind the last one.
vec2 columns_of(MajorSegment s) {
    vec2 ends = vec2(s.root.x, s.root.x + s.along.x);
    return vec2(floor(min(ends.x, ends.y)), ceil(max(ends.x, ends.y)));
}
#endif
