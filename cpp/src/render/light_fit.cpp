#include "render/light_fit.hpp"

#include <algorithm>
#include <cmath>

#include "opacity/scene/mesh.hpp"

namespace opacity::render {
namespace {

double3 cross(const double3& a, const double3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double3 normalized(const double3& v) {
    const double length = std::hypot(v[0], v[1], v[2]);
    return {v[0] / length, v[1] / length, v[2] / length};
}

// World to a frame whose z axis is the light's direction.
double4x4 rotation_to(const double3& direction) {
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

Box crop(const Box& casters, const Box& receivers) {
    Box box = casters;
    if (receivers.empty()) return box;
    for (int i = 0; i < 2; ++i) {
        box.min[i] = std::max(casters.min[i], receivers.min[i]);
        box.max[i] = std::min(casters.max[i], receivers.max[i]);
    }
    // What lies behind every receiver shadows none; what lies in front shadows all.
    box.max[2] = std::min(casters.max[2], receivers.max[2]);
    const bool disjoint =
        box.min[0] > box.max[0] || box.min[1] > box.max[1] || box.min[2] > box.max[2];
    return disjoint ? Box{} : box;
}

// Surfaces are moved back by up to eight texels (lib/deposit.glsl), and must stay inside the range.
constexpr double surface_margin_texels = 10.0;

bool is_surface(const Shape& shape) {
    return dynamic_cast<const Mesh*>(&shape) != nullptr;
}

}  // namespace

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

void LightFit::update(View& view, const Scene& scene, const DirectionalLight& light,
                      int map_size_px, const Box& query) {
    const double4x4 rotation = rotation_to(light.direction());
    Box casters, receivers = query.transformed(rotation);
    Box translucent_in_world, opaque_in_world;
    bool surfaces = false;
    for (const ShapePtr& shape : scene.shapes()) {
        const auto lock = shape->lock();
        const bool casts = shape->casts() && !shape->invisible_to_light();
        if (casts) {
            casters.extend(caster_box(*shape, rotation, light.direction()));
            (shape->opaque() ? opaque_in_world : translucent_in_world).extend(shape->bounds());
            surfaces |= is_surface(*shape);
        }
        if (shape->receives()) receivers.extend(shape->bounds().transformed(rotation));
    }
    std::erase_if(cache_, [&](const auto& entry) {
        return std::none_of(scene.shapes().begin(), scene.shapes().end(),
                            [&](const ShapePtr& shape) { return shape.get() == entry.first; });
    });
    Box box = crop(casters, receivers);
    if (box.empty()) box = casters;                 // no receiver in their shadow
    if (box.empty()) box = {{0, 0, 0}, {1, 1, 1}};  // nothing casts: any map will do

    const double border = map_size_px >= 4 ? 1.0 : 0.0;
    const double extent =
        std::max({box.max[0] - box.min[0], box.max[1] - box.min[1], 1e-6 * box.radius(), 1e-30});
    const double texels_per_unit = (map_size_px - 2.0 * border) / extent;
    const double margin = surfaces ? surface_margin_texels / texels_per_unit : 0.0;
    const double range = std::max(box.max[2] - box.min[2], 1e-6 * extent) + margin;

    // x, y: centred in texels; z: from the first caster, as a fraction of the range.
    double4x4 from_world = rotation;
    const double scale[3] = {texels_per_unit, texels_per_unit, 1.0 / range};
    const double3 center = box.center();
    const double origin[3] = {center[0], center[1], box.min[2]},
                 offset[3] = {0.5 * map_size_px, 0.5 * map_size_px, 0};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) from_world[4 * row + column] *= scale[row];
        from_world[4 * row + 3] = offset[row] - origin[row] * scale[row];
    }
    // Of what lets light through: a wide opaque ground must not widen the bias within hair.
    const Box& extent_in_world =
        translucent_in_world.empty() ? opaque_in_world : translucent_in_world;
    const double least_bias = std::max(1e-4 * extent_in_world.radius(), 1e-30);
    view.update(from_world, {{"u_light_map_size_px", map_size_px},
                             {"u_light_depth_range", float(range)},
                             {"u_light_texels_per_unit", float(texels_per_unit)},
                             {"u_light_least_bias", float(least_bias)}});
}

}  // namespace opacity::render
