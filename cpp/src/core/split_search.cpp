#include "opacity/core/split_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/parallel.hpp"
#include "opacity/core/correlation.hpp"
#include "opacity/core/split_error.hpp"

namespace opacity {
namespace {

double opacity_of(double optical_depth) {
    return -std::expm1(-optical_depth);
}

// What a target of 8 bits a channel keeps, as the thesis reads it.
double in_8_bits(double optical_depth) {
    return std::round(255.0 * std::clamp(optical_depth, 0.0, 1.0));
}

// Calls compare(k, nearer, farther) for the neighbouring images k and k + 1 of each texel.
template <class Compare>
std::size_t compare_opacities(const OpticalDepthProfiles& layers, Compare compare) {
    std::size_t covered = 0;
    for (std::size_t t = 0; t < layers.texel_count(); ++t) {
        const std::span<const float> texel = layers.texel(t);
        if (!is_covered(texel)) continue;
        ++covered;
        for (std::size_t k = 0; k < layers.layers(); ++k)
            compare(k, opacity_of(at_plane(texel, k)), opacity_of(at_plane(texel, k + 1)));
    }
    return covered;
}

template <class Compare>
void compare_as_in_paper(const OpticalDepthProfiles& layers, Compare compare) {
    for (std::size_t t = 0; t < layers.texel_count(); ++t) {
        const std::span<const float> texel = layers.texel(t);
        for (std::size_t k = 0; k + 1 < layers.layers(); ++k)
            compare(k, in_8_bits(texel[k]), in_8_bits(texel[k + 1]));
    }
}

double smallest_difference(const OpticalDepthProfiles& layers) {
    std::vector<double> sums(layers.layers(), 0.0);
    const std::size_t covered =
        compare_opacities(layers, [&](std::size_t k, double nearer, double farther) {
            sums[k] += std::abs(farther - nearer);
        });
    return covered ? *std::min_element(sums.begin(), sums.end()) / double(covered) : 0.0;
}

double paper_difference(const OpticalDepthProfiles& layers) {
    double sum = 0.0;
    compare_as_in_paper(layers, [&](std::size_t, double nearer, double farther) {
        sum += std::abs(farther - nearer);
    });
    return sum;
}

double mean_coefficient(std::span<const Correlation> neighbours) {
    double sum = 0.0;
    for (const Correlation& pair : neighbours) sum += pair.coefficient();
    return neighbours.empty() ? 1.0 : sum / double(neighbours.size());
}

double mean_correlation(const OpticalDepthProfiles& layers) {
    std::vector<Correlation> neighbours(layers.layers());
    compare_opacities(layers, [&](std::size_t k, double nearer, double farther) {
        neighbours[k].add(nearer, farther);
    });
    return mean_coefficient(neighbours);
}

double paper_correlation(const OpticalDepthProfiles& layers) {
    std::vector<Correlation> neighbours(layers.layers() - 1);
    compare_as_in_paper(layers, [&](std::size_t k, double nearer, double farther) {
        neighbours[k].add(nearer, farther);
    });
    return mean_coefficient(neighbours);
}

}  // namespace

double split_score(const SplitMeasure& measure, const OpticalDepthProfiles& layers,
                   const FineProfiles& fine) {
    switch (measure.similarity) {
        case Similarity::absolute_difference:
            return -smallest_difference(layers);
        case Similarity::correlation:
            return mean_correlation(layers);
        case Similarity::paper_absolute_difference:
            return -paper_difference(layers);
        case Similarity::paper_correlation:
            return paper_correlation(layers);
        default:
            return split_error(layers, fine, measure.look_up);
    }
}

std::size_t best_trial(std::span<const double> scores, Similarity similarity) {
    constexpr double equal_errors = 1e-4;
    const double least = *std::min_element(scores.begin(), scores.end());
    const double enough = similarity == Similarity::error ? least + equal_errors : least;
    const auto is_enough = [enough](double score) { return score <= enough; };
    return std::size_t(std::ranges::find_if(scores, is_enough) - scores.begin());
}

std::size_t find_split_trial(const FineProfiles& fine, int layers, const SplitMeasure& measure) {
    std::optional<FineReceivers> receivers;
    if (measure.similarity == Similarity::error) receivers.emplace(fine);
    std::vector<double> scores(split_trials);
    parallel_for(split_trials, [&](std::size_t trial) {
        const std::vector<float> planes =
            layer_planes(layers, trial_ratio(trial), measure.paper_lut);
        const std::vector<float> values = fine.rebinned(planes);
        const std::vector<float> moments =
            receivers && measure.has_moments ? fine.rebinned_moments(planes) : std::vector<float>{};
        const OpticalDepthProfiles rebinned{.planes = planes, .values = values, .moments = moments};
        scores[trial] = receivers ? receivers->error(rebinned, measure.look_up)
                                  : split_score(measure, rebinned, fine);
    });
    return best_trial(scores, measure.similarity);
}

}  // namespace opacity
