// Shapes as the camera sees them. Strands are ribbons that face it, joined along their common
// tangents.
invariant gl_Position;  // every pass from the camera sees the same fragment in front
uniform mat4 u_camera_from_local;
uniform mat4 u_camera_clip_from_view;
uniform mat4 u_light_from_local;

layout(std430) readonly buffer b_color { float color[]; };
uniform int u_color_stride;  // 0: one colour for all

out vec3 v_p_vs, v_p_ls, v_color;
out vec3 v_axis_vs;  // the tangent of a strand, the normal of a surface

#ifdef OWN_CORRECTION
// What the receiver itself leaves in the map: lib/receiver.glsl.
layout(std430) readonly buffer b_opacity { float opacity[]; };
uniform int u_opacity_stride;  // 0: one opacity for all
uniform bool u_deposits;      // whether the opacity maps hold it

out float v_own_opacity;
float own_opacity(int vertex) { return u_deposits ? opacity[vertex * u_opacity_stride] : 0.0; }
#endif

vec3 color_of(int vertex) {
    int i = 3 * vertex * u_color_stride;
    return vec3(color[i], color[i + 1], color[i + 2]);
}

vec3 view_position(vec3 p_local) { return (u_camera_from_local * vec4(p_local, 1.0)).xyz; }

// 0 for a vector without direction, so that a segment of no length harms nothing.
vec3 unit(vec3 v) {
    float largest = max(max(abs(v.x), abs(v.y)), abs(v.z));  // its square may be below the smallest float
    return largest > 0.0 ? normalize(v / largest) : vec3(0.0);
}

#ifdef STRANDS
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
#ifdef OWN_CORRECTION
    tell_own_segment(segment, point, at_tip);
#endif
    gl_Position = u_camera_clip_from_view * vec4(v_p_vs, 1.0);
}
#endif

#ifdef MESH
layout(std430) readonly buffer b_points { vec4 points[]; };
layout(std430) readonly buffer b_normals { vec4 normals[]; };
uniform mat3 u_camera_normal_from_local;

void main() {
    v_p_vs = view_position(points[gl_VertexID].xyz);
    v_p_ls = (u_light_from_local * vec4(points[gl_VertexID].xyz, 1.0)).xyz;
    v_axis_vs = unit(u_camera_normal_from_local * normals[gl_VertexID].xyz);
    v_color = color_of(gl_VertexID);
#ifdef OWN_CORRECTION
    v_own_opacity = own_opacity(gl_VertexID);
#endif
    gl_Position = u_camera_clip_from_view * vec4(v_p_vs, 1.0);
}
#endif
