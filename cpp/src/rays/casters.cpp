#include "rays/casters.hpp"

#include <algorithm>
#include <cmath>

#include "opacity/scene/mesh.hpp"
#include "opacity/scene/strands.hpp"

namespace opacity::rays {
namespace {

Frame frame_around(const Scene& scene, const double4x4& rotation) {
    Box box;
    for (const ShapePtr& shape : scene.shapes()) {
        const auto lock = shape->lock();
        if (shape->is_caster()) box.extend(shape->bounds());
    }
    if (box.empty()) return {{}, rotation, 1.0};
    // Of a scene without extent any scale will do.
    const double radius = std::max(box.radius(), 1e-60);
    return {box.center(), rotation, std::exp2(-std::ilogb(radius))};
}

template <class Value>
double at(const std::vector<Value>& values, std::size_t i) {
    return values[values.size() > 1 ? i : 0];
}

// With the shape's lock held.
void add_vertices(const Shape& shape, Casters& casters) {
    const auto* strands = dynamic_cast<const Strands*>(&shape);
    const double half = 0.5 * shape.scale() * casters.frame.scale;
    for (std::size_t i = 0; i < shape.points().size(); ++i) {
        const double3 world = transform_point(shape.transform(), shape.points()[i]);
        casters.vertices.push_back({casters.frame.from_world(world),
                                    strands ? half * at(strands->width(), i) : 0.0,
                                    at(shape.opacity(), i)});
    }
}

void add_shape(const Shape& shape, Casters& casters) {
    const auto first = std::uint32_t(casters.vertices.size());
    add_vertices(shape, casters);
    if (const auto* strands = dynamic_cast<const Strands*>(&shape))
        for (const std::uint32_t segment : strands->segments())
            casters.segments.push_back(first + segment);
    if (const auto* mesh = dynamic_cast<const Mesh*>(&shape)) {
        const std::vector<std::uint32_t>& corners = mesh->triangles();
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
            casters.triangles.push_back(
                {first + corners[i], first + corners[i + 1], first + corners[i + 2]});
    }
}

void extend(Box& box, const Vertex& vertex) {
    box.extend(Box{vertex.position, vertex.position}.padded(vertex.half_width));
}

}  // namespace

double3 Frame::from_world(const double3& p) const {
    const double3 turned =
        transform_point(rotation, {p[0] - center[0], p[1] - center[1], p[2] - center[2]});
    return {turned[0] * scale, turned[1] * scale, turned[2] * scale};
}

Box Casters::bounds_of(std::uint32_t primitive) const {
    Box box;
    if (primitive < segments.size()) {
        const std::uint32_t first = segments[primitive];
        extend(box, vertices[first]);
        extend(box, vertices[first + 1]);
    } else {
        for (const std::uint32_t corner : triangles[primitive - segments.size()])
            extend(box, vertices[corner]);
    }
    return box;
}

Casters casters_of(const Scene& scene, const double4x4& rotation) {
    Casters casters;
    casters.frame = frame_around(scene, rotation);
    for (const bool opaque : {false, true}) {
        if (opaque) casters.first_opaque = std::uint32_t(casters.triangles.size());
        for (const ShapePtr& shape : scene.shapes()) {
            const auto lock = shape->lock();
            if (shape->is_caster() && shape->opaque() == opaque) add_shape(*shape, casters);
        }
    }
    for (std::uint32_t i = 0; i < casters.primitive_count(); ++i)
        casters.bounds.extend(casters.bounds_of(i));
    return casters;
}

}  // namespace opacity::rays
