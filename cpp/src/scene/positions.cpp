#include "opacity/scene/positions.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"

namespace opacity {
namespace {

constexpr std::size_t points_at_once = 1 << 16;

}  // namespace

Box Positions::bounds() const {
    std::vector<Box> boxes((size() + points_at_once - 1) / points_at_once);
    visit([&](const auto& xyz) {
        parallel_parts(size(), points_at_once, [&](std::size_t begin, std::size_t end) {
            Box box;
            for (std::size_t i = 3 * begin; i < 3 * end; i += 3)
                box.extend(double3{xyz[i], xyz[i + 1], xyz[i + 2]});
            boxes[begin / points_at_once] = box;
        });
    });
    Box all;
    for (const Box& box : boxes) all.extend(box);
    return all;
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
