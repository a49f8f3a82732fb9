// Adaptive opacity maps: bounding opacity maps (Voicu 2011) whose planes every texel lays for
// itself, at equal steps of transmittance.
//
// Idea: T is known at planes; between two it is off by some part of what the light loses there.
// Where casters are spread at random the mean square of that is least if each layer takes as much
// of the light: planes at optical depths -ln(1 - (1 - exp(-Omega)) k / K). They lie close together
// where T falls, few in gaps, and few in the black behind. A coarse histogram between the texel's
// bounds tells where that is, and layers drawn at the planes found tell it once more, finer. A part
// of the planes is spread evenly (techniques/transmittance_planes.hpp). As in bounding maps a layer
// keeps the mean depth of what it holds, and a look-up does not count the receiver itself. Nothing
// is read back.
//
// Cost: a pass for the bounds, 2 blended and 2 small compute passes for the planes, ceil(K / 16)
// blended ones for the layers; 8 + 48 ceil(K / 4) bytes a texel, and, to lay the planes, 64 and 32
// for every four of at least 16 layers. Without `refine` a blended and a compute pass less; over
// frames the histogram is drawn in the first one alone, and later planes start from those before.
// A tile of texels has 16 ceil(K / 4) bytes of planes. Look-up: 4 texels, 2 bounds, 2 planes and
// log2(K) - 1 images of planes' places each.
//
// Fails: clusters that a sixteenth of the texel's depth does not tell apart share their layers; in
// smooth media few layers are better spread evenly (4 in clouds: by .0004 of T); over frames, what
// jumps has the planes of another scene for a frame.
#pragma once

#include <string_view>

#include "techniques/bounded_layers.hpp"
#include "techniques/transmittance_planes.hpp"

namespace opacity::techniques {

class AdaptiveOpacityMaps : public BoundedLayers {
   public:
    AdaptiveOpacityMaps() : BoundedLayers{"adaptive_opacity_maps"} {}

    std::string_view summary() const override {
        return "Opacity layers between the bounds of each texel, at equal steps of its own "
               "transmittance.";
    }
    std::string_view paper() const override { return "own: docs/accuracy.md"; }
    LookUp build(FrameGraph& graph, const ShadowInputs& inputs) override;

    Choice refine{*this,
                  "refine",
                  {"once", "frames", "0"},
                  "How often planes are laid again by the layers drawn at them: once from a "
                  "histogram; once a frame from those of the frame before, until they rest; or "
                  "not at all, which saves two passes."};
    IntChoice tile{*this,
                   "tile",
                   {1, 2, 4, 8},
                   "Texels to a side of the square that shares planes, between bounds that stay "
                   "those of each texel."};

   private:
    struct Laid {
        TilePlanes planes;
        Reads more = {};  // for the look-up
    };
    Laid add_planes(FrameGraph& graph, const ShadowInputs& inputs, const DepositWay& way,
                    const LayerSpan& span) const;
    Laid add_planes_over_frames(FrameGraph& graph, const ShadowInputs& inputs,
                                const DepositWay& way, const LayerSpan& span) const;
    // A coarse histogram.
    DrawnLayers add_cells(FrameGraph& graph, const ShadowInputs& inputs, const DepositWay& way,
                          const LayerSpan& span) const;
    // Layers that planes are laid by again: how many, their planes, and themselves.
    LayerCount trial_count(FrameGraph& graph) const;
    TilePlanes add_trial_planes(FrameGraph& graph, const ShadowInputs& inputs,
                                const DrawnLayers& told, const LayerCount& count) const;
    DrawnLayers add_trial_at(FrameGraph& graph, const ShadowInputs& inputs, const DepositWay& way,
                             const LayerSpan& span, const TilePlanes& planes) const;
    TilePlanes add_planes_by(FrameGraph& graph, const ShadowInputs& inputs, const DrawnLayers& told,
                             const LayerCount& count) const;
};

}  // namespace opacity::techniques
