#include "map/receiver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "opacity/scene/mesh.hpp"
#include "opacity/scene/strands.hpp"
#include "scene/bias.hpp"
#include "scene/receivers.hpp"

namespace opacity {
namespace {

double3 minus(const double3& a, const double3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double3 cross(const double3& a, const double3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

float3 to_float(const double3& v) {
    return {float(v[0]), float(v[1]), float(v[2])};
}

template <class T>
const T& at_or_only(const std::vector<T>& values, std::size_t i) {
    return values[values.size() > 1 ? i : 0];
}

// At each point the direction from the one before to the one after.
void tell_strands(std::vector<Receiver>& list, const std::vector<double3>& p_ls,
                  const Strands& strands, double texels_per_unit) {
    const double to_texels = strands.scale() * texels_per_unit;
    for (std::size_t k = 0; k + 1 < strands.offsets().size(); ++k) {
        const std::size_t root = std::size_t(strands.offsets()[k]);
        const std::size_t end = std::size_t(strands.offsets()[k + 1]);
        for (std::size_t i = root; i < end && end - root > 1; ++i) {
            const double3 along =
                minus(p_ls[std::min(i + 1, end - 1)], p_ls[i > root ? i - 1 : root]);
            const double texels = std::max(std::abs(along[0]), std::abs(along[1]));
            if (!(texels > 0.0)) continue;
            list[i].direction = to_float({along[0] / texels, along[1] / texels, along[2] / texels});
            list[i].width_texels = float(at_or_only(strands.width(), i) * to_texels);
            list[i].ends[0] = i > root ? -endless_texels : 0.f;
            list[i].ends[1] = i + 1 < end ? endless_texels : 0.f;
            list[i].opacity = at_or_only(strands.opacity(), i);
        }
    }
}

// The slope of the triangles that meet at each vertex, by their normals' mean in light space.
void tell_mesh(std::vector<Receiver>& list, const std::vector<double3>& p_ls, const Mesh& mesh,
               bool corrects) {
    std::vector<double3> normals(list.size());
    const auto& corners = mesh.triangles();
    for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
        const double3& a = p_ls[corners[t]];
        double3 n = cross(minus(p_ls[corners[t + 1]], a), minus(p_ls[corners[t + 2]], a));
        if (n[2] < 0.0) n = {-n[0], -n[1], -n[2]};
        for (std::size_t corner = t; corner < t + 3; ++corner)
            for (int axis = 0; axis < 3; ++axis) normals[corners[corner]][axis] += n[axis];
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
        const double3& n = normals[i];
        if (!(n[2] > 0.0)) continue;
        const double3 slope{-n[0] / n[2], -n[1] / n[2], 0.0};
        if (!(std::abs(slope[0]) + std::abs(slope[1]) < 1e18)) continue;
        list[i].direction = to_float(slope);
        if (corrects) list[i].opacity = at_or_only(mesh.opacity(), i);
    }
}

}  // namespace

Query Query::at(Positions world_points, const Scene& scene) {
    check_receivers(world_points);
    return {std::move(world_points), mean_strand_width(scene.shapes()), nullptr};
}

Query Query::at(const Shape& shape, const Scene& scene) {
    Receivers on_shape = receivers_on(shape);
    const auto lock = shape.lock();
    const auto& shapes = scene.shapes();
    const bool is_in_maps =
        shape.is_caster() && !shape.opaque() &&
        std::any_of(shapes.begin(), shapes.end(), [&](const auto& s) { return s.get() == &shape; });
    return {std::move(on_shape.world_points), on_shape.strand_width, &shape, is_in_maps};
}

std::vector<Receiver> receivers_in(const LightSpace& space, const Query& query,
                                   bool own_correction) {
    std::vector<Receiver> list(query.world_points.size());
    std::vector<double3> p_ls(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        p_ls[i] = transform_point(space.from_world, query.world_points[i]);
        list[i].p_ls = to_float(p_ls[i]);
    }
    if (!query.own) return list;
    const auto lock = query.own->lock();
    const bool corrects = own_correction && query.is_in_maps;
    const auto* strands = dynamic_cast<const Strands*>(query.own);
    if (strands)
        for (Receiver& receiver : list) receiver.on_strand = 1.f;
    if (strands && corrects) tell_strands(list, p_ls, *strands, space.texels_per_unit);
    if (const auto* mesh = dynamic_cast<const Mesh*>(query.own))
        tell_mesh(list, p_ls, *mesh, corrects);
    return list;
}

}  // namespace opacity
