// Ribbons that face the camera, joined along their common tangents.
#include "lib/segment.glsl"

uniform float u_width_scale;
uniform int u_segment_count;

// Whether the strand goes on beyond the segment's root or tip.
bool goes_on(int segment, bool at_tip) {
    int neighbour = at_tip ? segment + 1 : segment - 1;
    return neighbour >= 0 && neighbour < u_segment_count &&
           int(segments[neighbour]) == int(segments[segment]) + (at_tip ? 1 : -1);
}

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
#include "lib/light.glsl"
#include "lib/ribbon.glsl"

flat out vec3 v_own_direction;
out float v_own_width_texels;
out vec2 v_own_ends;

#ifdef LIGHT_FACES
const float endless = 1e6;  // segments
#else
const float endless = endless_texels;
#endif

void tell_own_segment(int segment, int point, bool at_tip) {
    int root = int(segments[segment]);
    vec3 along = (u_light_from_local * vec4(points[root + 1].xyz - points[root].xyz, 0.0)).xyz;
#ifdef LIGHT_FACES
    float texels = 1.0;  // ends are told in segments: a face will know how long one is
    v_own_direction = along;
#else
    float texels = max(abs(along.x), abs(along.y));
    v_own_direction = texels > 0.0 ? along / texels : vec3(0.0);
#endif
    v_own_ends = vec2(goes_on(segment, false) ? -endless : at_tip ? -texels : 0.0,
                      goes_on(segment, true) ? endless : at_tip ? 0.0 : texels);
    v_own_width_texels = points[point].w * u_width_scale * u_light_texels_per_unit;
    v_own_opacity = own_opacity(point);
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
    tell_own_segment(segment, point, at_tip);
#endif
    gl_Position = u_camera_clip_from_view * vec4(v_p_vs, 1.0);
}
