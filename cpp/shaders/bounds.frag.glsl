// Depth of the casters, for whichever depth test the pass sets: where the first one begins, or with
// LAST_DEPTH and the test reversed where the last one ends.
#include "lib/deposit.glsl"
#include "lib/depth_bits.glsl"

#ifndef DEPTH_BITS
#define DEPTH_BITS 32
#endif

void main() {
    Deposit deposit = deposit_or_discard();
#ifdef LAST_DEPTH
    gl_FragDepth = deposit.depth_end;
#else
    gl_FragDepth = rounded_depth(deposit.depth, DEPTH_BITS);
#endif
}
