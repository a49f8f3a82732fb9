// Depth of the casters: where the first one begins and, with LAST_TOO, where the last one ends. Of
// depths from 0 on, the bits are ordered as they are. C++: techniques/depth_bounds.cpp.
#include "lib/deposit.glsl"
#include "lib/depth_bits.glsl"

#ifndef DEPTH_BITS
#define DEPTH_BITS 32
#endif

layout(r32ui) uniform uimage2D i_start;  // maps of floats, seen as their bits
#ifdef LAST_TOO
layout(r32ui) uniform uimage2D i_end;
#endif

uint ordered_bits(float depth) { return floatBitsToUint(abs(depth)); }  // -0 has a sign

bool is_wanted(ivec2 texel) { return true; }

void scatter(ivec2 texel, Deposit deposit) {
    imageAtomicMin(i_start, texel, ordered_bits(rounded_depth(deposit.depth, DEPTH_BITS)));
#ifdef LAST_TOO
    imageAtomicMax(i_end, texel, ordered_bits(deposit.depth_end));
#endif
}

#include "lib/scatter.glsl"
