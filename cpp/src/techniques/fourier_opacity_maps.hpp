// Fourier opacity maps (Jansen and Bavoil, "Fourier Opacity Mapping", I3D 2010).
//
// Idea: how densely casters lie along a texel is a function of depth, and a map keeps the first
// coefficients of its Fourier series: sums over the casters of optical depth times 1, cos 2 pi k z
// and sin 2 pi k z. The integral of the series is the optical depth in front of a depth. Nothing
// has to be sorted, there are no layers that could show, and means of coefficients are those of
// densities, so that a map may be filtered once and for all (`prefilter`). `basis` takes another
// than Fourier's.
//
// Cost: ceil(N / 32) blended passes into ceil(N / 4) RGBA32F layers, 16 ceil(N / 4) bytes a texel;
// RGBA16F, which the paper has, half of it. A prefilter is two passes, or one for each level of a
// mip chain and one more, and as many bytes again once or twice. Look-up: 4 texels, all
// coefficients of each; bounds = "per_texel": 2 depth passes and 8 bytes a texel.
//
// Fails: a series of N coefficients cannot tell what is thinner than 1 / N of the depths. It rings
// around it, the more the more opaque it is: T rises again behind a caster, and light comes out of
// hair of high opacity. Optical depth is clamped to between nothing and all of a texel; a window
// takes the ringing for blur. The ends of a series are neighbours, so that a margin is left free at
// both.
//
// Of the paper: 7 coefficients, 3 to 63; recurrences for the harmonics, from one angle that is
// reduced first. Sums of 16 bits are accumulator = "float16". Casters with extent are integrated in
// closed form. Opaque casters have a depth map of their own (section 7.4). A prefilter averages
// densities (section 6); the look-up's `filter` is besides that. Colours (section 9): T is one
// number.
#pragma once

#include <string_view>

#include "map/basis.hpp"
#include "techniques/coefficient_maps.hpp"

namespace opacity::techniques {

class FourierOpacityMaps : public CoefficientMaps {
   public:
    FourierOpacityMaps() : CoefficientMaps{"fourier_opacity_maps"} {}

    std::string_view summary() const override {
        return "The density along each texel as a Fourier series; smooth, but it rings where "
               "casters "
               "are thin and opaque.";
    }
    std::string_view paper() const override { return "Jansen and Bavoil 2010"; }
    LookUp build(FrameGraph& graph, const ShadowInputs& inputs) override;

    Param<int> coefficients{*this,
                            "coefficients",
                            7,
                            {3, int(most_coefficients) - 1},
                            "Of the series: 2 n + 1 for n harmonics of basis fourier."};
    Choice basis{
        *this, "basis", basis_names(),
        "What the density is a sum of: harmonics, slices, cosines that are mirrored at both "
        "ends, or polynomials."};
    Choice window{*this,
                  "window",
                  {"none", "lanczos"},
                  "lanczos: higher harmonics count less (sigma factors), against ringing."};
    AutoParam<double> margin{
        *this,
        "margin",
        {0.0, 1.0},
        "Left free before and behind the depths, in parts of them; auto: 1 / (3 "
        "n) for n harmonics of basis fourier, else 0."};
    Choice bounds{*this,
                  "bounds",
                  {"global", "per_texel"},
                  "The depths of the series: those of all casters, or of each texel, which no "
                  "prefilter can average."};
    Choice accumulator{*this,
                       "accumulator",
                       {"float32", "float16"},
                       "What coefficients are summed in. The paper had 16 bits."};

   private:
    Coefficients series(FrameGraph& graph, const ShadowInputs& inputs) const;
};

}  // namespace opacity::techniques
