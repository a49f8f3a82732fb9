// The curve of Morton (1966) through a box: points that follow each other on it lie close together.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "opacity/core/math.hpp"

namespace opacity {

inline constexpr double curve_steps = 1024.0;  // along each axis

// The ten bits of a number, two free bits after each.
inline std::uint64_t spread_bits(std::uint64_t bits) {
    bits = (bits | bits << 16) & 0x030000ff;
    bits = (bits | bits << 8) & 0x0300f00f;
    bits = (bits | bits << 4) & 0x030c30c3;
    return (bits | bits << 2) & 0x09249249;
}

// How far along it a point of the box lies: below 2^30.
inline std::uint64_t place_on_curve(const double3& p, const Box& box) {
    std::uint64_t place = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double side = box.max[axis] - box.min[axis];
        const double part = side > 0.0 ? (p[axis] - box.min[axis]) / side : 0.0;
        const double step = std::clamp(part * curve_steps, 0.0, curve_steps - 1.0);
        place |= spread_bits(std::uint64_t(step)) << axis;
    }
    return place;
}

}  // namespace opacity
