// A part of a map's texels side by side, so that a search on the CPU reads back no more than it
// looks at.
#pragma once

#include "map/block_sample.hpp"
#include "opacity/technique.hpp"

namespace opacity::techniques {

// Declares the pass that copies those blocks of a map, of one image or an array, of whole width; of
// all blocks the map itself.
Texture& add_sampled_texels(FrameGraph& graph, const ShadowInputs& inputs, Texture& map,
                            const BlockSample& blocks);

}  // namespace opacity::techniques
