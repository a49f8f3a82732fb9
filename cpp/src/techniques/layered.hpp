// What all techniques with layers share: K planes in each texel, with the optical depth in front of
// each, drawn in passes of 32 planes. A technique says where a texel's layers begin and end, and
// where the planes lie in between: lib/layers.glsl.
#pragma once

#include <string>
#include <vector>

#include "opacity/technique.hpp"
#include "techniques/drawn_layers.hpp"

namespace opacity::techniques {

class Layered : public Technique {
   public:
    Param<int> layers;
    Param<bool> own_correction{*this, "own_correction", true,
                               "Takes out of a look-up what it counts of the receiver's own "
                               "deposit; not with deposit_rule paper."};

   protected:
    Layered(std::string name, int most_layers, std::string layers_doc)
        : Technique{std::move(name)},
          layers{*this, "layers", 16, {1, most_layers}, std::move(layers_doc)} {}

    // The planes, and their number, as lib/planes.glsl reads them.
    struct Planes {
        const Source& layers;
        Value<std::vector<float>>& planes;
        int count;
    };
    // A depth map of where the casters of each texel begin, or end.
    static Texture& add_first_depth(FrameGraph& graph, const ShadowInputs& inputs);
    static Texture& add_last_depth(FrameGraph& graph, const ShadowInputs& inputs);
    // Passes that draw cumulative optical depth at the planes into one array texture; of one block
    // of 4 x 4 texels in every `block_stride`, both ways.
    DrawnLayers add_layers(FrameGraph& graph, const ShadowInputs& inputs, const LayerSpan& span,
                           const std::string& name, const Planes& planes,
                           int block_stride = 1) const;
    LookUp layers_look_up(const ShadowInputs& inputs, const DrawnLayers& drawn,
                          Reads more = {}) const;
};

}  // namespace opacity::techniques
