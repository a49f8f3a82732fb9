#include "scene/receivers.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "opacity/core/error.hpp"
#include "opacity/scene/particles.hpp"
#include "opacity/scene/volume.hpp"

namespace opacity {
namespace {

Positions moved(const Shape& shape, std::size_t count, const auto& local_point) {
    std::vector<double> world_points;
    world_points.reserve(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const double3 p = transform_point(shape.transform(), local_point(i));
        world_points.insert(world_points.end(), p.begin(), p.end());
    }
    return Positions{std::move(world_points)};
}

}  // namespace

double Receivers::own_half_chord(const double3& direction) const {
    const double3 speed = product(voxels_from_world, direction);
    const double fastest = std::max({std::abs(speed[0]), std::abs(speed[1]), std::abs(speed[2])});
    return fastest > 0.0 ? 0.5 / fastest : 0.0;
}

Receivers receivers_on(const Shape& shape) {
    const auto lock = shape.lock();
    Receivers receivers;
    receivers.strand_width = shape.strand_width();
    receivers.at_particles = dynamic_cast<const Particles*>(&shape) != nullptr;
    if (const auto* volume = dynamic_cast<const Volume*>(&shape)) {
        receivers.voxels_from_world = inverse(linear_part(volume->transform(), volume->spacing()));
        receivers.world_points = moved(shape, volume->voxel_count(),
                                       [&](std::size_t i) { return volume->voxel_center(i); });
    } else {
        receivers.world_points =
            moved(shape, shape.points().size(), [&](std::size_t i) { return shape.points()[i]; });
    }
    return receivers;
}

void check_receivers(const Positions& world_points) {
    const std::size_t bad = world_points.first_bad();
    if (bad == world_points.size()) return;
    throw ParameterError("points[" + std::to_string(bad) + "] is not finite, or larger than 1e18",
                         "remove or repair the point");
}

}  // namespace opacity
