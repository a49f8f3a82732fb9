#include "scene/steady_window.hpp"

#include <algorithm>
#include <cmath>

namespace opacity {
namespace {

constexpr double most_excess = 4.0 / 3.0, room = 1.06;

}  // namespace

Window Window::around(const Box& box) {
    const double3 center = box.center();
    return {{center[0], center[1]}, std::max(box.max[0] - box.min[0], box.max[1] - box.min[1])};
}

bool Window::contains(const Window& other) const {
    const auto inside = [&](std::size_t axis) {
        return std::abs(other.middle[axis] - middle[axis]) + 0.5 * other.side <=
               0.5 * side * (1.0 + 1e-12);
    };
    return inside(0) && inside(1);
}

Window steady(std::optional<Window>& held, const Window& needed) {
    if (held && held->contains(needed) && held->side <= most_excess * needed.side) return *held;
    const bool is_first = !held;
    held = needed;
    if (!is_first) held->side *= room;
    return *held;
}

}  // namespace opacity
