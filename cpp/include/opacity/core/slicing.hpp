// Where layers lie that are alike in all texels: planes of [0, 1], 0 first and 1 last, strictly
// increasing also as floats.
#pragma once

#include <span>
#include <vector>

namespace opacity {

// The slices of opacity shadow maps (Kim and Neumann 2001, figure 3): even; or fine near the light,
// as powers of even steps, the analogue of gamma correction.
std::vector<float> uniform_slices(int count);
std::vector<float> gamma_slices(int count, double gamma);

// A histogram over [0, 1]: cell i lies from planes[i] to planes[i + 1].
struct DepthHistogram {
    std::vector<double> planes, masses;
};
// By 1D BSP: of all slabs that with the greatest mass is halved, until there are enough; where
// nothing is left to tell them apart, the thickest.
std::vector<float> density_slices(int count, const DepthHistogram& histogram);

// Layers of such sizes, together 1 deep.
std::vector<float> planes_of_sizes(std::span<const double> sizes);

}  // namespace opacity
