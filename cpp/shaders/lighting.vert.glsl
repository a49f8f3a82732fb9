// Shapes as the camera sees them.
#include "lib/own_correction.glsl"
invariant gl_Position;  // every pass from the camera sees the same fragment in front
uniform mat4 u_camera_from_local;
uniform mat4 u_camera_clip_from_view;
uniform mat4 u_light_from_local;

layout(std430) readonly buffer b_color { float color[]; };
uniform int u_color_stride;  // 0: one colour for all

out vec3 v_p_vs, v_p_ls, v_color;
out vec3 v_axis_vs;  // the tangent of a strand, the normal of a surface

#if defined(OWN_CORRECTION) || defined(TRANSLUCENT)
#include "lib/vertex_opacity.glsl"
#endif

#ifdef TRANSLUCENT
out float v_opacity;
#endif

#ifdef OWN_CORRECTION
// What the receiver itself leaves in the map: lib/receiver.glsl.
out float v_own_opacity;
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

#if defined(STRANDS)
#include "lighting/strands.vert.glsl"
#elif defined(MESH)
#include "lighting/mesh.vert.glsl"
#elif defined(PARTICLES)
#include "lighting/particles.vert.glsl"
#elif defined(VOLUME)
#include "lighting/volume.vert.glsl"
#endif
