// Depth maps of where the casters of each texel begin and end: what a texel's layers lie between.
#pragma once

#include "opacity/technique.hpp"
#include "techniques/scatter.hpp"

namespace opacity::techniques {

// "start", of the first caster, rounded to so many bits; 1 where none is.
Texture& add_first_depth(FrameGraph& graph, const ShadowInputs& inputs, int depth_bits = 32);
// "end", of the last; 0 where none is.
Texture& add_last_depth(FrameGraph& graph, const ShadowInputs& inputs);
// The same, by the depth test of the first, on depths that are mirrored: in the shader, as swapped
// near and far planes do, or by the depth range (thesis, section 5.1). Once mirrored again they
// differ by up to 2^-25.
Texture& add_last_depth_mirrored(FrameGraph& graph, const ShadowInputs& inputs,
                                 bool by_depth_range);

struct DepthBounds {
    Texture &start, &end;
};
// Both from one pass, which blends the least and the largest depth of each texel.
DepthBounds add_both_depths(FrameGraph& graph, const ShadowInputs& inputs);

// The same maps by a scatter: of the first depth, and of both.
Texture& scatter_first_depth(FrameGraph& graph, const Scatter& scatter, int depth_bits = 32);
DepthBounds scatter_both_depths(FrameGraph& graph, const Scatter& scatter);

}  // namespace opacity::techniques
