// The hybrid split curve of bounding opacity maps (thesis, section 5.2.3), in closed form:
//     f(x) = (1 - r) x + r log2(1 + 255 x) / 8,   f(0) = 0, f(1) = 1, strictly increasing for every
//     r in [0, 1].
// r = 0 is the linear split, r = 1 the logarithmic one. Layer k of K ends where f(x) = k / K.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace opacity {

// x and ratio in [0, 1].
double split_curve(double x, double ratio);
// The x with split_curve(x, ratio) = y, to 1e-12.
double split_inverse(double y, double ratio);
// The K + 1 planes of K layers, 0 first and 1 last, strictly increasing also as floats.
std::vector<float> layer_planes(int layers, double ratio);

// Optical depth of many texels, cumulative at common planes of [0, 1]: texel t has values[t *
// (planes - 1) + k - 1] in front of planes[k].
struct OpticalDepthProfiles {
    std::span<const float> planes;
    std::span<const float> values;
    std::size_t texel_count() const { return values.size() / (planes.size() - 1); }
};

// How well K layers at this ratio rebuild the profiles for receivers that lie where casters are:
// the RMSE of T at the middle of each fine cell, weighted by the cell's optical depth, against the
// mean of T in front of the fragments in the cell, since none of them counts itself. Sums in
// float64. Against T behind the cell, which counts the receiver, the measure prefers ratios near 1
// whatever the scene.
double split_error(const OpticalDepthProfiles& profiles, int layers, double ratio);
// Of the ratios 0, .1, .. 1 the one with the least split_error; the smallest of equals.
double find_split_ratio(const OpticalDepthProfiles& profiles, int layers);

}  // namespace opacity
