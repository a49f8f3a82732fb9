#include "map/receiver.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "core/parallel.hpp"
#include "map/surface.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/strands.hpp"
#include "opacity/scene/volume.hpp"
#include "scene/bias.hpp"
#include "scene/receivers.hpp"
#include "scene/strand_ranks.hpp"

namespace opacity {
namespace {

constexpr std::size_t points_at_once = 1 << 14;

float3 to_float(const double3& v) {
    return {float(v[0]), float(v[1]), float(v[2])};
}

template <class T>
const T& at_or_only(const std::vector<T>& values, std::size_t i) {
    return values[values.size() > 1 ? i : 0];
}

// Along a strand, one texel long; before faces, as long as it comes.
void tell_direction(Receiver& receiver, const double3& along, bool is_parallel) {
    const double texels = is_parallel ? std::max(std::abs(along[0]), std::abs(along[1])) : 1.0;
    if (texels > 0.0)
        receiver.direction = to_float({along[0] / texels, along[1] / texels, along[2] / texels});
}

// At each point the direction from the one before to the one after.
void tell_strands(std::vector<Receiver>& list, const std::vector<double3>& p_ls,
                  const Strands& strands, const LightSpace& space) {
    const double detail = space.strand_detail;
    const double to_texels = strands.scale() * space.texels_per_unit * widening_of(strands, detail);
    const auto ranks = detail < 1.0 ? strands.ranks() : nullptr;
    const float endless = space.is_parallel() ? endless_texels : endless_segments;
    for (std::size_t k = 0; k + 1 < strands.offsets().size(); ++k) {
        const std::size_t root = std::size_t(strands.offsets()[k]);
        const std::size_t end = std::size_t(strands.offsets()[k + 1]);
        if (ranks && !ranks->is_kept(k, detail)) continue;  // it has left nothing
        for (std::size_t i = root; i < end && end - root > 1; ++i) {
            const double3 along =
                minus(p_ls[std::min(i + 1, end - 1)], p_ls[i > root ? i - 1 : root]);
            tell_direction(list[i], along, space.is_parallel());
            if (list[i].direction == float3{}) continue;
            list[i].width_texels = float(at_or_only(strands.width(), i) * to_texels);
            list[i].ends[0] = i > root ? -endless : 0.f;
            list[i].ends[1] = i + 1 < end ? endless : 0.f;
            list[i].opacity = at_or_only(strands.opacity(), i);
        }
    }
}

// The mean normal in light coordinates of the triangles that meet at each vertex, by their areas.
// Triangles may be wound either way: of the mean as they are and that of all turned away from the
// light the longer one is that of a surface, in the other they cancel.
std::vector<double3> mean_normals(const std::vector<double3>& p_ls, const Mesh& mesh,
                                  const LightSpace& space) {
    const bool is_parallel = space.is_parallel();
    // A normal's length in the world but for a factor: texels and depth ranges are not as long.
    const double across = is_parallel ? space.depth_range * space.texels_per_unit : 1.0;
    const auto length = [&](const double3& n) {
        return std::hypot(across * n[0], across * n[1], n[2]);
    };
    std::vector<double3> normals(p_ls.size()), turned(p_ls.size());
    const auto& corners = mesh.triangles();
    for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
        const double3& a = p_ls[corners[t]];
        const double3 n = cross(minus(p_ls[corners[t + 1]], a), minus(p_ls[corners[t + 2]], a));
        const double3 away = is_parallel ? double3{0.0, 0.0, 1.0}
                                         : space.faces[0].turned_back(space.faces[0].seen(a));
        const double sign = dot(n, away) < 0.0 ? -1.0 : 1.0;
        for (std::size_t corner = t; corner < t + 3; ++corner)
            for (int axis = 0; axis < 3; ++axis) {
                normals[corners[corner]][axis] += n[axis];
                turned[corners[corner]][axis] += sign * n[axis];
            }
    }
    for (std::size_t i = 0; i < normals.size(); ++i)
        if (length(turned[i]) > length(normals[i])) normals[i] = turned[i];
    return normals;
}

// The slope of the surface at each vertex; before faces, its normal. Without one it stays a bare
// point.
void tell_mesh(std::vector<Receiver>& list, const std::vector<double3>& p_ls, const Mesh& mesh,
               const LightSpace& space, bool corrects) {
    const std::vector<double3> normals = mean_normals(p_ls, mesh, space);
    for (std::size_t i = 0; i < list.size(); ++i) {
        double3 told = normals[i];
        if (space.is_parallel()) {
            if (told[2] == 0.0) continue;
            told = {-told[0] / told[2], -told[1] / told[2], 0.0};
            if (!(std::abs(told[0]) + std::abs(told[1]) < 1e18)) continue;
        } else {
            const double length = std::hypot(told[0], told[1], told[2]);
            if (!(length > 0.0)) continue;
            told = {told[0] / length, told[1] / length, told[2] / length};
        }
        list[i].lies_on = on_surface;
        list[i].direction = to_float(told);
        if (corrects) list[i].opacity = at_or_only(mesh.opacity(), i);
    }
}

void tell_particles(std::vector<Receiver>& list, const Particles& particles,
                    const LightSpace& space) {
    const double to_texels = 2.0 * particles.scale() * space.texels_per_unit;
    for (std::size_t i = 0; i < list.size(); ++i) {
        list[i].width_texels = float(at_or_only(particles.radius(), i) * to_texels);
        list[i].opacity = at_or_only(particles.opacity(), i);
        list[i].direction[0] = float(particles.profile());
    }
}

// The way of the light at a place in light coordinates, in the world.
double3 light_direction(const double3& p, const LightSpace& space) {
    double3 way{0.0, 0.0, 1.0}, world{};
    if (!space.is_parallel()) way = space.faces[0].turned_back(space.faces[0].seen(p));
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t i = 0; i < 3; ++i) world[i] += space.from_world[4 * row + i] * way[row];
    const double length = std::hypot(world[0], world[1], world[2]);
    if (!(length > 0.0)) return {0.0, 0.0, 1.0};  // the light's own place
    return {world[0] / length, world[1] / length, world[2] / length};
}

void tell_voxels(std::vector<Receiver>& list, const std::vector<double3>& p_ls, const Query& query,
                 const LightSpace& space) {
    for (std::size_t i = 0; i < list.size(); ++i)
        list[i].own_reach = float(query.own_half_chord(light_direction(p_ls[i], space)));
}

float3 unit(const float3& v) {
    return scaled(v, 1.f / length(v));
}

// What of the receiver's strand or surface the face sees.
void see_strand(SeenReceiver& seen, const MapFace& face, const Receiver& receiver,
                const LightSpace& space) {
    const float3 along = face.place_change(receiver.p_ls, receiver.direction);
    const float texels = std::max(std::abs(along[0]), std::abs(along[1]));
    seen.direction = texels > 0.f ? scaled(along, 1.f / texels) : float3{};
    for (std::size_t i = 0; i < 2; ++i)
        seen.ends[i] = std::clamp(receiver.ends[i] * texels, -endless_texels, endless_texels);
    const float width =
        receiver.width_texels / (float(space.texels_per_unit) * float(space.depth_range));
    seen.width_texels = face.ribbon_width(receiver.p_ls, receiver.direction, width);
}

void see_surface(SeenReceiver& seen, const MapFace& face, const Receiver& receiver) {
    const float3& normal = receiver.direction;
    const bool x_is_less = std::abs(normal[0]) < std::abs(normal[1]);
    const float3 a = cross(normal, x_is_less ? float3{1, 0, 0} : float3{0, 1, 0});
    const Slope slope = surface_slope(face.place_change(receiver.p_ls, unit(a)),
                                      face.place_change(receiver.p_ls, unit(cross(normal, a))));
    seen.direction = {slope[0], slope[1], 0.f};
}

}  // namespace

// What changes by texel changes less by one that is finer.
SeenReceiver seen(const Receiver& receiver, const LightSpace& space, int split) {
    const SplitPlace place = split_place(space, split);
    const float texels_per_unit = float(space.texels_per_unit) * place.scale;
    SeenReceiver seen{receiver, space.corner_px(split), texels_per_unit,
                      largest_surface_margin(texels_per_unit, space.depth_range)};
    seen.p_ls = place.place(receiver.p_ls);
    seen.width_texels *= place.scale;
    if (receiver.lies_on == on_surface)
        for (float& slope : seen.direction) slope /= place.scale;
    if (receiver.lies_on != on_strand) return seen;
    seen.direction[2] /= place.scale;
    for (float& end : seen.ends)
        end = std::clamp(end * place.scale, -endless_texels, endless_texels);
    return seen;
}

SeenReceiver seen_through(const MapFace& face, const Receiver& receiver, const LightSpace& space) {
    SeenReceiver seen{receiver, face.corner_px, face.texels_per_unit(face.seen(receiver.p_ls)[2]),
                      0.f};
    seen.largest_margin = largest_surface_margin(seen.texels_per_unit, space.depth_range);
    seen.p_ls = face.place(receiver.p_ls);
    if (receiver.lies_on == on_strand)
        see_strand(seen, face, receiver, space);
    else if (receiver.width_texels > 0.f)
        seen.width_texels *= seen.texels_per_unit / float(space.texels_per_unit);
    else if (receiver.lies_on == on_surface && receiver.direction != float3{})
        see_surface(seen, face, receiver);
    return seen;
}

Query Query::at(Positions world_points, const Scene& scene) {
    check_receivers(world_points);
    Query query;
    query.world_points = std::move(world_points);
    query.bounds = query.world_points.bounds();
    query.strand_width = mean_strand_width(scene.shapes());
    return query;
}

Query Query::at(const Shape& shape, const Scene& scene) {
    Query query{receivers_on(shape)};
    query.bounds = query.world_points.bounds();
    query.placed = next_revision();
    query.stand_on(shape, scene);
    return query;
}

const Query& ShapeQuery::at(const Shape& shape, const Scene& scene) {
    const Shape::Revisions now = [&] {
        const auto lock = shape.lock();
        return shape.revisions();
    }();
    if (now.geometry == geometry_ && now.transform == transform_) {
        query_.stand_on(shape, scene);
    } else {
        query_ = Query::at(shape, scene);
        geometry_ = now.geometry, transform_ = now.transform;
    }
    return query_;
}

void Query::stand_on(const Shape& shape, const Scene& scene) {
    own = &shape;
    const auto lock = shape.lock();
    const auto& shapes = scene.shapes();
    is_in_maps =
        shape.is_caster() && !shape.opaque() &&
        std::any_of(shapes.begin(), shapes.end(), [&](const auto& s) { return s.get() == &shape; });
}

bool replace_receivers(std::vector<Receiver>& list, const LightSpace& space,
                       const Positions& world_points) {
    std::atomic<bool> is_other = list.size() != world_points.size();
    list.resize(world_points.size());
    parallel_parts(list.size(), points_at_once, [&](std::size_t begin, std::size_t end) {
        bool differs = false;
        for (std::size_t i = begin; i < end; ++i) {
            const Receiver now{.p_ls =
                                   to_float(transform_point(space.from_world, world_points[i]))};
            differs |= now != list[i];
            list[i] = now;
        }
        if (differs) is_other = true;
    });
    return is_other;
}

std::vector<Receiver> receivers_in(const LightSpace& space, const Query& query,
                                   bool own_correction) {
    std::vector<Receiver> list;
    if (!query.own) {
        replace_receivers(list, space, query.world_points);
        return list;
    }
    list.resize(query.world_points.size());
    std::vector<double3> p_ls(list.size());
    parallel_parts(list.size(), points_at_once, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            p_ls[i] = transform_point(space.from_world, query.world_points[i]);
            list[i].p_ls = to_float(p_ls[i]);
        }
    });
    const auto lock = query.own->lock();
    const bool corrects = own_correction && query.is_in_maps;
    const auto* strands = dynamic_cast<const Strands*>(query.own);
    if (strands)
        for (Receiver& receiver : list) receiver.lies_on = on_strand;
    if (strands && corrects) tell_strands(list, p_ls, *strands, space);
    if (const auto* mesh = dynamic_cast<const Mesh*>(query.own))
        // What a surface with alpha leaves in a texel is not its opacity.
        tell_mesh(list, p_ls, *mesh, space, corrects && !mesh->has_alpha());
    if (dynamic_cast<const Volume*>(query.own)) tell_voxels(list, p_ls, query, space);
    if (const auto* particles = dynamic_cast<const Particles*>(query.own))
        if (query.is_in_maps) tell_particles(list, *particles, space);
    return list;
}

}  // namespace opacity
