// Coefficient maps whose texels are means of those around them, within a face: means of the
// casters' density (Jansen and Bavoil 2010, section 6).
#pragma once

#include "opacity/technique.hpp"

namespace opacity::techniques {

enum class Prefilter { none, box, gaussian, mip_chain };

constexpr int most_prefilter_texels = 16;  // to each side: 33 x 33

// Over so many texels to each side. Box and gaussian row by row, then column by column; a mip chain
// by halves, as far as its texels are about as wide, with lines between their middles.
Texture& add_prefilter(FrameGraph& graph, const ShadowInputs& inputs, Texture& map,
                       Prefilter prefilter, int texels);

}  // namespace opacity::techniques
