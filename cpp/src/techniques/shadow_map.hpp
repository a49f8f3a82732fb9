// Shadow map: T is 1 up to the first caster of a texel, and 0 behind it (Williams 1978).
//
// Idea: one depth pass. Every caster casts as an opaque one at the depth where it begins, however
// translucent it is and however little of the texel it covers; only opacity 0 casts none. The
// filter averages the answers of texels, not their depths: percentage closer filtering (Reeves et
// al. 1987).
//
// Parallel splits (Zhang et al. 2006; thesis, section 2.2): the camera's view, as deep as something
// receives in it, is cut into `splits` parts, and each gets a map of its own: the window of the
// light's map around what receives in that part, as deep as the whole, so that a caster between the
// light and the window counts wherever it stands. A place is looked up in the first split, from the
// camera, that holds it with all that the filter reads, else in the whole map; its depth does not
// count, so T still falls along the light. Points that are asked about are looked up the same way:
// the camera of the renderer decides, also on the CPU, and the one that sees all of the scene where
// none was named. `splits = 1` is the whole map alone, whatever the camera. The opaque casters of
// the light go through the same splits. A point, spot or area light keeps its one map, and so do
// maps that would not lie in one texture of 16384 texels (5461 each with 4 splits), or have fewer
// than 16.
//
// Cost: 1 geometry pass, which draws each caster into splits + 1 maps, 4 bytes a texel of each. A
// camera that moves draws them again only when it leaves the windows, which have room to move.
//
// Fails: on everything translucent. It is what the papers on opacity maps set out from: hair is far
// too dark, and what is lit is noise of the size of texels.
#pragma once

#include <string_view>

#include "opacity/technique.hpp"

namespace opacity::techniques {

class ShadowMap : public Technique {
   public:
    ShadowMap() : Technique{"shadow_map"} {}

    std::string_view summary() const override {
        return "Binary: every caster is opaque where it begins; right for solids, too dark on "
               "hair.";
    }
    std::string_view paper() const override {
        return "Williams 1978; Reeves et al. 1987; Zhang et al. 2006";
    }
    LookUp build(FrameGraph& graph, const ShadowInputs& inputs) override;
    ViewSplits view_splits() const override { return {splits.get(), split_mix.get()}; }

    Param<int> splits{
        *this,
        "splits",
        4,
        {1, 8},
        "Parts of the camera's view with a map of their own, beside that of the whole "
        "directional light; 1: that alone."};
    Param<double> split_mix{*this,
                            "split_mix",
                            0.5,
                            {0.0, 1.0},
                            "Where the view is cut: 0 evenly, 1 logarithmically, denser near the "
                            "camera."};
};

}  // namespace opacity::techniques
