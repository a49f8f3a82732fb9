#include "map/volume_fragments.hpp"

#include <algorithm>
#include <cmath>

namespace opacity {
namespace {

float3 transformed(const std::array<float4, 4>& m, const float3& v, float w) {
    float3 result;
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = m[0][i] * v[0] + m[1][i] * v[1] + m[2][i] * v[2] + m[3][i] * w;
    return result;
}

// As lib/light.glsl's light_ray, through the middle of a texel.
VoxelRay ray_through(const LightCaster& caster, const MapFace* face, const SplitPlace& split, int x,
                     int y) {
    const float2 middle = split.turned_back({float(x) + 0.5f, float(y) + 0.5f});
    const LightRay light =
        face ? face->ray(middle) : LightRay{{middle[0], middle[1], 0.f}, {0.f, 0.f, 1.f}, -1e30f};
    return {transformed(caster.voxels_from_light, light.origin, 1.f),
            transformed(caster.voxels_from_light, light.direction, 0.f), light.begin};
}

// Light's way among the voxels, to the middle of all.
float3 way_of_light(const LightCaster& caster, const MapFace* face, const Voxel& size) {
    if (!face) return transformed(caster.voxels_from_light, {0.f, 0.f, 1.f}, 0.f);
    const float3 source = transformed(caster.voxels_from_light, face->source(), 1.f);
    return minus(float3{0.5f * size[0], 0.5f * size[1], 0.5f * size[2]}, source);
}

int longest_axis(const float3& v) {
    const float x = std::abs(v[0]), y = std::abs(v[1]), z = std::abs(v[2]);
    if (x >= y && x >= z) return 0;
    return y >= z ? 1 : 2;
}

// The texels around the slab's corners, within the map and the rows; all of a face that a corner is
// not before.
struct TexelBox {
    int begin_x, end_x, begin_y, end_y;

    TexelBox(const LightCaster& caster, const FragmentSource& source, const MapFace* face,
             const Slab& slab, Rows rows) {
        const int size_px = source.space.map_size_px;
        float low[2] = {1e30f, 1e30f}, high[2] = {-1e30f, -1e30f};
        for (int corner = 0; corner < 8; ++corner) {
            float3 voxel;
            for (std::size_t i = 0; i < 3; ++i)
                voxel[i] = float((corner >> i & 1 ? slab.end : slab.begin)[i]);
            float3 place = source.split.place(transformed(caster.light_from_voxels, voxel, 1.f));
            const bool is_seen = !face || face->seen(place)[2] > least_forward;
            if (face && is_seen) place = face->place(place);
            for (std::size_t row = 0; row < 2; ++row) {
                low[row] = is_seen ? std::min(low[row], place[row]) : -1e9f;
                high[row] = is_seen ? std::max(high[row], place[row]) : 1e9f;
            }
            if (!is_seen) break;
        }
        const auto within = [](float v, int begin, int end) {
            return int(std::clamp(v, float(begin), float(end)));
        };
        begin_x = within(std::floor(low[0]), 0, size_px);
        end_x = within(std::ceil(high[0]) + 1.f, 0, size_px);
        begin_y = within(std::floor(low[1]), rows.begin, rows.end);
        end_y = within(std::ceil(high[1]) + 1.f, rows.begin, rows.end);
    }
};

}  // namespace

void volume_texels(const LightCaster& caster, const FragmentSource& source, const MapFace* face,
                   Rows rows, const std::function<void(const SlabTexel&)>& texel) {
    const Volume& volume = *caster.volume;
    const auto& [nz, ny, nx] = volume.size_zyx();
    const double3& spacing = volume.spacing();
    const VoxelGrid grid{{nx, ny, nz},
                         volume.extinction(),
                         {float(spacing[0]), float(spacing[1]), float(spacing[2])}};
    const int along_light = longest_axis(way_of_light(caster, face, {nx, ny, nz}));
    for (const Slab& slab : caster.slabs) {
        if (slab.axis != along_light) continue;
        const TexelBox box{caster, source, face, slab, rows};
        for (int y = box.begin_y; y < box.end_y; ++y)
            for (int x = box.begin_x; x < box.end_x; ++x)
                if (const auto chord = voxel_chord(ray_through(caster, face, source.split, x, y),
                                                   grid, slab.begin, slab.end))
                    texel({x, y, *chord});
    }
}

}  // namespace opacity
