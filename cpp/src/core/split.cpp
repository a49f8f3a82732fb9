#include "opacity/core/split.hpp"

#include <cmath>
#include <numbers>

namespace opacity {

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

std::vector<float> trial_planes(int layers) {
    std::vector<float> all;
    for (std::size_t trial = 0; trial < split_trials; ++trial) {
        const std::vector<float> planes = layer_planes(layers, trial_ratio(trial));
        all.insert(all.end(), planes.begin(), planes.end());
    }
    return all;
}

}  // namespace opacity
