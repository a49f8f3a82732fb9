// Casters as the light sees them, each kind in a file of its own; lib/deposit.glsl then finds how
// much of a texel they cover. Depth is written by the fragment stage, so nothing is clipped in z.
#include "lib/light.glsl"

uniform mat4 u_light_from_local;

// Passes that draw the same casters must agree on every bit of depth and coverage, on drivers that
// fuse a * b + c too.
invariant gl_Position;

#ifdef MAP_FACES
// Each shape is drawn once for each face, or split. What is beside it, or not before it, is cut off.
flat out int v_face;
int drawn_face() { return gl_InstanceID; }
out float gl_ClipDistance[5];

// `p` times `forward` is the place on the face; so a triangle may reach behind it.
vec4 clip_from_face(vec2 p, float forward) {
    float size = float(u_light_map_size_px);
    gl_ClipDistance[0] = p.x;
    gl_ClipDistance[1] = size * forward - p.x;
    gl_ClipDistance[2] = p.y;
    gl_ClipDistance[3] = size * forward - p.y;
    gl_ClipDistance[4] = forward - least_forward;
    vec2 map_size = size * vec2(u_light_columns, (MAP_FACES + u_light_columns - 1) / u_light_columns);
    return vec4(2.0 * (p + forward * vec2(corner_px(drawn_face()))) / map_size - forward, 0.0, forward);
}

#ifdef LIGHT_FACES
vec4 clip_from_seen(vec3 r) {
    return clip_from_face(focal_px(drawn_face()) * r.xy + r.z * middle_px(drawn_face()), r.z);
}
#endif

vec4 clip_from_texels(vec2 p) { return clip_from_face(p, 1.0); }
#else
vec4 clip_from_texels(vec2 p) { return vec4(2.0 * p / float(u_light_map_size_px) - 1.0, 0.0, 1.0); }
#endif

// A directional light's coordinates to the map that is drawn.
#ifdef LIGHT_SPLITS
vec3 drawn_place(vec3 p_ls) { return vec3(place_in(drawn_face(), p_ls.xy), p_ls.z); }
float drawn_texels_per_unit() { return u_light_texels_per_unit * split_scale(drawn_face()); }
#else
vec3 drawn_place(vec3 p_ls) { return p_ls; }
float drawn_texels_per_unit() { return u_light_texels_per_unit; }
#endif

// What leaves nothing in the map lies outside of it.
vec4 clipped_away() {
#ifdef MAP_FACES
    for (int i = 0; i < 5; ++i) gl_ClipDistance[i] = -1.0;
#endif
    return vec4(2.0, 2.0, 0.0, 1.0);
}

#ifdef OPTICAL_DEPTH
layout(std430) readonly buffer b_opacity { float opacity[]; };
uniform int u_opacity_stride;  // 0: one opacity for all
#endif

#ifdef STRANDS
#include "casters/strands.vert.glsl"
#endif
#ifdef MESH
#include "casters/mesh.vert.glsl"
#endif
#ifdef PARTICLES
#include "casters/particles.vert.glsl"
#endif
#ifdef VOLUME
#include "casters/volume.vert.glsl"
#endif

void main() {
#ifdef MAP_FACES
    v_face = drawn_face();
#endif
    place_caster();
}
