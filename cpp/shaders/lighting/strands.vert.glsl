// Ribbons that face the camera, joined along their common tangents.
#include "lib/segment.glsl"

uniform float u_width_scale;
#ifdef OWN_CORRECTION
#include "lib/light.glsl"
#include "lib/ribbon.glsl"
#endif
#include "lib/strand_end.glsl"

#ifdef ALONG_STRANDS
// Where this segment's shadows stand (strand_shadows.comp.glsl): the first of them, and the steps from
// its root to its tip.
layout(std430) readonly buffer b_strand_places { ivec2 strand_places[]; };
uniform int u_shape_index;
flat out ivec2 v_strand_place;
out float v_along;
#endif

// The mean direction of the segments that meet at an end of this one.
vec3 tangent_at(int segment, int point, bool at_tip) {
    bool joined = goes_on(segment, at_tip);
    vec3 here = view_position(points[point].xyz);
    int before = at_tip || joined ? point - 1 : point;
    int after = !at_tip || joined ? point + 1 : point;
    vec3 incoming = unit(here - view_position(points[before].xyz));
    vec3 outgoing = unit(view_position(points[after].xyz) - here);
    return unit(incoming + outgoing);
}

#ifdef OWN_CORRECTION
flat out vec3 v_own_direction;
out float v_own_width_texels;
out vec2 v_own_ends;

void tell_own_segment(int segment, bool at_tip) {
    StrandEnd end = strand_end(segment, at_tip);
    v_own_direction = end.direction;
    v_own_ends = end.ends;
    v_own_width_texels = end.width_texels;
    v_own_opacity = end.opacity;
}
#endif

void main() {
    int segment = segment_index();
    vec2 corner = segment_corner();
    bool at_tip = corner.x > 0.5;
    int point = int(segments[segment]) + (at_tip ? 1 : 0);
    v_axis_vs = tangent_at(segment, point, at_tip);
    vec3 center = view_position(points[point].xyz);
    vec3 side = unit(cross(v_axis_vs, center));
    v_p_vs = center + side * (0.5 * corner.y * points[point].w * u_width_scale);
    v_p_ls = (u_light_from_local * vec4(points[point].xyz, 1.0)).xyz;
    v_color = color_of(point);
#ifdef TRANSLUCENT
    v_opacity = vertex_opacity(point);
#endif
#ifdef OWN_CORRECTION
    tell_own_segment(segment, at_tip);
#endif
#ifdef ALONG_STRANDS
    ivec2 place = strand_places[u_shape_index];
    v_strand_place = ivec2(place.x + segment * (place.y + 1), place.y);
    v_along = corner.x;
#endif
    gl_Position = u_camera_clip_from_view * vec4(v_p_vs, 1.0);
}
