// How well layers between the planes of a split curve serve one texel, by a fine histogram of it:
// each of its cells is a caster in the middle, that of the first lies at 0 and that of the last
// at 1. GLSL: lib/split_score.glsl.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "map/layer_held.hpp"
#include "opacity/core/split_search.hpp"

namespace opacity {

class FineTexel {
   public:
    static constexpr std::size_t most_cells = 64;

    // `cells` are the planes of the histogram, and sums[k] is the optical depth in front of the
    // (k + 1)th; `bias` within which a receiver does not count casters, as a part of the range.
    FineTexel(std::span<const float> cells, std::span<const float> sums, float bias);

    float optical_depth() const { return optical_depth_; }
    // Times the optical depth of all: the least is the best. Of `error` the mean square error of T
    // on the casters, by their optical depth; else what the smallest difference of neighbouring
    // images lacks of 1, or in the paper's form their sum.
    float score(const SplitMeasure& measure, std::span<const float> planes) const;

   private:
    float place_of(std::size_t cell) const;
    LayerHeld held_by(std::span<const float> planes, std::size_t k, std::size_t& caster) const;
    float square_error(const SplitMeasure& measure, std::span<const float> planes) const;
    float lack(bool in_paper, std::span<const float> planes) const;

    std::span<const float> cells_;
    std::size_t count_;
    float bias_, optical_depth_;
    std::array<float, most_cells> held_, transmittance_;
};

}  // namespace opacity
