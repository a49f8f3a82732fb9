// What the sums of a texel tell of its casters. Sums add up in any order, and their means over
// texels are those of the casters' density. GLSL: lib/coefficients.glsl.
#pragma once

#include <cstddef>
#include <span>

namespace opacity {

inline constexpr std::size_t most_coefficients = 64;

// Places are positions among the texel's layers, 0 .. 1.
class Expansion {
   public:
    virtual ~Expansion() = default;
    // What a caster of optical depth 1 from begin to end adds to each sum.
    virtual void of_caster(float begin, float end, std::span<float> c) const = 0;
    // Of all casters.
    virtual float optical_depth(std::span<const float> c) const = 0;
    // Of those in front, or about; `all`: of the texel, with what was taken out.
    virtual float optical_depth_before(float x, std::span<const float> c, float all) const = 0;
};

}  // namespace opacity
