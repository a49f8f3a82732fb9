#include "opacity/core/split_search.hpp"

#include <algorithm>
#include <cmath>

#include "opacity/core/correlation.hpp"
#include "opacity/core/split.hpp"

namespace opacity {
namespace {

// The cell that holds x, and how far into it.
struct Cell {
    std::size_t index;
    double along;
};

Cell cell_of(std::span<const float> planes, double x) {
    const auto above = std::upper_bound(planes.begin() + 1, planes.end() - 1, x);
    const std::size_t index = std::size_t(above - planes.begin()) - 1;
    const double begin = planes[index], end = planes[index + 1];
    return {index, std::clamp((x - begin) / (end - begin), 0.0, 1.0)};
}

// Optical depth in front of plane k; nothing is in front of plane 0.
double at_plane(std::span<const float> texel, std::size_t k) {
    return k == 0 ? 0.0 : double(texel[k - 1]);
}

double interpolate(std::span<const float> texel, const Cell& cell) {
    return std::lerp(at_plane(texel, cell.index), at_plane(texel, cell.index + 1), cell.along);
}

// The optical depth of one fragment, as far as the profiles show it: the mean of the cells that
// stand between two empty ones. 0 where casters fill their cells, as smoke does.
double fragment_optical_depth(const OpticalDepthProfiles& profiles) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t t = 0; t < profiles.texel_count(); ++t) {
        const std::span<const float> texel = profiles.texel(t);
        for (std::size_t k = 1; k + 1 < profiles.layers(); ++k) {
            const bool alone = texel[k - 1] < texel[k] && texel[k] == texel[k + 1] &&
                               (k == 1 ? 0.f : texel[k - 2]) == texel[k - 1];
            if (!alone) continue;
            sum += double(texel[k]) - double(texel[k - 1]);
            ++count;
        }
    }
    return count ? sum / double(count) : 0.0;
}

// How many equal fragments a cell of this optical depth holds.
double fragments_in(double cell, double fragment) {
    return fragment > 0.0 ? std::max(1.0, std::round(cell / fragment)) : 1e6;
}

// The mean over n equal fragments, of optical depth `cell` together, of T in front of each: 1 for
// one fragment, (1 - exp(-cell)) / cell for very many.
double mean_in_front(double cell, double n) {
    return std::expm1(-cell) / (n * std::expm1(-cell / n));
}

bool is_covered(std::span<const float> texel) {
    return texel.back() > 0.f;
}

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

std::vector<float> rebinned(const OpticalDepthProfiles& fine, std::span<const float> planes) {
    std::vector<Cell> cells;
    for (std::size_t k = 1; k < planes.size(); ++k)
        cells.push_back(cell_of(fine.planes, planes[k]));
    std::vector<float> values;
    values.reserve(fine.texel_count() * cells.size());
    for (std::size_t t = 0; t < fine.texel_count(); ++t)
        for (const Cell& cell : cells) values.push_back(float(interpolate(fine.texel(t), cell)));
    return values;
}

double split_error(const OpticalDepthProfiles& layers, const OpticalDepthProfiles& fine,
                   bool own_correction) {
    // Where the receivers lie among the layers: the same for every texel.
    std::vector<Cell> cells;
    for (std::size_t k = 0; k < fine.layers(); ++k)
        cells.push_back(
            cell_of(layers.planes, 0.5 * (double(fine.planes[k]) + double(fine.planes[k + 1]))));
    const double fragment = fragment_optical_depth(fine);
    double squares = 0.0, weights = 0.0;
    for (std::size_t t = 0; t < fine.texel_count(); ++t) {
        const std::span<const float> exact = fine.texel(t), layered = layers.texel(t);
        if (!is_covered(exact)) continue;
        for (std::size_t k = 0; k < fine.layers(); ++k) {
            const double in_front = at_plane(exact, k);
            const double weight = at_plane(exact, k + 1) - in_front;  // of the receivers here
            if (!(weight > 0.0)) continue;
            const double n = fragments_in(weight, fragment);
            double layered_depth = interpolate(layered, cells[k]);
            if (own_correction)
                layered_depth = std::max(0.0, layered_depth - weight / n * cells[k].along);
            const double error =
                std::exp(-layered_depth) - std::exp(-in_front) * mean_in_front(weight, n);
            squares += weight * error * error;
            weights += weight;
        }
    }
    return weights > 0.0 ? std::sqrt(squares / weights) : 0.0;
}

double split_score(const SplitMeasure& measure, const OpticalDepthProfiles& layers,
                   const OpticalDepthProfiles& fine) {
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

std::size_t find_split_trial(const OpticalDepthProfiles& fine, int layers,
                             const SplitMeasure& measure) {
    std::vector<double> scores;
    for (std::size_t trial = 0; trial < split_trials; ++trial) {
        const std::vector<float> planes = layer_planes(layers, trial_ratio(trial));
        const std::vector<float> values = rebinned(fine, planes);
        scores.push_back(split_score(measure, {planes, values}, fine));
    }
    return best_trial(scores);
}

}  // namespace opacity
