// Shadow map: see shadow_map.hpp.

#ifdef PASS_half_depth
#include "lib/deposit.glsl"

// Half of it, exactly, so that no caster is where the map is cleared: at 1 there is none.
void main() {
    Deposit deposit = deposit_or_discard();
    if (!(deposit.optical_depth > 0.0)) discard;
    gl_FragDepth = 0.5 * deposit.depth;
}
#else

#include "lib/receiver.glsl"

uniform sampler2D t_half_depth;

const float opaque_optical_depth = 200.0;  // exp(-200) is 0 in float32
const float own_margin = 1e-5;             // what a caster's begin, found twice, may differ by

// A particle does not count at its own centre: there it is asked what lies before where it begins.
float texel_optical_depth(ivec2 texel, float depth, OwnDeposit own) {
    if (own.optical_depth > 0.0) depth = min(depth, own.depth - own_margin);
    return texelFetch(t_half_depth, texel, 0).x < min(0.5 * depth, 1.0) ? opaque_optical_depth : 0.0;
}

#include "lib/lookup.glsl"
#endif
