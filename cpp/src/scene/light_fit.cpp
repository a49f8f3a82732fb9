#include "scene/light_fit.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "opacity/core/error.hpp"
#include "opacity/scene/mesh.hpp"
#include "scene/bias.hpp"

namespace opacity {
namespace {

double3 cross(const double3& a, const double3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double3 normalized(const double3& v) {
    const double length = std::hypot(v[0], v[1], v[2]);
    return {v[0] / length, v[1] / length, v[2] / length};
}

// What the map must cover: the casters as far as any receiver can be in their shadow.
Box crop(const Box& casters, const Box& receivers) {
    if (casters.empty()) return {{0, 0, 0}, {1, 1, 1}};  // any map will do
    if (receivers.empty()) return casters;
    Box box = casters;
    for (int i = 0; i < 2; ++i) {
        box.min[i] = std::max(casters.min[i], receivers.min[i]);
        box.max[i] = std::min(casters.max[i], receivers.max[i]);
    }
    // What lies behind every receiver shadows none; what lies in front shadows all.
    box.max[2] = std::min(casters.max[2], receivers.max[2]);
    const bool disjoint =
        box.min[0] > box.max[0] || box.min[1] > box.max[1] || box.min[2] > box.max[2];
    return disjoint ? casters : box;
}

// Surfaces are moved back by up to eight texels (lib/deposit.glsl), and must stay inside the range.
constexpr double surface_margin_texels = 10.0;

// World to light space: x and y in texels about the middle of the map, z a fraction of the range.
double4x4 to_texels(const double4x4& rotation, const Box& box, int map_size_px,
                    double texels_per_unit, double range) {
    const double3 center = box.center();
    const double3 origin{center[0], center[1], box.min[2]};
    const double3 offset{0.5 * map_size_px, 0.5 * map_size_px, 0.0};
    const double3 scale{texels_per_unit, texels_per_unit, 1.0 / range};
    double4x4 from_world = rotation;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) from_world[4 * row + column] *= scale[row];
        from_world[4 * row + 3] = offset[row] - origin[row] * scale[row];
    }
    return from_world;
}

}  // namespace

const DirectionalLight& require_directional(const Light& light) {
    if (const auto* directional = dynamic_cast<const DirectionalLight*>(&light))
        return *directional;
    throw ParameterError(std::string{"a light is a "} + light.kind() + " light",
                         "use a DirectionalLight");
}

double4x4 light_rotation(const double3& direction) {
    const auto smallest = [&] {
        int axis = 0;
        for (int i = 1; i < 3; ++i)
            if (std::abs(direction[i]) < std::abs(direction[axis])) axis = i;
        return axis;
    }();
    double3 reference{};
    reference[smallest] = 1.0;
    const double3 x = normalized(cross(reference, direction)), y = cross(direction, x);
    const double3& z = direction;
    return {x[0], x[1], x[2], 0, y[0], y[1], y[2], 0, z[0], z[1], z[2], 0, 0, 0, 0, 1};
}

Box LightFit::caster_box(const Shape& shape, const double4x4& rotation, const double3& direction) {
    Cached& cached = cache_[&shape];
    const Shape::Revisions& now = shape.revisions();
    if (cached.geometry == now.geometry && cached.transform == now.transform &&
        cached.direction == direction)
        return cached.box;
    Box box;
    for (std::size_t i = 0; i < shape.points().size(); ++i)
        box.extend(
            transform_point(rotation, transform_point(shape.transform(), shape.points()[i])));
    const double pad = shape.margin() * shape.scale();
    cached = {now.geometry, now.transform, direction, box.padded(pad)};
    return cached.box;
}

LightFit::Extent LightFit::measure(const Scene& scene, const double4x4& rotation,
                                   const double3& direction) {
    Extent extent;
    for (const ShapePtr& shape : scene.shapes()) {
        const auto lock = shape->lock();
        if (shape->receives()) extent.receivers.extend(shape->bounds().transformed(rotation));
        if (!shape->is_caster()) continue;
        extent.casters.extend(caster_box(*shape, rotation, direction));
        extent.surfaces |= dynamic_cast<const Mesh*>(shape.get()) != nullptr;
    }
    return extent;
}

void LightFit::forget_absent(const Scene& scene) {
    std::erase_if(cache_, [&](const auto& entry) {
        return std::none_of(scene.shapes().begin(), scene.shapes().end(),
                            [&](const ShapePtr& shape) { return shape.get() == entry.first; });
    });
}

LightSpace LightFit::fit(const Scene& scene, const DirectionalLight& light,
                         const MapSizePx& size_for, const Box& query) {
    const double4x4 rotation = light_rotation(light.direction());
    Extent extent = measure(scene, rotation, light.direction());
    extent.receivers.extend(query.transformed(rotation));
    forget_absent(scene);
    const Box box = crop(extent.casters, extent.receivers);

    const double side =
        std::max({box.max[0] - box.min[0], box.max[1] - box.min[1], 1e-6 * box.radius(), 1e-30});
    const int map_size_px = size_for(side);
    const double border = map_size_px >= 4 ? 1.0 : 0.0;
    const double texels_per_unit = (map_size_px - 2.0 * border) / side;
    const double margin = extent.surfaces ? surface_margin_texels / texels_per_unit : 0.0;
    const double range = std::max(box.max[2] - box.min[2], 1e-6 * side) + margin;
    return {to_texels(rotation, box, map_size_px, texels_per_unit, range), map_size_px, range,
            texels_per_unit, least_bias(scene)};
}

}  // namespace opacity
