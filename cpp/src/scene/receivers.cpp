#include "scene/receivers.hpp"

#include <string>
#include <utility>
#include <vector>

#include "opacity/core/error.hpp"

namespace opacity {

Receivers receivers_on(const Shape& shape) {
    const auto lock = shape.lock();
    std::vector<double> world_points;
    world_points.reserve(3 * shape.points().size());
    for (std::size_t i = 0; i < shape.points().size(); ++i) {
        const double3 p = transform_point(shape.transform(), shape.points()[i]);
        world_points.insert(world_points.end(), p.begin(), p.end());
    }
    return {Positions{std::move(world_points)}, shape.strand_width()};
}

void check_receivers(const Positions& world_points) {
    const std::size_t bad = world_points.first_bad();
    if (bad == world_points.size()) return;
    throw ParameterError("points[" + std::to_string(bad) + "] is not finite, or larger than 1e18",
                         "remove or repair the point");
}

}  // namespace opacity
