// Bounding opacity maps (Voicu, "Real-time volumetric shadows for dynamic rendering", 2011, section
// 5).
//
// Idea: two depth maps bound the casters of each texel, blended in one pass; the thesis draws the
// second with depths reversed. K planes are laid between the bounds of that texel, so layers follow
// the shape of the casters on both sides, and each plane holds the optical depth in front of it.
// The planes may be evenly spaced, dense near the light (logarithmic), or a mix whose ratio is
// found by reading layers back to the CPU: eleven ratios from one fine histogram, or one ratio a
// frame, as in the thesis. Its section 7 leaves to later work a ratio for each texel, or each
// region of them: here two compute passes find it in the same frame, from a fine histogram of every
// texel, without a read-back. Beyond the thesis, each layer keeps the mean depth of what it holds
// (docs/accuracy.md, "The look-up").
//
// Cost: a pass for the bounds and ceil(K / 16) blended passes into two arrays of ceil(K / 4)
// RGBA32F layers; 8 + 32 ceil(K / 4) bytes a texel. With linear interpolation ceil(K / 32) passes
// into one. By scatter one pass, whatever K is, and 8 K + 8 bytes a texel, 4 K + 8 without mean
// depths.
// The search, when the casters, their opacity or the light changed: 2 more passes and one
// read-back, or a read-back in each of eleven frames; of per_texel and per_region, when these
// moved, 4 more passes, and 308 bytes a texel (at 512^2). Look-up: 4 texels, 2 bounds and 2 planes
// each, whatever K is.
//
// Fails: two clusters far apart in one texel (most planes lie in the gap); sparse and dense casters
// in one map, unless each texel has its own split.
#pragma once

#include <string_view>

#include "techniques/bounded_layers.hpp"
#include "techniques/split_search.hpp"

namespace opacity::techniques {

class BoundingOpacityMaps : public BoundedLayers {
   public:
    BoundingOpacityMaps() : BoundedLayers{"bounding_opacity_maps"} {}

    std::string_view summary() const override {
        return "Opacity layers between the first and the last caster of each texel, on a hybrid "
               "split.";
    }
    std::string_view paper() const override { return "Voicu 2011 (thesis)"; }
    LookUp build(FrameGraph& graph, const ShadowInputs& inputs) override;
    void needs_recompute() override { search_request_.touch(); }

    Choice split{*this,
                 "split",
                 {"auto", "linear", "logarithmic", "hybrid", "per_texel", "per_region"},
                 "How the planes are spaced: auto searches the ratio, hybrid takes split_ratio; "
                 "per_texel searches one in each texel, and per_region in each square of 8."};
    Param<double> split_ratio{*this,
                              "split_ratio",
                              0.5,
                              {0.0, 1.0},
                              "Of the hybrid split: 0 is linear, 1 is logarithmic."};
    Choice similarity{*this,
                      "similarity",
                      {"error", "absolute_difference", "correlation", "paper_absolute_difference",
                       "paper_correlation"},
                      "What the search judges a ratio by: error takes the least RMSE of T; "
                      "absolute_difference the largest smallest difference of neighbouring layers, "
                      "as opacity; correlation their least mean correlation. The paper_ forms are "
                      "those of the thesis, on optical depth at 8 bits, and prefer ratio 1."};
    IntChoice search_frames{
        *this,
        "search_frames",
        {1, 11},
        "Frames that a search takes: 1 tries all ratios on one histogram, 11 "
        "draws one ratio a frame, as the thesis does. Of split auto; others take one."};

    IntChoice render_targets{
        *this,
        "render_targets",
        {0, 1, 2, 4, 8},
        "Of deposit blend: into how many images of four planes a pass may draw "
        "at once; more layers take several passes. 0: eight, which OpenGL 4.5 "
        "guarantees."};
    Param<bool> paper_lut{*this, "paper_lut", false,
                          "Lays the planes where the look-up texture of the thesis has them, not "
                          "by the curve in closed form: of a logarithmic split half of the range "
                          "falls in the last layer."};
    Choice bounds{*this,
                  "bounds",
                  {"one_pass", "depth_func", "swapped_planes", "depth_range"},
                  "How the first and the last depth of each texel are drawn: in one_pass, as the "
                  "deposit is, by blending or scatter; else in two, the last by a reversed depth "
                  "test or by mirrored depths, as swapped near and far planes or the depth range "
                  "give them. The same maps, up to 2^-25 of a depth that was mirrored."};

   protected:
    int most_targets() const override {
        return render_targets.get() == 0 ? targets_per_pass : render_targets.get();
    }

   private:
    static constexpr int region_side_px = 8;

    LayerSpan add_span(FrameGraph& graph, const ShadowInputs& inputs, const DepositWay& way) const;
    void require_one_frame() const;
    bool is_searched() const;
    double fixed_ratio() const;
    int region_px() const;

    UniformSet search_request_{"needs_recompute"};
};

}  // namespace opacity::techniques
