// Deep opacity maps (Yuksel and Keyser, "Deep Opacity Maps", Computer Graphics Forum 27(2), 2008).
//
// Idea: a depth map of the casters says where light begins to fade in each texel; K layers behind
// it, of the same sizes in all texels, follow the shape of the casters. The first surface is lit
// exactly, and interpolation happens inside the casters, so that layers do not show. Sizes grow
// linearly, so that the layers are fine where light begins to fade.
//
// Cost: 1 depth pass and ceil(K / 32) blended passes into ceil(K / 4) RGBA32F layers; 4 + 16 ceil(K
// / 4) bytes a texel. With packing = "4n-1" the depth lies in a channel of the first layer, and a
// look-up reads one texture: 3 layers are one texel. By scatter one pass, whatever K is, and 4 K
// bytes a texel more. The search for the layers' depth, when the
// casters, their opacity or the light changed: 2 more passes and one read-back. Look-up: 4 texels,
// a depth and 2 planes each, whatever K is.
//
// Fails: two clusters far apart in one texel; what lies behind the last layer is one step, and
// darkens itself (beyond = "last") or casts nothing ("ignore").
//
// Of the paper: opaque casters have an ordinary shadow map of their own, before which the layers
// lie. The shadow map's multi-sampling is `filter`; smoothing of depth and opacity maps, which
// blurs silhouettes, is `smoothing`.
#pragma once

#include <string_view>
#include <vector>

#include "opacity/core/list_param.hpp"
#include "techniques/layered.hpp"

namespace opacity::techniques {

class DeepOpacityMaps : public Layered {
   public:
    DeepOpacityMaps()
        : Layered{"deep_opacity_maps", 64, "Opacity layers behind the first caster of a texel."} {}

    std::string_view summary() const override {
        return "Opacity layers behind the first caster of each texel, of the same sizes in all.";
    }
    std::string_view paper() const override { return "Yuksel and Keyser 2008"; }
    LookUp build(FrameGraph& graph, const ShadowInputs& inputs) override;

    ListParam layer_sizes{*this,
                          "layer_sizes",
                          {"auto", "constant", "linear"},
                          "auto: linear, the k-th layer k times as deep as the first; or the size "
                          "of each layer in world units, which layer_extent scales."};
    AutoParam<double> layer_extent{*this,
                                   "layer_extent",
                                   {1e-9, 1e9},
                                   "World units from the first caster of a texel to the end of its "
                                   "layers; auto: as far as most light comes."};
    Choice beyond{*this,
                  "beyond",
                  {"last", "ignore", "extend"},
                  "What lies behind the last layer: is counted in it; casts nothing; or the layer "
                  "is extended to the end of the casters."};
    Choice packing{*this,
                   "packing",
                   {"planes", "4n-1"},
                   "4n-1: n targets hold 4n - 1 layers, and the depth at which they begin."};
    IntChoice depth_bits{
        *this,
        "depth_bits",
        {32, 16, 8},
        "Of the depth at which the layers begin: 16 is a half float, 8 even steps."};
    Param<int> smoothing{
        *this,
        "smoothing",
        0,
        {0, 8},
        "Texels to each side over which the depth and the layers are averaged: "
        "against flicker, at the price of the silhouettes; without own_correction."};

   private:
    // Planes of [0, 1], and d_K: how far behind the first caster plane 1 lies, in light space.
    struct Places {
        Planes& planes;
        Value<float>& depth;
    };
    struct Layout {
        std::vector<float> planes;
        float depth;
    };
    std::vector<double> sizes() const;
    Layout layout(double extent_ls) const;
    void add_search(FrameGraph& graph, const ShadowInputs& inputs, const DepositWay& way,
                    Texture& start, const Places& places) const;
};

}  // namespace opacity::techniques
