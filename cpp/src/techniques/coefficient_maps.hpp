// What all techniques share whose texels keep sums over their casters, each of optical depth times
// a function of where it lies: the passes that sum, 32 at a time, and the look-up. A technique says
// what the sums mean: map/expansion.hpp, lib/coefficients.glsl.
#pragma once

#include <memory>

#include "map/expansion.hpp"
#include "techniques/drawn_layers.hpp"
#include "techniques/own_corrected.hpp"
#include "techniques/prefilter.hpp"

namespace opacity::techniques {

// Of map and look-up; their shaders have the defines.
struct Coefficients {
    Texture& map;
    int count;
    LayerSpan span;
    std::shared_ptr<const Expansion> expansion;
    Reads reads = {};  // what the shader of the expansion takes
    Defines defines = {};
    bool is_prefiltered = false;

    int targets() const { return map.desc().layers; }
};

class CoefficientMaps : public OwnCorrected {
   public:
    Choice prefilter{
        *this,
        "prefilter",
        {"none", "box", "gaussian", "mip-chain"},
        "Averages the maps once, whatever looks them up: the mean density of the texels "
        "around each; without own_correction."};
    Param<int> prefilter_radius{
        *this,
        "prefilter_radius",
        1,
        {1, most_prefilter_texels},
        "Texels to each side of a prefilter: 16 is 33 x 33; of a mip-chain, "
        "the level whose texels are about as wide."};

   protected:
    using OwnCorrected::OwnCorrected;

    // The array texture that `count` of them take.
    static Texture& coefficients_texture(FrameGraph& graph, const ShadowInputs& inputs,
                                         Format format, int count);
    // Passes that fill it, and the prefilter's; returns where the look-up finds them.
    Coefficients add_coefficients(FrameGraph& graph, const ShadowInputs& inputs,
                                  const Coefficients& coefficients) const;
    LookUp coefficients_look_up(const ShadowInputs& inputs, const Coefficients& coefficients,
                                Reads more = {}, Defines defines = {}) const;
};

}  // namespace opacity::techniques
