// Shadow map: T is 1 up to the first caster of a texel, and 0 behind it (Williams 1978).
//
// Idea: one depth pass. Every caster casts as an opaque one at the depth where it begins, however
// translucent it is and however little of the texel it covers; only opacity 0 casts none. The
// filter averages the answers of texels, not their depths: percentage closer filtering (Reeves et
// al. 1987).
//
// Cost: 1 geometry pass, 4 bytes a texel.
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
    std::string_view paper() const override { return "Williams 1978; Reeves et al. 1987"; }
    LookUp build(FrameGraph& graph, const ShadowInputs& inputs) override;
};

}  // namespace opacity::techniques
