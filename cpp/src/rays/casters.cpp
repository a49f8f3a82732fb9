#include "rays/casters.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "opacity/scene/mesh.hpp"
#include "opacity/scene/strands.hpp"
#include "opacity/scene/volume.hpp"
#include "rays/crossing.hpp"
#include "scene/light_fit.hpp"

namespace opacity::rays {
namespace {

// Copies of what casts, which share its content: nobody changes them meanwhile.
struct Caster {
    const Shape* original;
    std::shared_ptr<const Shape> shape;
};

std::vector<Caster> held_casters(const Scene& scene) {
    std::vector<Caster> casters;
    for (const ShapePtr& shape : scene.shapes())
        if (std::shared_ptr<const Shape> copy = shape->instance(); copy->is_caster())
            casters.push_back({shape.get(), std::move(copy)});
    return casters;
}

// The z axis is where light goes: of a light at a place, to the middle of the casters.
double4x4 rotation_of(const Light& light, const double3& center) {
    if (const auto* directional = dynamic_cast<const DirectionalLight*>(&light))
        return light_rotation(directional->direction());
    const auto* positional = dynamic_cast<const PositionalLight*>(&light);
    const Ray ray = ray_to(center, positional ? positional->position() : center);
    return light_rotation(ray.toward);
}

Frame frame_around(const std::vector<Caster>& casters, const Light& light) {
    Box box;
    for (const Caster& caster : casters) box.extend(caster.shape->bounds());
    if (box.empty()) return {};
    // Of a scene without extent any scale will do.
    const double radius = std::max(box.radius(), 1e-60);
    return {box.center(), rotation_of(light, box.center()), std::exp2(-std::ilogb(radius))};
}

template <class Value>
double at(const std::vector<Value>& values, std::size_t i) {
    return values[values.size() > 1 ? i : 0];
}

double3 point_of(const Shape& shape, std::size_t i, const Frame& frame) {
    return frame.from_world(transform_point(shape.transform(), shape.points()[i]));
}

std::uint32_t add_vertices(const Shape& shape, Casters& casters) {
    const auto first = std::uint32_t(casters.vertices.size());
    for (std::size_t i = 0; i < shape.points().size(); ++i)
        casters.vertices.push_back(
            {point_of(shape, i, casters.frame), 0.0, at(shape.opacity(), i)});
    return first;
}

void add(const Strands& strands, Casters& casters) {
    const std::uint32_t first = add_vertices(strands, casters);
    const double half = 0.5 * strands.scale() * casters.frame.scale;
    for (std::size_t i = 0; i < strands.points().size(); ++i)
        casters.vertices[first + i].half_width = half * at(strands.width(), i);
    for (const std::uint32_t segment : strands.segments())
        casters.segments.push_back(first + segment);
}

void add(const Mesh& mesh, Casters& casters) {
    const std::uint32_t first = add_vertices(mesh, casters);
    const auto first_triangle = std::uint32_t(casters.triangles.size());
    const std::vector<std::uint32_t>& corners = mesh.triangles();
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
        casters.triangles.push_back(
            {first + corners[i], first + corners[i + 1], first + corners[i + 2]});
    if (!mesh.has_alpha()) return;
    for (std::size_t i = 0; i < mesh.points().size(); ++i)
        casters.vertices[first + i].uv = mesh.uvs()[i];
    casters.foliage.push_back(
        {first_triangle, std::uint32_t(casters.triangles.size()), Coverage{mesh}});
}

void add(const Particles& particles, Casters& casters) {
    const double scale = particles.scale() * casters.frame.scale;
    for (std::size_t i = 0; i < particles.points().size(); ++i)
        casters.spheres.push_back({point_of(particles, i, casters.frame),
                                   scale * at(particles.radius(), i),
                                   optical_depth(at(particles.opacity(), i)), particles.profile()});
}

void add(const Caster& caster, const Shape* own, Casters& casters) {
    const Shape& shape = *caster.shape;
    if (const auto* strands = dynamic_cast<const Strands*>(&shape)) add(*strands, casters);
    if (const auto* mesh = dynamic_cast<const Mesh*>(&shape)) add(*mesh, casters);
    if (const auto* particles = dynamic_cast<const Particles*>(&shape)) {
        if (caster.original == own)
            casters.first_own_sphere = std::uint32_t(casters.spheres.size());
        add(*particles, casters);
    }
    if (auto volume = std::dynamic_pointer_cast<const Volume>(caster.shape))
        casters.volumes.emplace_back(std::move(volume), casters.frame);
}

Box box_around(const double3& p, double radius) {
    return Box{p, p}.padded(radius);
}

}  // namespace

Casters::Primitive Casters::primitive(std::uint32_t number) const {
    if (number < segments.size()) return {Kind::segment, number};
    number -= std::uint32_t(segments.size());
    if (number < triangles.size()) return {Kind::triangle, number};
    number -= std::uint32_t(triangles.size());
    if (number < spheres.size()) return {Kind::sphere, number};
    return {Kind::volume, number - std::uint32_t(spheres.size())};
}

Box Casters::bounds_of(std::uint32_t number) const {
    const auto [kind, index] = primitive(number);
    if (kind == Kind::sphere) return box_around(spheres[index].center, spheres[index].radius);
    if (kind == Kind::volume) return volumes[index].bounds();
    Box box;
    const auto extend = [&](std::uint32_t i) {
        box.extend(box_around(vertices[i].position, vertices[i].half_width));
    };
    if (kind == Kind::segment)
        for (const std::uint32_t end : {segments[index], segments[index] + 1}) extend(end);
    else
        for (const std::uint32_t corner : triangles[index]) extend(corner);
    return box;
}

Casters casters_of(const Scene& scene, const Light& light, const Shape* own) {
    const std::vector<Caster> held = held_casters(scene);
    Casters casters;
    casters.frame = frame_around(held, light);
    casters.parallel = light_points(light).empty();
    for (const bool opaque : {false, true}) {
        if (opaque) casters.first_opaque = std::uint32_t(casters.triangles.size());
        for (const Caster& caster : held)
            if (caster.shape->opaque() == opaque) add(caster, own, casters);
    }
    for (std::uint32_t i = 0; i < casters.primitive_count(); ++i)
        casters.bounds.extend(casters.bounds_of(i));
    return casters;
}

}  // namespace opacity::rays
