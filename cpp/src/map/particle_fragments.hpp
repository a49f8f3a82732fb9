// The fragments of particles: the texels that a disc touches. GLSL: casters/particles.vert.glsl and
// casters/particles.frag.glsl.
#pragma once

#include <cmath>

#include "core/opacity.hpp"
#include "map/fragment_source.hpp"
#include "map/sphere.hpp"

namespace opacity {

template <class Sink>
void particle_fragments(const LightCaster& caster, std::size_t particle,
                        const FragmentSource& source, Rows rows, Sink&& sink) {
    const float4& p = caster.points[particle];
    const auto within = [](float v, int begin, int end) {
        return int(std::clamp(v, float(begin), float(end)));
    };
    const int size_px = source.space.map_size_px;
    const float2 center{p[0], p[1]};
    const float radius = p[3], optical_depth = optical_depth_of(caster.opacity_at(particle));
    const float depths_a_texel =
        1.f / (float(source.space.texels_per_unit) * float(source.space.depth_range));
    const int last_row = within(std::ceil(p[1] + radius), rows.begin, rows.end);
    const int last_column = within(std::ceil(p[0] + radius), 0, size_px);
    for (int y = within(std::floor(p[1] - radius), rows.begin, rows.end); y < last_row; ++y)
        for (int x = within(std::floor(p[0] - radius), 0, size_px); x < last_column; ++x) {
            const float2 middle{float(x) + 0.5f, float(y) + 0.5f};
            const auto coverage = sphere_coverage(center, radius, optical_depth, middle);
            if (!coverage) continue;
            const float half_length = coverage->half_length * depths_a_texel;
            sink(x, y, p[2] - half_length, p[2] + half_length,
                 [&] { return optical_depth_of(coverage->opacity); });
        }
}

}  // namespace opacity
