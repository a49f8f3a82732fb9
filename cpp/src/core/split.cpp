#include "opacity/core/split.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace opacity {
namespace {

// The fine cell that holds x, and how far into it.
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

double interpolate(std::span<const double> cumulative, const Cell& cell) {
    return std::lerp(cumulative[cell.index], cumulative[cell.index + 1], cell.along);
}

// The optical depth of one fragment, as far as the profiles show it: the mean of the cells that
// stand between two empty ones. 0 where casters fill their cells, as smoke does.
double fragment_optical_depth(const OpticalDepthProfiles& profiles) {
    const std::size_t fine = profiles.planes.size() - 1;
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t texel = 0; texel < profiles.texel_count(); ++texel) {
        const float* cumulative = &profiles.values[texel * fine];
        for (std::size_t k = 2; k < fine; ++k) {
            const bool alone = cumulative[k - 2] < cumulative[k - 1] &&
                               cumulative[k - 1] == cumulative[k] &&
                               (k == 2 ? 0.f : cumulative[k - 3]) == cumulative[k - 2];
            if (!alone) continue;
            sum += double(cumulative[k - 1]) - double(cumulative[k - 2]);
            ++count;
        }
    }
    return count ? sum / double(count) : 0.0;
}

// The mean over n equal fragments, of optical depth `cell` together, of T in front of each: 1 for
// one fragment, (1 - exp(-cell)) / cell for very many.
double mean_in_front(double cell, double fragment) {
    const double n = fragment > 0.0 ? std::max(1.0, std::round(cell / fragment)) : 1e6;
    return std::expm1(-cell) / (n * std::expm1(-cell / n));
}

}  // namespace

double split_curve(double x, double ratio) {
    return (1.0 - ratio) * x + ratio * std::log1p(255.0 * x) / (8.0 * std::numbers::ln2);
}

double split_inverse(double y, double ratio) {
    double low = 0.0, high = 1.0;
    // Bisection alone: 50 halvings are exact enough, always converge, and run K times a frame at
    // most.
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (split_curve(middle, ratio) < y ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

std::vector<float> layer_planes(int layers, double ratio) {
    std::vector<float> planes(std::size_t(layers) + 1, 0.f);
    for (int k = 1; k < layers; ++k) planes[k] = float(split_inverse(double(k) / layers, ratio));
    planes[layers] = 1.f;
    return planes;
}

double split_error(const OpticalDepthProfiles& profiles, int layers, double ratio) {
    const std::vector<float> planes = layer_planes(layers, ratio);
    const std::size_t fine = profiles.planes.size() - 1;
    // Where the K planes lie among the fine ones, and the fine ones among the K: the same for every
    // texel.
    std::vector<Cell> coarse_in_fine, fine_in_coarse;
    for (float x : planes) coarse_in_fine.push_back(cell_of(profiles.planes, x));
    for (std::size_t k = 1; k <= fine; ++k)
        fine_in_coarse.push_back(
            cell_of(planes, 0.5 * (profiles.planes[k - 1] + profiles.planes[k])));

    const double fragment = fragment_optical_depth(profiles);
    std::vector<double> exact(fine + 1), layered(planes.size());
    double squares = 0.0, weights = 0.0;
    for (std::size_t texel = 0; texel < profiles.texel_count(); ++texel) {
        std::copy_n(profiles.values.begin() + texel * fine, fine, exact.begin() + 1);
        for (std::size_t k = 0; k < planes.size(); ++k)
            layered[k] = interpolate(exact, coarse_in_fine[k]);
        for (std::size_t k = 1; k <= fine; ++k) {
            const double weight = exact[k] - exact[k - 1];  // receivers are where casters are
            if (!(weight > 0.0)) continue;
            const double layered_depth = interpolate(layered, fine_in_coarse[k - 1]);
            const double in_front = std::exp(-exact[k - 1]) * mean_in_front(weight, fragment);
            const double error = std::exp(-layered_depth) - in_front;
            squares += weight * error * error;
            weights += weight;
        }
    }
    return weights > 0.0 ? std::sqrt(squares / weights) : 0.0;
}

double find_split_ratio(const OpticalDepthProfiles& profiles, int layers) {
    double best_ratio = 0.0, best_error = split_error(profiles, layers, 0.0);
    for (int tenth = 1; tenth <= 10; ++tenth) {
        const double error = split_error(profiles, layers, 0.1 * tenth);
        if (error < best_error) best_error = error, best_ratio = 0.1 * tenth;
    }
    return best_ratio;
}

}  // namespace opacity
