// A caster on the face, or split, of the light's map that it is drawn on: a vertex stage for each, a
// compute stage in the third dimension of its work groups.
#include "lib/light.glsl"

uniform mat4 u_light_from_local;

#ifdef OPTICAL_DEPTH
layout(std430) readonly buffer b_opacity { float opacity[]; };
uniform int u_opacity_stride;  // 0: one opacity for all
#endif

// What a vertex stage tells the fragment stage of a caster; a compute stage is both.
#if defined(STAGE_VERTEX)
#define TOLD precise flat out
#elif defined(STAGE_FRAGMENT)
#define TOLD flat in
#else
#define TOLD precise
#endif

#ifdef MAP_FACES
#if defined(STAGE_VERTEX)
flat out int v_face;
int drawn_face() { return gl_InstanceID; }
#elif defined(STAGE_FRAGMENT)
flat in int v_face;
int drawn_face() { return v_face; }
#else
int drawn_face() { return int(gl_WorkGroupID.z); }
#endif
ivec2 drawn_corner() { return corner_px(drawn_face()); }
#else
ivec2 drawn_corner() { return ivec2(0); }
#endif

// A directional light's coordinates to the map that is drawn; and 1 / the side of a texel of it in
// world units.
#ifdef LIGHT_SPLITS
vec3 drawn_place(vec3 p_ls) { return vec3(place_in(drawn_face(), p_ls.xy), p_ls.z); }
float drawn_texels_per_unit() { return u_light_texels_per_unit * split_scale(drawn_face()); }
#else
vec3 drawn_place(vec3 p_ls) { return p_ls; }
float drawn_texels_per_unit() { return u_light_texels_per_unit; }
#endif
