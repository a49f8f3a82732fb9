#include "opacity/core/split.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace opacity {
namespace {

constexpr int lut_size = 256;

// Entry i of the thesis's table: 8 bits, rounded down.
int lut_entry(int i, double ratio) {
    if (i == 0) return 0;
    constexpr int end = lut_size - 1;
    const int range = int(std::log2(end - 1.0));
    const double value = (1.0 - ratio) * i + ratio * std::log2(double(i)) * end / range;
    return int(std::min(value, double(end)) * 255.0 / end);
}

// Plane k lies where the table first says layer k, or more.
std::vector<float> lut_planes(int layers, double ratio) {
    std::vector<float> planes(std::size_t(layers) + 1, 1.f);
    planes[0] = 0.f;
    for (int i = 0, k = 1; i < lut_size; ++i) {
        const int layer = int(float(lut_entry(i, ratio)) / 255.f * float(layers - 1));
        for (; k <= layer; ++k) planes[std::size_t(k)] = float(i) / lut_size;
    }
    return planes;
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

std::vector<float> layer_planes(int layers, double ratio, bool paper_lut) {
    if (paper_lut) return lut_planes(layers, ratio);
    std::vector<float> planes(std::size_t(layers) + 1, 0.f);
    for (int k = 1; k < layers; ++k) planes[k] = float(split_inverse(double(k) / layers, ratio));
    planes[layers] = 1.f;
    return planes;
}

std::vector<float> trial_planes(int layers, bool paper_lut) {
    std::vector<float> all;
    for (std::size_t trial = 0; trial < split_trials; ++trial) {
        const std::vector<float> planes = layer_planes(layers, trial_ratio(trial), paper_lut);
        all.insert(all.end(), planes.begin(), planes.end());
    }
    return all;
}

}  // namespace opacity
