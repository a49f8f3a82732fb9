// A fine histogram of the optical depth in a map's texels, which searches of planes read back.
#pragma once

#include <vector>

#include "opacity/core/optical_depth_profiles.hpp"
#include "opacity/graph/frame_graph.hpp"
#include "techniques/drawn_layers.hpp"

namespace opacity::techniques {

// Its cells: fine near the light, where a logarithmic split puts its planes, and fine enough
// behind; at a ratio between two trials of a search, since one whose planes fall on those of the
// cells looks better than it is. Larger maps have texels enough to take fewer cells.
constexpr double fine_ratio = 0.45;
int fine_layer_count(int map_width_px);

// It holds one block of 4 x 4 texels in so many, both ways.
int block_stride(int map_width_px);

// Some texels of drawn layers, the same whatever layers of the same casters: those of a map of
// limited size, spread over the whole.
struct SampledTexels {
    std::vector<std::size_t> indices;  // in the map
    std::vector<float> planes, values, moments;

    OpticalDepthProfiles profiles() const {
        return {.planes = planes, .values = values, .moments = moments};
    }
};
SampledTexels sampled_texels(PassContext& context, const DrawnLayers& drawn);

}  // namespace opacity::techniques
