// Maps whose texels are the mean of those around them (Yuksel and Keyser 2008, section 5).
#pragma once

#include "opacity/technique.hpp"
#include "techniques/drawn_layers.hpp"

namespace opacity::techniques {

// Over `texels` to each side, within a face; of the depths of texels with casters.
Texture& add_smooth_depth(FrameGraph& graph, const ShadowInputs& inputs, Texture& start,
                          const Param<int>& texels);
DrawnLayers add_smooth_layers(FrameGraph& graph, const ShadowInputs& inputs,
                              const DrawnLayers& drawn, const Param<int>& texels);

}  // namespace opacity::techniques
