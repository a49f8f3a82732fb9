// A fine histogram of the optical depth in a map's texels, and the texels that searches of planes
// read back.
#pragma once

#include <string>
#include <vector>

#include "opacity/core/optical_depth_profiles.hpp"
#include "opacity/technique.hpp"
#include "techniques/drawn_layers.hpp"

namespace opacity::techniques {

// Its cells: fine near the light, where a logarithmic split puts its planes, and fine enough
// behind; at a ratio between two trials of a search, since one whose planes fall on those of the
// cells looks better than it is. Larger maps have texels enough to take fewer cells.
constexpr double fine_ratio = 0.45;
int fine_layer_count(int map_width_px);

// The texels that a search looks at.
BlockSample searched_blocks(int map_width_px);

// Those blocks of drawn layers: where they are kept so, the layers' own textures, else copies.
struct SampledLayers {
    DrawnLayers drawn;
    const Texture& map;
    const Texture* moments;      // null: none
    const Texture *start, *end;  // null: without a span

    void add_to(Reads& reads) const;
    Reads reads(Reads more) const {
        add_to(more);
        return more;
    }
};
SampledLayers add_sampled_layers(FrameGraph& graph, const ShadowInputs& inputs,
                                 const DrawnLayers& drawn);

// Some of them, the same whatever layers of the same casters.
struct SampledTexels {
    std::vector<float> planes, values, moments;
    // Of each texel's layers, in light space; empty without a span.
    std::vector<float> depth_ranges;

    OpticalDepthProfiles profiles() const {
        return {.planes = planes, .values = values, .moments = moments};
    }
};
SampledTexels read_texels(PassContext& context, const SampledLayers& sampled);

}  // namespace opacity::techniques
