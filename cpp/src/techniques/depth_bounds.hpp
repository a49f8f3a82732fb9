// Depth maps of where the casters of each texel begin and end: what a texel's layers lie between.
#pragma once

#include "opacity/technique.hpp"

namespace opacity::techniques {

// "start", of the first caster, rounded to so many bits; 1 where none is.
Texture& add_first_depth(FrameGraph& graph, const ShadowInputs& inputs, int depth_bits = 32);
// "end", of the last; 0 where none is.
Texture& add_last_depth(FrameGraph& graph, const ShadowInputs& inputs);

}  // namespace opacity::techniques
