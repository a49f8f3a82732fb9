// The deposit rule (docs/accuracy.md): which optical depth a fragment adds, and from which depth to
// which. It does not depend on the map's resolution: a strand of opacity o that covers the part c of
// a texel lets 1 - o c through, over the part f of the column that the segment spans. Each kind of
// caster says it in a file of its own, as
//     bool covers(out Deposit deposit)
// which is false where it leaves nothing.
#include "lib/drawn_caster.glsl"
#include "lib/interval.glsl"
#include "lib/opacity.glsl"

#ifdef READS_OPAQUE_DEPTH
uniform sampler2D t_opaque_depth;
#endif

// The texel in which a caster is looked at: of the map, and its middle on the face.
#ifdef STAGE_COMPUTE
ivec2 visited_texel = ivec2(0);  // on the face
ivec2 texel_of_map() { return visited_texel + drawn_corner(); }
vec2 texel_in_face() { return vec2(visited_texel) + 0.5; }
#else
ivec2 texel_of_map() { return ivec2(gl_FragCoord.xy); }
vec2 texel_in_face() { return gl_FragCoord.xy - vec2(drawn_corner()); }
#endif

struct Deposit {
    float depth, depth_end;  // light space: where it begins and ends; of strands and surfaces the same
    float optical_depth;     // 0 unless OPTICAL_DEPTH
};

// Strands and surfaces are points in depth; others begin somewhere and end elsewhere.
#if defined(PARTICLES) || defined(VOLUME)
const int deposit_ends = 2;
#else
const int deposit_ends = 1;
#endif

#ifdef STRANDS
#include "casters/strands.frag.glsl"
#endif
#ifdef MESH
#include "casters/mesh.frag.glsl"
#endif
#ifdef PARTICLES
#include "casters/particles.frag.glsl"
#endif
#ifdef VOLUME
#include "casters/volume.frag.glsl"
#endif

// False where no receiver can notice it: in texels that are not covered, and of casters behind all
// receivers or behind an opaque one, where T is 0 without them. Of an interval that such a depth
// cuts, what is in front of it remains.
bool deposits(out Deposit deposit) {
    deposit = Deposit(0.0, 0.0, 0.0);
    if (!covers(deposit)) return false;
    deposit.depth = max(deposit.depth, 0.0);
    deposit.depth_end = max(deposit.depth_end, deposit.depth);
    float last = 1.0;
#ifdef READS_OPAQUE_DEPTH
    last = min(last, texelFetch(t_opaque_depth, texel_of_map(), 0).x);
#endif
    if (!(deposit.depth <= last)) return false;
    if (deposit.depth_end > last) {
        deposit.optical_depth *= part_in_front(deposit.depth, deposit.depth_end, last);
        deposit.depth_end = last;
    }
    return true;
}

#ifdef STAGE_FRAGMENT
Deposit deposit_or_discard() {
    Deposit deposit;
    if (!deposits(deposit)) discard;
    return deposit;
}
#endif
