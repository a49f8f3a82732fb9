// Unshadowed: T = 1 everywhere. No pass, no texture: the baseline that every timing is a ratio to.
#pragma once

#include <string_view>

#include "opacity/technique.hpp"

namespace opacity::techniques {

class Unshadowed : public Technique {
   public:
    Unshadowed() : Technique{"unshadowed"} {}

    std::string_view summary() const override {
        return "No shadows: the baseline of every timing.";
    }
    std::string_view paper() const override { return "none"; }
    LookUp build(FrameGraph& graph, const ShadowInputs& inputs) override;
};

}  // namespace opacity::techniques
