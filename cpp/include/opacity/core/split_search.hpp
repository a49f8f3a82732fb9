// Which split ratio serves best (thesis, section 5.2.3): eleven trials, 0, .1, .. 1, each scored by
// the optical depth that its K layers hold.
#pragma once

#include <cstddef>
#include <span>

#include "opacity/core/optical_depth_profiles.hpp"
#include "opacity/core/split.hpp"
#include "opacity/core/split_error.hpp"

namespace opacity {

// What the layers of a trial are judged by. The measures of the thesis compare neighbouring layers:
// each new one shall tell something new. On cumulative optical depth, as in the thesis, the sum of
// absolute differences telescopes to (last - first) and C falls with it, so that ratio 1 wins on
// nearly everything (paper_ forms). The others see opacity images 1 - exp(-Omega) of covered
// texels, with the empty layer 0 at the start plane.
enum class Similarity {
    error,                      // split_error
    absolute_difference,        // the largest smallest sum between neighbours
    correlation,                // the least mean C of neighbours
    paper_absolute_difference,  // the largest sum over all neighbours, all texels, 8 bits
    paper_correlation,          // the least mean C of neighbours, all texels, 8 bits
};

struct SplitMeasure {
    Similarity similarity = Similarity::error;
    LayerLookUp look_up = {};  // of `error`
    bool has_moments = false;  // of layers that are rebinned
    bool paper_lut = false;    // at whose planes they are
};

// The score of a trial: the least is the best. `fine` counts for `error` alone.
double split_score(const SplitMeasure& measure, const OpticalDepthProfiles& layers,
                   const FineProfiles& fine);

// The trial with the least score; the first of equals. Errors of T that no one sees are equal, so
// that rounding, which differs between devices, seldom decides.
std::size_t best_trial(std::span<const double> scores, Similarity similarity);
// The best of all trials, with layers rebinned from the fine profiles.
std::size_t find_split_trial(const FineProfiles& fine, int layers,
                             const SplitMeasure& measure = {});

}  // namespace opacity
