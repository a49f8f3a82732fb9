#include "opacity/scene/positions.hpp"

#include <algorithm>
#include <cmath>

namespace opacity {

Box Positions::bounds() const {
    return visit([](const auto& xyz) {
        Box box;
        for (std::size_t i = 0; i + 2 < xyz.size(); i += 3)
            box.extend(double3{xyz[i], xyz[i + 1], xyz[i + 2]});
        return box;
    });
}

std::size_t Positions::first_bad() const {
    return visit([](const auto& xyz) {
        // Written so that NaN, for which every comparison is false, is bad.
        const auto bad = std::find_if_not(
            xyz.begin(), xyz.end(), [](double value) { return std::abs(value) <= max_coordinate; });
        return static_cast<std::size_t>(bad - xyz.begin()) / 3;
    });
}

std::vector<float> Positions::relative_to(const double3& origin, std::span<const float> w) const {
    const std::size_t count = size(), stride = w.size() > 1 ? 1 : 0;
    std::vector<float> result(4 * count);
    visit([&](const auto& xyz) {
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis)
                result[4 * i + axis] = float(double(xyz[3 * i + axis]) - origin[axis]);
            result[4 * i + 3] = w[i * stride];
        }
    });
    return result;
}

}  // namespace opacity
