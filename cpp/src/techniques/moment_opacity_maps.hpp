// Moment opacity maps (Muenstermann, Krumpen, Klein and Peters, "Moment-Based Order-Independent
// Transparency", 2018, with the light for the camera).
//
// Idea: a texel keeps moments of where its optical depth lies: sums over the casters of optical
// depth times 1, z, z^2 .. . They bound what may lie in front of a depth, from both sides and as
// narrowly as can be; the look-up takes a quarter of the way between. So T never rises along the
// light, and casters at up to n places are told exactly by 2 n moments, wherever they lie. As of
// Fourier's coefficients, means over texels are those of densities, and a map may be filtered once
// and for all (`prefilter`).
//
// Cost: 1 blended pass into ceil((N + 1) / 4) RGBA32F layers: 32 bytes a texel for 4 and 6 moments,
// 48 for 8. Look-up: 4 texels, all moments of each, and the roots of a polynomial of degree N / 2:
// in closed form for 4, by some tens of Newton's steps beyond.
//
// Fails: bounds are wide in the midst of many casters, where a series of as many coefficients tells
// more, and T falls in steps that no caster has. Sums have to be float32: of what 16 bits round
// nothing is left of the higher moments. Even so these are moved a little toward those of an even
// layout, which blurs more the more there are. Where nearly all of a texel is the receiver's own,
// what own_correction leaves is too little to tell how it lies, and drivers differ there.
//
// Of the paper: power moments; trigonometric ones are not here. It is about what a camera sees;
// depths are not logarithms, since a light's map is linear.
#pragma once

#include <string_view>

#include "techniques/coefficient_maps.hpp"

namespace opacity::techniques {

class MomentOpacityMaps : public CoefficientMaps {
   public:
    MomentOpacityMaps() : CoefficientMaps{"moment_opacity_maps"} {}

    std::string_view summary() const override {
        return "Moments of where casters lie in each texel; exact for few, and T never rises.";
    }
    std::string_view paper() const override { return "Muenstermann et al. 2018"; }
    LookUp build(FrameGraph& graph, const ShadowInputs& inputs) override;

    IntChoice moments{*this,
                      "moments",
                      {4, 6, 8},
                      "Of depth, beside the sum of optical depth: half as many casters are exact."};
};

}  // namespace opacity::techniques
