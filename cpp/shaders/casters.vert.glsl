// Casters as the light sees them, each kind in a file of its own; lib/deposit.glsl then finds how
// much of a texel they cover. Depth is written by the fragment stage, so nothing is clipped in z.
#include "lib/light.glsl"

uniform mat4 u_light_from_local;

// Passes that draw the same casters must agree on every bit of depth and coverage, on drivers that
// fuse a * b + c too.
invariant gl_Position;

vec4 clip_from_texels(vec2 p) { return vec4(2.0 * p / float(u_light_map_size_px) - 1.0, 0.0, 1.0); }

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
