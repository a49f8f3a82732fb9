// Exact: what every other technique is checked against.
//
// Idea: every fragment of every texel is kept, sorted by depth, with the running sum of optical
// depth; a look-up finds the last fragment in front by binary search. Of an interval both ends are
// kept, with the density between them, so that optical depth inside is exact too. What is left of
// error is the map's resolution and the deposit, shared by all. After Carpenter's A-buffer (1984)
// and the per-pixel lists of Yang et al. 2010, packed rather than linked.
//
// Cost: 2 geometry passes, one read-back of the counts, and log2(longest list) compute steps; 28
// bytes a texel and 16 a fragment, 32 one with two ends (three times that while it sorts).
//
// Fails: 67 million ends are the most that its lists hold; it is not meant to be fast.
#pragma once

#include <string_view>

#include "opacity/technique.hpp"

namespace opacity::techniques {

class Exact : public Technique {
   public:
    Exact() : Technique{"exact"} {}

    std::string_view summary() const override {
        return "Every fragment of every texel, sorted: the reference for all other techniques.";
    }
    std::string_view paper() const override { return "after Carpenter 1984, Yang et al. 2010"; }
    LookUp build(FrameGraph& graph, const ShadowInputs& inputs) override;
};

}  // namespace opacity::techniques
