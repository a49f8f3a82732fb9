// The split texture that the thesis leaves to later work (section 7): each square of texels has the
// ratio that serves it best, found on the GPU from a fine histogram of all its texels.
#pragma once

#include <vector>

#include "techniques/split_search.hpp"

namespace opacity::techniques {

// Passes that score every trial in every texel, and pick the best of each square of `region_px`
// texels. `planes`: of all trials. ParameterError for a measure that compares whole images.
LocalCurves add_local_splits(FrameGraph& graph, const ShadowInputs& inputs,
                             const SplitSearch& search, const DrawnLayers& histogram,
                             Value<std::vector<float>>& planes, int region_px);

}  // namespace opacity::techniques
