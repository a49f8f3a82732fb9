#include "opacity/core/split_search.hpp"

#include <algorithm>
#include <cmath>

#include "opacity/core/correlation.hpp"
#include "opacity/core/split.hpp"

namespace opacity {
namespace {

// The look-up of receivers that lie in one texel.
struct Receiver {
    const OpticalDepthProfiles& layers;
    std::span<const float> layered;
    const FineProfiles& fine;
    std::span<const float> exact;
    double bias;
    bool own_correction;

    double interpolated(const PlaneCell& cell) const {
        return std::lerp(at_plane(layered, cell.index), at_plane(layered, cell.index + 1),
                         cell.along);
    }
    // T of the look-up minus that of the casters, for a fragment of optical depth `own` at the
    // middle of fine cell k.
    double error_in(std::size_t k, double own) const {
        const std::span<const float> planes = fine.profiles().planes;
        const double begin = planes[k], end = planes[k + 1], x = 0.5 * (begin + end);
        if (!(x - bias > 0.0)) return 0.0;  // in front of all casters
        const PlaneCell cell = cell_of(layers.planes, x - bias);
        // The profiles know that it lies in its cell, but not where.
        const auto spread = [&](double z) {
            return std::clamp((z - begin) / (end - begin), 0.0, 1.0);
        };
        const double spread_own =
            own * std::lerp(spread(layers.planes[cell.index]),
                            spread(layers.planes[cell.index + 1]), cell.along);
        const double in_front = fine.in_front(exact, x - bias) - own * spread(x - bias);
        return error(interpolated(cell) - spread_own, in_front, own * ramp(x, cell));
    }
    double error_on_last(double own) const {
        if (!(1.0 - bias > 0.0)) return 0.0;
        const PlaneCell cell = cell_of(layers.planes, 1.0 - bias);
        const double own_ramp = own * ramp(1.0, cell);
        const double in_front =
            bias > 0.0 ? fine.in_front(exact, 1.0 - bias) : double(exact.back()) - own;
        return error(interpolated(cell) - own_ramp, in_front, own_ramp);
    }
    // The part of a caster at x that its layer counts at this place.
    double ramp(double x, const PlaneCell& at) const {
        return cell_of(layers.planes, x).index == at.index ? at.along : 0.0;
    }
    double error(double layered_others, double in_front, double own) const {
        return std::exp(-std::max(0.0, layered_others + (own_correction ? 0.0 : own))) -
               std::exp(-std::max(0.0, in_front));
    }
};

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

double split_error(const OpticalDepthProfiles& layers, const FineProfiles& fine,
                   bool own_correction) {
    const std::span<const float> cells = fine.profiles().planes;
    double squares = 0.0, weights = 0.0;
    for (std::size_t t = 0; t < layers.texel_count(); ++t) {
        const std::span<const float> exact = fine.profiles().texel(t);
        if (!is_covered(exact)) continue;
        const Receiver look_up{layers, layers.texel(t),         fine,
                               exact,  fine.profiles().bias(t), own_correction};
        const auto add = [&](double weight, double error) {
            squares += weight * error * error;
            weights += weight;
        };
        for (std::size_t k = 0; k + 1 < cells.size(); ++k) {
            const double cell = at_plane(exact, k + 1) - at_plane(exact, k);
            if (!(cell > 0.0)) continue;
            const double own = fine.fragment_of(cell);
            // T = 1 on the first one, whatever the layers.
            const double others = cell - (k == 0 ? own : 0.0) - (k + 2 == cells.size() ? own : 0.0);
            if (others > 1e-6 * cell) add(others, look_up.error_in(k, own));
            if (k + 2 == cells.size()) add(own, look_up.error_on_last(own));
        }
    }
    return weights > 0.0 ? std::sqrt(squares / weights) : 0.0;
}

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
            return split_error(layers, fine, measure.own_correction);
    }
}

std::size_t best_trial(std::span<const double> scores) {
    return std::size_t(std::min_element(scores.begin(), scores.end()) - scores.begin());
}

std::size_t find_split_trial(const FineProfiles& fine, int layers, const SplitMeasure& measure) {
    std::vector<double> scores;
    for (std::size_t trial = 0; trial < split_trials; ++trial) {
        const std::vector<float> planes = layer_planes(layers, trial_ratio(trial));
        const std::vector<float> values = fine.rebinned(planes);
        scores.push_back(split_score(measure, {planes, values}, fine));
    }
    return best_trial(scores);
}

}  // namespace opacity
