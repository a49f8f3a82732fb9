// Casters as the light sees them, each kind in a file of its own; lib/deposit.glsl then finds how
// much of a texel they cover. Depth is written by the fragment stage, so nothing is clipped in z.
#include "lib/drawn_caster.glsl"

// Passes that draw the same casters must agree on every bit of depth and coverage, on drivers that
// fuse a * b + c too.
invariant gl_Position;

#ifdef MAP_FACES
// Each shape is drawn once for each face, or split. What is beside it, or not before it, is cut off.
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
    return vec4(2.0 * (p + forward * vec2(drawn_corner())) / map_size - forward, 0.0, forward);
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

// What leaves nothing in the map lies outside of it.
vec4 clipped_away() {
#ifdef MAP_FACES
    for (int i = 0; i < 5; ++i) gl_ClipDistance[i] = -1.0;
#endif
    return vec4(2.0, 2.0, 0.0, 1.0);
}

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
