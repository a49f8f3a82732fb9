#include "map/light_casters.hpp"

#include <utility>

#include "core/parallel.hpp"
#include "map/voxels.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/strands.hpp"
#include "scene/map_window.hpp"
#include "scene/primitive_chunks.hpp"
#include "scene/strand_ranks.hpp"

namespace opacity {
namespace {

constexpr std::size_t points_at_once = 1 << 14;

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

// What a strand is wide, or half of what a particle is.
const std::vector<float>& widths_of(const Shape& shape) {
    static const std::vector<float> none{0.f};
    if (const auto* strands = dynamic_cast<const Strands*>(&shape)) return strands->width();
    if (const auto* particles = dynamic_cast<const Particles*>(&shape)) return particles->radius();
    return none;
}

std::vector<float4> light_points(const Shape& shape, const LightSpace& space) {
    const Box bounds = shape.points().bounds();
    const double3 origin = bounds.empty() ? double3{} : bounds.center();
    const std::vector<float>& widths = widths_of(shape);
    const std::array<float, 12> m = light_from_local(shape, space, origin);
    const float size =
        float(shape.scale() * widening_of(shape, space.strand_detail)) *
        (space.is_parallel() ? float(space.texels_per_unit) : 1.f / float(space.depth_range));
    std::vector<float4> points(shape.points().size());
    shape.points().visit([&](const auto& xyz) {
        parallel_parts(points.size(), points_at_once, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                float3 p;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    p[axis] = float(double(xyz[3 * i + axis]) - origin[axis]);
                for (std::size_t row = 0; row < 3; ++row) {
                    const float* r = &m[4 * row];
                    points[i][row] = r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + r[3];
                }
                points[i][3] = widths[widths.size() > 1 ? i : 0] * size;
            }
        });
    });
    return points;
}

void copy_geometry(LightCaster& caster, const Shape& shape) {
    if (const auto* strands = dynamic_cast<const Strands*>(&shape)) {
        caster.kind = CasterKind::strands;
        caster.indices = strands->segments();
    } else if (const auto* mesh = dynamic_cast<const Mesh*>(&shape)) {
        caster.kind = CasterKind::mesh;
        caster.indices = mesh->triangles();
        const bool has_alpha = mesh->has_alpha();
        caster.uvs = has_alpha ? mesh->uvs() : std::vector<float2>{};
        caster.coverage = has_alpha ? coverage_levels(*mesh) : std::vector<TextureMap>{};
    } else if (const auto* particles = dynamic_cast<const Particles*>(&shape)) {
        caster.kind = CasterKind::particles;
        caster.profile = particles->profile();
    } else if (const auto* volume = dynamic_cast<const Volume*>(&shape)) {
        caster.kind = CasterKind::volume;
        caster.slabs = slabs_of(*volume);
    }
}

std::array<float4, 4> columns_of(const double4x4& m) {
    std::array<float4, 4> columns;
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t row = 0; row < 4; ++row) columns[column][row] = float(m[4 * row + column]);
    return columns;
}

// By number: whether the map holds the primitive; empty: it holds all of them.
using Held = std::vector<char>;

void leave_out_chunks(Held& held, const Shape& shape, const LightSpace& space) {
    const auto chunks = shape.chunks();
    const double reach = caster_reach(shape, space.strand_detail);
    for (std::size_t chunk = 0; chunk < chunks->count(); ++chunk) {
        const Box box = chunks->boxes[chunk].transformed(shape.transform());
        if (!is_out_of_map(space, box, reach)) continue;
        held.resize(chunks->order->size(), 1);
        for (std::size_t i = chunks->first(chunk); i < chunks->first(chunk + 1); ++i)
            held[(*chunks->order)[i]] = 0;
    }
}

void leave_out_strands(Held& held, const Shape& shape, double detail) {
    const auto* strands = dynamic_cast<const Strands*>(&shape);
    if (!strands || detail >= 1.0) return;
    const auto ranks = strands->ranks();
    const std::vector<std::size_t> numbers = strand_numbers(*strands);
    held.resize(numbers.size(), 1);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (!ranks->is_kept(numbers[i], detail)) held[i] = 0;
}

void place_in_light(LightCaster& caster, const Shape& shape, const LightSpace& space, bool culls) {
    const auto* volume = dynamic_cast<const Volume*>(&shape);
    if (!volume) {
        caster.points = light_points(shape, space);
        Held held;
        if (culls) leave_out_chunks(held, shape, space);
        leave_out_strands(held, shape, space.strand_detail);
        caster.bands = CasterBands{caster, space, held};
        return;
    }
    const VoxelSpace voxels =
        voxel_space(space.from_world, shape.transform(), local_from_voxels(*volume));
    caster.light_from_voxels = columns_of(voxels.from_voxels);
    caster.voxels_from_light = columns_of(voxels.to_voxels);
    caster.bands = CasterBands{caster, space, {}};
}

}  // namespace

const LightCaster& LightCasters::caster(const ShapePtr& shape_ptr, const LightSpace& space) {
    const Shape& shape = *shape_ptr;
    // An instance shares the voxels, which are not copied, whatever the shape gets meanwhile.
    std::shared_ptr<const Volume> shared;
    if (dynamic_cast<const Volume*>(&shape))
        shared = std::dynamic_pointer_cast<const Volume>(shape.instance());
    const auto lock = shape.lock();
    Cached& cached = cache_[&shape];
    const Shape::Revisions& now = shape.revisions();
    cached.shape = shape_ptr;
    LightCaster& caster = cached.caster;
    caster.volume = std::move(shared);
    if (cached.opacity != now.opacity) caster.opacity = shape.opacity();
    if (cached.geometry != now.geometry) copy_geometry(caster, shape);
    if (cached.geometry != now.geometry || cached.transform != now.transform ||
        cached.space != space || cached.culled != culls_)
        place_in_light(caster, shape, space, culls_);
    cached.geometry = now.geometry;
    cached.transform = now.transform;
    cached.opacity = now.opacity;
    cached.space = space;
    cached.culled = culls_;
    return caster;
}

void LightCasters::collect() {
    std::erase_if(cache_, [](const auto& entry) { return entry.second.shape.expired(); });
}

}  // namespace opacity
