#include "core/matrix3.hpp"

#include <cmath>

namespace opacity {
namespace {

double3 cross(const double3& a, const double3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

double3x3 linear_part(const double4x4& transform, const double3& scale) {
    double3x3 result{};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            result[3 * row + column] = transform[4 * row + column] * scale[column];
    return result;
}

double3x3 inverse(const double3x3& m) {
    std::array<double3, 3> axis{};  // the columns, of length 1
    double3 length{};
    for (std::size_t i = 0; i < 3; ++i) {
        length[i] = std::hypot(m[i], m[3 + i], m[6 + i]);
        axis[i] = {m[i] / length[i], m[3 + i] / length[i], m[6 + i] / length[i]};
    }
    double3x3 result{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double3 across = cross(axis[(i + 1) % 3], axis[(i + 2) % 3]);
        const double volume =
            across[0] * axis[i][0] + across[1] * axis[i][1] + across[2] * axis[i][2];
        for (std::size_t k = 0; k < 3; ++k) result[3 * i + k] = across[k] / volume / length[i];
    }
    return result;
}

}  // namespace opacity
