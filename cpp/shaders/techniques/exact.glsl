// Exact: see exact.hpp. The lists are those of fragment_lists.glsl.
#include "lib/fragment_list.glsl"
#include "lib/interval.glsl"
#include "lib/receiver.glsl"

uniform usampler2D t_first, t_count, t_list;

float texel_optical_depth(ivec2 texel, float depth, OwnDeposit own) {
    uint first = texelFetch(t_first, texel, 0).x;
    uint low = 0u, high = texelFetch(t_count, texel, 0).x;
    while (low < high) {  // the number of entries strictly in front
        uint middle = (low + high) / 2u;
        if (uintBitsToFloat(texelFetch(t_list, list_place(first + middle), 0).x) < depth) low = middle + 1u;
        else high = middle;
    }
    if (low == 0u) return 0.0;
    Entry last = entry_of(texelFetch(t_list, list_place(first + low - 1u), 0));
    float in_front = last.optical_depth + last.density * (depth - last.depth);
    return in_front - own.optical_depth * part_in_front(own.depth, own.depth_end, depth);
}

#include "lib/lookup.glsl"
