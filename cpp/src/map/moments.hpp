// Power moments of where optical depth lies along a texel (Muenstermann et al. 2018): sums of it
// times z^k, z from -1 to 1. Of all ways to lay out casters with these moments, the one that has a
// caster at the place asked about (the canonical one) has the most of them there, and the least, or
// with it the most, in front. GLSL: lib/moments.glsl.
#pragma once

#include <array>

#include "map/expansion.hpp"

namespace opacity {

class PowerMoments : public Expansion {
   public:
    // 4, 6 or 8, besides the sum of optical depth itself.
    explicit PowerMoments(int moments) : half_{moments / 2} {}

    void of_caster(float begin, float end, std::span<float> c) const override;
    float optical_depth(std::span<const float> c) const override { return c[0]; }
    float optical_depth_before(float x, std::span<const float> c, float all) const override;

   private:
    int half_;  // of the moments: so many casters in the canonical layout, besides one at the place
};

}  // namespace opacity
