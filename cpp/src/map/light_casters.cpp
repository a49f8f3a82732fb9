#include "map/light_casters.hpp"

#include <array>

#include "opacity/scene/mesh.hpp"
#include "opacity/scene/strands.hpp"

namespace opacity {
namespace {

// What a vertex shader gets: light space from the points' own frame, joined in float64.
std::array<float, 12> light_from_local(const Shape& shape, const LightSpace& space,
                                       const double3& origin) {
    std::array<float, 12> result;
    const double4x4 &light = space.from_world, &world = shape.transform();
    const double3 world_origin = transform_point(world, origin);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            double sum = 0.0;
            for (int k = 0; k < 3; ++k) sum += light[4 * row + k] * world[4 * k + column];
            result[4 * row + column] = float(sum);
        }
        result[4 * row + 3] = float(transform_point(light, world_origin)[row]);
    }
    return result;
}

std::vector<float4> light_points(const Shape& shape, const LightSpace& space) {
    const auto* strands = dynamic_cast<const Strands*>(&shape);
    const Box bounds = shape.points().bounds();
    const double3 origin = bounds.empty() ? double3{} : bounds.center();
    static const std::vector<float> no_width{0.f};
    const std::vector<float> local =
        shape.points().relative_to(origin, strands ? strands->width() : no_width);
    const std::array<float, 12> m = light_from_local(shape, space, origin);
    const float to_texels = float(shape.scale()) * float(space.texels_per_unit);
    std::vector<float4> points(shape.points().size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float* p = &local[4 * i];
        for (int row = 0; row < 3; ++row) {
            const float* r = &m[4 * row];
            points[i][row] = r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + r[3];
        }
        points[i][3] = p[3] * to_texels;
    }
    return points;
}

}  // namespace

const LightCaster& LightCasters::caster(const ShapePtr& shape_ptr, const LightSpace& space) {
    const Shape& shape = *shape_ptr;
    const auto lock = shape.lock();
    Cached& cached = cache_[&shape];
    const Shape::Revisions& now = shape.revisions();
    cached.shape = shape_ptr;
    LightCaster& caster = cached.caster;
    if (cached.geometry != now.geometry) {
        const auto* strands = dynamic_cast<const Strands*>(&shape);
        const auto* mesh = dynamic_cast<const Mesh*>(&shape);
        caster.strands = strands != nullptr;
        if (strands) caster.indices = strands->segments();
        if (mesh) caster.indices = mesh->triangles();
    }
    if (cached.geometry != now.geometry || cached.transform != now.transform ||
        cached.space != space)
        caster.points = light_points(shape, space);
    if (cached.opacity != now.opacity) caster.opacity = shape.opacity();
    cached.geometry = now.geometry;
    cached.transform = now.transform;
    cached.opacity = now.opacity;
    cached.space = space;
    return caster;
}

void LightCasters::collect() {
    std::erase_if(cache_, [](const auto& entry) { return entry.second.shape.expired(); });
}

}  // namespace opacity
