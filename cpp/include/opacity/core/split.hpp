// The hybrid split curve of bounding opacity maps (thesis, section 5.2.3), in closed form:
//     f(x) = (1 - r) x + r log2(1 + 255 x) / 8,   f(0) = 0, f(1) = 1, strictly increasing for every
//     r in [0, 1].
// r = 0 is the linear split, r = 1 the logarithmic one. Layer k of K ends where f(x) = k / K.
#pragma once

#include <cstddef>
#include <vector>

namespace opacity {

// x and ratio in [0, 1].
double split_curve(double x, double ratio);
// The x with split_curve(x, ratio) = y, to 1e-12.
double split_inverse(double y, double ratio);
// The K + 1 planes of K layers, 0 first and 1 last, strictly increasing also as floats.
//
// With `paper_lut` those of the thesis's look-up texture (appendix, sections 7 to 9), which tells
// the layer of each 256th of the range in 8 bits. A cast makes log2 of 254 a 7, so that the
// logarithmic table is full at half of the range, which is all in the last layer; layers that no
// entry names are empty, and their planes coincide with the next.
std::vector<float> layer_planes(int layers, double ratio, bool paper_lut = false);

// The ratios that a search tries.
constexpr int split_trials = 11;
constexpr double trial_ratio(std::size_t trial) {
    return double(trial) / (split_trials - 1);
}
// The planes of layer_planes at each of them, one after the other.
std::vector<float> trial_planes(int layers, bool paper_lut = false);

}  // namespace opacity
