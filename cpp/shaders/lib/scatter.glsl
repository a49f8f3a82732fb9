// Every deposit of the casters, in no order, into images that only atomics write: what comes out does
// not depend on the order. Strands and particles are dispatched, an invocation each, which visits the
// texels that its caster may cover; others, and large ones, are drawn, and scattered by the fragment
// stage (C++: techniques/scatter.hpp). Include it after
//     bool is_wanted(ivec2 texel)
//     void scatter(ivec2 texel, Deposit deposit)
// whose file includes lib/deposit.glsl first.
#ifdef STAGE_COMPUTE
#include "lib/invocation.glsl"

// Casters of the shape that the view sees: a range of an order of them.
uniform int u_quad_first, u_quad_count;
layout(std430) readonly buffer b_casters { uint casters[]; };

// What lies on the face of a range of texels.
vec2 on_face(vec2 p) { return clamp(p, vec2(0.0), vec2(u_light_map_size_px)); }

void visit_texel(ivec2 texel) {
    visited_texel = texel;
    if (!is_wanted(texel_of_map())) return;
    Deposit deposit;
    if (deposits(deposit)) scatter(texel_of_map(), deposit);
}

#ifdef STRANDS
#include "casters/strands.comp.glsl"
#else
#include "casters/particles.comp.glsl"
#endif

void main() {
    int quad = int(invocation_index());
    if (quad < u_quad_count) visit_caster(int(casters[u_quad_first + quad]));
}
#else
void main() {
    ivec2 texel = texel_of_map();
    if (!is_wanted(texel)) discard;
    scatter(texel, deposit_or_discard());
}
#endif
