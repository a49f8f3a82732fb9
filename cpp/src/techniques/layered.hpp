// What all techniques with layers share: K planes in each texel, with the optical depth in front of
// each: blended in passes of 32 planes, or scattered and summed. A technique says where a texel's
// layers begin and end, and where the planes lie in between: lib/layers.glsl.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "techniques/depth_bounds.hpp"
#include "techniques/drawn_layers.hpp"
#include "techniques/own_corrected.hpp"
#include "techniques/scatter.hpp"

namespace opacity::techniques {

class Layered : public OwnCorrected {
   public:
    Param<int> layers;
    Choice accumulator{*this,
                       "accumulator",
                       {"float32", "float16", "unorm8"},
                       "What a layer sums optical depth in. The papers had 8 bits: what adds less "
                       "than half a step is lost, and more than 8 ln 2 cannot be told."};
    Choice deposit{
        *this,
        "deposit",
        {"auto", "blend", "scatter"},
        "How casters get into the layers: blend adds each to all planes behind it, as in "
        "the papers; scatter adds it to its own layer, in fixed point, which sums over "
        "the layers make cumulative; auto takes what is quicker. The same T to 1e-4."};

   protected:
    Layered(std::string name, int most_layers, std::string layers_doc)
        : OwnCorrected{std::move(name)},
          layers{*this, "layers", 16, {1, most_layers}, std::move(layers_doc)} {}

    using Planes = Value<std::vector<float>>;
    // What may be told of the layers beyond where they lie.
    struct Options {
        double kappa = full_8_bits;
        bool packed = false, ignores_beyond = false, mean_depths = false;
        LocalCurves curves = {};
        TilePlanes tiles = {};
    };
    static const double full_8_bits;  // exp(-kappa) = 2^-8

    // How casters get into the maps: by scatter, or blended; and why, where that was chosen.
    struct DepositWay {
        std::optional<Scatter> scatter;
        std::string why;

        // Of maps in 32 bits: there are atomics on one channel alone.
        Format format() const { return scatter ? Format::r32f : Format::rgba32f; }
    };
    DepositWay deposit_way(FrameGraph& graph, const ShadowInputs& inputs) const;

    // "start" and "end", of the first and the last caster, from one pass.
    static LayerSpan add_bounds(FrameGraph& graph, const ShadowInputs& inputs,
                                const DepositWay& way);
    // Passes that draw the layers into the array texture "opacity".
    DrawnLayers add_layers(FrameGraph& graph, const ShadowInputs& inputs, const DepositWay& way,
                           const LayerSpan& span, Planes& planes, const Options& options) const;
    // The same of fine layers, in all texels or a part of them; at the planes of this split ratio.
    DrawnLayers add_histogram(FrameGraph& graph, const ShadowInputs& inputs, const DepositWay& way,
                              const LayerSpan& span, double split_ratio,
                              bool in_all_texels = false) const;
    // Passes that draw layers of optical depth alone, in all texels, for what places others by
    // them.
    DrawnLayers add_trial(FrameGraph& graph, const ShadowInputs& inputs, const DepositWay& way,
                          const LayerSpan& span, Planes& planes, const Source& layer_count,
                          const TilePlanes& tiles) const;
    LookUp layers_look_up(const ShadowInputs& inputs, const DrawnLayers& drawn,
                          Interpolation interpolation = Interpolation::linear,
                          Reads more = {}) const;
    // The same look-up in four planes at a time, of layers that begin and end alike in all texels.
    Sweep layers_sweep(FrameGraph& graph, const ShadowInputs& inputs, const DrawnLayers& drawn,
                       Interpolation interpolation) const;
    int accumulator_bits() const;
    // Into how many images of four planes a pass may draw at once.
    virtual int most_targets() const { return targets_per_pass; }

   private:
    // What the passes that blend have in common; and the name of one.
    struct BlendedPass {
        std::string name, why;
        Reads reads;
        int block_stride;
    };
    void add_passes(FrameGraph& graph, const ShadowInputs& inputs, const DepositWay& way,
                    const DrawnLayers& drawn, const Source& layer_count, int block_stride) const;
    void add_blended(FrameGraph& graph, const ShadowInputs& inputs, const DepositWay& way,
                     const DrawnLayers& drawn, const Reads& reads, int block_stride) const;
    void add_pass(FrameGraph& graph, const ShadowInputs& inputs, const DrawnLayers& drawn,
                  const LayerPart& part, const BlendedPass& pass) const;
};

}  // namespace opacity::techniques
