#include "map/volume_fragments.hpp"

#include <algorithm>
#include <cmath>

namespace opacity {
namespace {

// Light comes along z of light space: its way among the voxels.
float3 direction_in(const LightCaster& caster) {
    const float4& column = caster.voxels_from_light[2];
    return {column[0], column[1], column[2]};
}

// As lib/light.glsl's light_ray, through the middle of a texel.
VoxelRay ray_through(const LightCaster& caster, int x, int y) {
    const float middle_x = float(x) + 0.5f, middle_y = float(y) + 0.5f;
    const auto& m = caster.voxels_from_light;
    VoxelRay ray{{}, direction_in(caster), -1e30f};
    for (std::size_t i = 0; i < 3; ++i)
        ray.origin[i] = m[0][i] * middle_x + m[1][i] * middle_y + m[3][i];
    return ray;
}

int longest_axis(const float3& v) {
    const float x = std::abs(v[0]), y = std::abs(v[1]), z = std::abs(v[2]);
    if (x >= y && x >= z) return 0;
    return y >= z ? 1 : 2;
}

// The texels around the slab's corners, within the map and the rows.
struct TexelBox {
    int begin_x, end_x, begin_y, end_y;

    TexelBox(const LightCaster& caster, const Slab& slab, int size_px, Rows rows) {
        float low[2] = {1e30f, 1e30f}, high[2] = {-1e30f, -1e30f};
        const auto& m = caster.light_from_voxels;
        for (int corner = 0; corner < 8; ++corner)
            for (std::size_t row = 0; row < 2; ++row) {
                float place = m[3][row];
                for (std::size_t i = 0; i < 3; ++i)
                    place += m[i][row] * float((corner >> i & 1 ? slab.end : slab.begin)[i]);
                low[row] = std::min(low[row], place), high[row] = std::max(high[row], place);
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

void volume_texels(const LightCaster& caster, const LightSpace& space, Rows rows,
                   const std::function<void(const SlabTexel&)>& texel) {
    const Volume& volume = *caster.volume;
    const auto& [nz, ny, nx] = volume.size_zyx();
    const double3& spacing = volume.spacing();
    const VoxelGrid grid{
        {nx, ny, nz}, volume.extinction(), {float(spacing[0]), float(spacing[1]), float(spacing[2])}};
    const int along_light = longest_axis(direction_in(caster));
    for (const Slab& slab : caster.slabs) {
        if (slab.axis != along_light) continue;
        const TexelBox box{caster, slab, space.map_size_px, rows};
        for (int y = box.begin_y; y < box.end_y; ++y)
            for (int x = box.begin_x; x < box.end_x; ++x)
                if (const auto chord =
                        voxel_chord(ray_through(caster, x, y), grid, slab.begin, slab.end))
                    texel({x, y, *chord});
    }
}

}  // namespace opacity
