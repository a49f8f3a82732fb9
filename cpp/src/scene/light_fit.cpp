#include "scene/light_fit.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/vector.hpp"
#include "opacity/core/error.hpp"
#include "opacity/scene/mesh.hpp"
#include "scene/bias.hpp"

namespace opacity {
namespace {

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

// World to light space: the origin, in the light's frame, comes to the middle of the map at depth
// 0.
double4x4 to_texels(const double4x4& rotation, const double3& origin, int map_size_px,
                    double texels_per_unit, double range) {
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

double4x4 light_rotation(const double3& direction, const double3& x_near) {
    const double3& z = direction;
    const double3 y = normalized(cross(z, x_near)), x = cross(y, z);
    return {x[0], x[1], x[2], 0, y[0], y[1], y[2], 0, z[0], z[1], z[2], 0, 0, 0, 0, 1};
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

// The axes of the last fit, turned with the light by the shortest way; the window turns about its
// own middle.
double4x4 LightFit::steady_rotation(const double3& direction) {
    constexpr double small_turn = 0.9;  // the cosine of some 25 degrees
    const double4x4 held = rotation_.value_or(double4x4{});
    const double along = held[8] * direction[0] + held[9] * direction[1] + held[10] * direction[2];
    if (!(along > small_turn)) {
        window_.reset();
        return *(rotation_ = light_rotation(direction));
    }
    if (double3{held[8], held[9], held[10]} == direction) return held;
    rotation_ = light_rotation(direction, {held[0], held[1], held[2]});
    if (window_) {
        const double3 middle = transform_point(*rotation_, anchor_);
        window_->middle = {middle[0], middle[1]};
    }
    return *rotation_;
}

Window LightFit::steady_window(const double4x4& rotation, const Window& needed, double depth) {
    const std::optional<Window> held = window_;
    const Window window = steady(window_, needed);
    if (window == held) return window;
    for (std::size_t i = 0; i < 3; ++i)  // the columns of the inverse are the rows of the rotation
        anchor_[i] = window.middle[0] * rotation[i] + window.middle[1] * rotation[4 + i] +
                     depth * rotation[8 + i];
    return window;
}

LightFit::Extent LightFit::measure(const Scene& scene, const double4x4& rotation) {
    CasterBoxes::Key axes{};
    std::copy_n(rotation.begin(), axes.size(), axes.begin());
    const auto place = [&](const double3& p) { return transform_point(rotation, p); };
    Extent extent;
    for (const ShapePtr& shape : scene.shapes()) {
        const auto lock = shape->lock();
        if (shape->receives()) extent.receivers.extend(shape->bounds().transformed(rotation));
        if (!shape->is_caster()) continue;
        const double pad = shape->margin() * shape->scale();
        extent.casters.extend(boxes_.box(*shape, axes, place).padded(pad));
        extent.surfaces |= dynamic_cast<const Mesh*>(shape.get()) != nullptr;
    }
    return extent;
}

LightSpace LightFit::fit(const Scene& scene, const Light& light, const MapSizePx& map_size_px,
                         const Box& query) {
    if (const auto* positional = dynamic_cast<const PositionalLight*>(&light))
        return positional_.fit(scene, *positional, map_size_px, query);
    boxes_.forget_absent(scene);
    return fit_directional(scene, require_directional(light), map_size_px, query);
}

LightSpace LightFit::fit_directional(const Scene& scene, const DirectionalLight& light,
                                     const MapSizePx& size_for, const Box& query) {
    const double4x4 rotation = steady_rotation(light.direction());
    Extent extent = measure(scene, rotation);
    extent.receivers.extend(query.transformed(rotation));
    const Box box = crop(extent.casters, extent.receivers);

    Window needed = Window::around(box);
    needed.side = std::max({needed.side, 1e-6 * box.radius(), 1e-30});
    const Window window = steady_window(rotation, needed, box.center()[2]);
    const int map_size_px = size_for(window.side);
    const double border = map_size_px >= 4 ? 1.0 : 0.0;
    const double texels_per_unit = (map_size_px - 2.0 * border) / window.side;
    const double margin = extent.surfaces ? surface_margin_texels / texels_per_unit : 0.0;
    const double range = std::max(box.max[2] - box.min[2], 1e-6 * window.side) + margin;
    const double3 origin{window.middle[0], window.middle[1], box.min[2]};
    return {.from_world = to_texels(rotation, origin, map_size_px, texels_per_unit, range),
            .map_size_px = map_size_px,
            .depth_range = range,
            .texels_per_unit = texels_per_unit,
            .least_bias = least_bias(scene),
            .faces = {},
            .splits = {},
            .strand_detail = 1.0};
}

}  // namespace opacity
