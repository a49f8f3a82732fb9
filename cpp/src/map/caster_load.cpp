#include "map/caster_load.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/vector.hpp"
#include "map/volume_slabs.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/particles.hpp"
#include "opacity/scene/strands.hpp"
#include "opacity/scene/volume.hpp"

namespace opacity {
namespace {

// Means over all directions: of a length across the light, and of its extents along x and y.
constexpr double seen_length = std::numbers::pi / 4.0, seen_extents = 1.0;

double3 cross_of(const double3& a, const double3& b, const double3& c) {
    const double3 u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double3 v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

double strand_length(const Strands& strands) {
    double length = 0.0;
    for (const std::uint32_t first : strands.segments())
        length += distance(strands.points()[first], strands.points()[first + 1]);
    return length;
}

double surface_area(const Mesh& mesh) {
    double area = 0.0;
    const auto& corners = mesh.triangles();
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        const double3 n = cross_of(mesh.points()[corners[i]], mesh.points()[corners[i + 1]],
                                   mesh.points()[corners[i + 2]]);
        area += 0.5 * std::hypot(n[0], n[1], n[2]);
    }
    return area;
}

// The slabs that a ray in any direction passes, as far as they hold something, times the mean area
// that a box shows, which is a quarter of its surface.
double slab_area(const Volume& volume) {
    const Box box = volume.box();
    const double3 side{box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]};
    const double shown = 0.5 * (side[0] * side[1] + side[1] * side[2] + side[2] * side[0]);
    const auto held = std::ranges::count_if(volume.extinction(), [](float e) { return e > 0.f; });
    const double part = double(held) / double(volume.voxel_count());
    return shown * part * std::min(std::cbrt(double(volume.voxel_count())), double(most_slabs));
}

}  // namespace

CasterLoad::Sums CasterLoad::sums_of(const Shape& shape) {
    const double scale = shape.scale();
    if (const auto* strands = dynamic_cast<const Strands*>(&shape)) {
        const double length = scale * strand_length(*strands);
        // A ribbon touches the texels of its area, and those that its axis enters.
        return {double(strands->segments().size()), seen_extents * length,
                seen_length * length * strands->strand_width()};
    }
    if (const auto* mesh = dynamic_cast<const Mesh*>(&shape))
        return {0.0, 0.0, 0.5 * scale * scale * surface_area(*mesh)};
    if (const auto* volume = dynamic_cast<const Volume*>(&shape))
        return {0.0, 0.0, scale * scale * slab_area(*volume)};
    Sums sums;
    if (const auto* particles = dynamic_cast<const Particles*>(&shape)) {
        const std::vector<float>& radius = particles->radius();
        for (std::size_t i = 0; i < particles->points().size(); ++i) {
            const double r = scale * radius[radius.size() > 1 ? i : 0];
            sums.area += 2.0 * std::numbers::pi * r * r;  // both ends of its interval
        }
    }
    return sums;
}

CasterLoad::Kind CasterLoad::kind_of(const Shape& shape) {
    if (dynamic_cast<const Mesh*>(&shape)) return Kind::surfaces;
    return dynamic_cast<const Strands*>(&shape) ? Kind::strands : Kind::media;
}

double CasterLoad::entries(double texels_per_unit) const {
    return sums_.count + sums_.length * texels_per_unit +
           sums_.area * texels_per_unit * texels_per_unit;
}

void CasterLoad::update(const Scene& scene) {
    std::vector<Revision> now;
    for (const ShapePtr& shape : scene.shapes()) {
        const auto lock = shape->lock();
        const Shape::Revisions& part = shape->revisions();
        now.insert(now.end(), {part.geometry, part.transform, part.opacity, part.flags});
    }
    if (now == measured_) return;
    measured_ = std::move(now);
    sums_ = {}, worst_kind_ = Kind::media;
    for (const ShapePtr& shape : scene.shapes()) {
        const auto lock = shape->lock();
        if (!shape->is_caster() || shape->opaque()) continue;
        const Sums own = sums_of(*shape);
        sums_.count += own.count, sums_.length += own.length, sums_.area += own.area;
        worst_kind_ = std::max(worst_kind_, kind_of(*shape));
    }
}

}  // namespace opacity
