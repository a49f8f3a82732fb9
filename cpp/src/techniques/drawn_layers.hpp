// Opacity layers that a pass has drawn: what stands in the map, and where its planes lie.
#pragma once

#include <vector>

#include "opacity/graph/frame_graph.hpp"

namespace opacity::techniques {

constexpr int planes_per_target = 4;  // plane 4 t + c + 1 is channel c of layer t

// Between which depths of light space a texel's layers lie; GLSL: lib/layer_span.glsl.
struct LayerSpan {
    Texture *start, *end;

    void add_to(Reads& reads) const { reads.insert(reads.end(), {start, end}); }
};

// Planes of [0, 1], from the start of a texel's layers to their end, in an array texture of
// cumulative optical depth.
struct DrawnLayers {
    Texture& map;
    Value<std::vector<float>>& planes;
    LayerSpan span;
};

}  // namespace opacity::techniques
