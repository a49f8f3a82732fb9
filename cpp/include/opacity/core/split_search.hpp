// Which split ratio serves best (thesis, section 5.2.3): eleven trials, 0, .1, .. 1, each scored by
// the optical depth that its K layers hold.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace opacity {

// Optical depth of many texels, cumulative at common planes of [0, 1]: texel t has values[t *
// (planes - 1) + k - 1] in front of planes[k].
struct OpticalDepthProfiles {
    std::span<const float> planes;
    std::span<const float> values;
    std::size_t layers() const { return planes.size() - 1; }
    std::size_t texel_count() const { return values.size() / layers(); }
    // In front of planes 1, 2, ..
    std::span<const float> texel(std::size_t t) const {
        return values.subspan(t * layers(), layers());
    }
};

// The same texels at other planes, by interpolation.
std::vector<float> rebinned(const OpticalDepthProfiles& fine, std::span<const float> planes);

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
    bool own_correction = false;  // of `error`: the look-up leaves the receiver's own ramp out
};

// How well the layers rebuild the fine profiles of the same texels for receivers that lie where
// casters are: the RMSE of T at the middle of each fine cell, weighted by the cell's optical depth,
// against the mean of T in front of the fragments in the cell, since none of them counts itself.
// Between two planes optical depth is interpolated, on a ramp that counts a part of the receiver
// itself; with `own_correction` that part is taken away. Sums in float64. Against T behind the
// cell, which counts the receiver, the measure prefers ratios near 1 whatever the scene.
double split_error(const OpticalDepthProfiles& layers, const OpticalDepthProfiles& fine,
                   bool own_correction = false);

// The score of a trial: the least is the best. `fine` counts for `error` alone.
double split_score(const SplitMeasure& measure, const OpticalDepthProfiles& layers,
                   const OpticalDepthProfiles& fine);

// The ratios of the trials.
constexpr int split_trials = 11;
constexpr double trial_ratio(std::size_t trial) {
    return double(trial) / (split_trials - 1);
}
// The trial with the least score; the first of equals.
std::size_t best_trial(std::span<const double> scores);
// The best of all trials, with layers rebinned from the fine profiles.
std::size_t find_split_trial(const OpticalDepthProfiles& fine, int layers,
                             const SplitMeasure& measure = {});

}  // namespace opacity
