// Depth of the casters: where the first one begins and the last one ends. In ONE_PASS both, for
// blending; else one, for whichever depth test the pass sets: the first, or with LAST_DEPTH the last.
// Mirrored, the last is the nearest: with MIRRORED by this shader, as if a projection had its near and
// far plane swapped, and with DEPTH_RANGE by the range that the pass sets. C++:
// techniques/depth_bounds.cpp.
#include "lib/deposit.glsl"
#include "lib/depth_bits.glsl"

#ifndef DEPTH_BITS
#define DEPTH_BITS 32
#endif

#ifdef ONE_PASS
layout(location = 0) out float o_start;
layout(location = 1) out float o_end;
#endif

void main() {
    Deposit deposit = deposit_or_discard();
#if defined(ONE_PASS)
    o_start = deposit.depth;
    o_end = deposit.depth_end;
#elif defined(MIRRORED)
    gl_FragDepth = 1.0 - deposit.depth_end;
#elif defined(DEPTH_RANGE)
    gl_FragDepth = gl_DepthRange.near + gl_DepthRange.diff * deposit.depth_end;
#elif defined(LAST_DEPTH)
    gl_FragDepth = deposit.depth_end;
#else
    gl_FragDepth = rounded_depth(deposit.depth, DEPTH_BITS);
#endif
}
