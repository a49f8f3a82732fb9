// Opacity layers by a scatter: each caster adds to its own layer alone, in fixed point, and a sum
// over the layers makes them cumulative. Whatever the order, the same bits. GLSL:
// lib/scattered_layers.glsl.
#pragma once

#include "techniques/drawn_layers.hpp"
#include "techniques/scatter.hpp"

namespace opacity::techniques {

// Into all images of the layers' maps. `why` is shown in the report.
void add_scattered_layers(FrameGraph& graph, const Scatter& scatter, const DrawnLayers& drawn,
                          const Shader& shader, Reads reads, const std::string& why);

}  // namespace opacity::techniques
