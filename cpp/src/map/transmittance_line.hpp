// T along the light as nodes that straight lines join, within a bound. GLSL:
// lib/transmittance_line.glsl and techniques/deep_shadow_maps.glsl.
#pragma once

#include <span>
#include <vector>

#include "map/fragment_list.hpp"

namespace opacity {

struct TransmittanceNode {
    float depth, transmittance;
};

struct Compression {
    float error_bound;
    int most_nodes;  // 0: any
    int part;        // entries after which T is exact again
};

// Of one texel's sorted and summed list.
std::vector<TransmittanceNode> compressed(std::span<const ListEntry> list,
                                          const Compression& compression);

// T at a depth; 1 in front of the first node.
float transmittance_at(std::span<const TransmittanceNode> nodes, float depth);

}  // namespace opacity
