#include "opacity/scene/positions.hpp"

#include <algorithm>
#include <cmath>

namespace opacity {

Box Positions::bounds() const {
    Box box;
    for (std::size_t i = 0, n = size(); i < n; ++i) box.extend((*this)[i]);
    return box;
}

std::size_t Positions::first_bad() const {
    return std::visit(
        [](const auto& xyz) {
            // Written so that NaN, for which every comparison is false, is bad.
            const auto bad = std::find_if_not(xyz.begin(), xyz.end(), [](double value) {
                return std::abs(value) <= max_coordinate;
            });
            return static_cast<std::size_t>(bad - xyz.begin()) / 3;
        },
        *xyz_);
}

std::vector<float> Positions::relative_to(const double3& origin, std::span<const float> w) const {
    const std::size_t count = size(), stride = w.size() > 1 ? 1 : 0;
    std::vector<float> result(4 * count);
    std::visit(
        [&](const auto& xyz) {
            for (std::size_t i = 0; i < count; ++i) {
                for (std::size_t axis = 0; axis < 3; ++axis)
                    result[4 * i + axis] = float(double(xyz[3 * i + axis]) - origin[axis]);
                result[4 * i + 3] = w[i * stride];
            }
        },
        *xyz_);
    return result;
}

}  // namespace opacity
