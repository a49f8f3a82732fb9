// Linear maps of space, by rows.
#pragma once

#include <array>

#include "opacity/core/math.hpp"

namespace opacity {

using double3x3 = std::array<double, 9>;

inline double3 product(const double3x3& m, const double3& v) {
    return {m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[3] * v[0] + m[4] * v[1] + m[5] * v[2],
            m[6] * v[0] + m[7] * v[1] + m[8] * v[2]};
}
// The linear part of a transform after a scale along each axis.
double3x3 linear_part(const double4x4& transform, const double3& scale = {1, 1, 1});
// Of an invertible map, whatever its units: only directions are multiplied with one another.
double3x3 inverse(const double3x3& m);

}  // namespace opacity
