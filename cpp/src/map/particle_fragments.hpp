// The fragments of particles: the texels that a disc touches. GLSL: casters/particles.vert.glsl and
// casters/particles.frag.glsl.
#pragma once

#include <cmath>

#include "core/opacity.hpp"
#include "map/fragment_source.hpp"
#include "map/sphere.hpp"

namespace opacity {

// A particle as the map sees it.
struct MapSphere {
    float3 center{};       // place in the map
    float radius = 0.f;    // texels
    float2 low{}, high{};  // the texels that it may touch lie between these
    float depths_a_texel = 0.f;
    const MapFace* face = nullptr;  // else directional: the rest is of a face
    float3 center_q{};              // light coordinates
    float radius_q = 0.f;

    // Large on a face: met, or not, by the ray through a texel's middle.
    bool is_met_by_rays() const { return face && !(radius < most_ring_texels); }
};
// Nothing where it is not before the face.
std::optional<MapSphere> sphere_in_map(const float4& particle, const LightSpace& space,
                                       const MapFace* face);

// Those that it may leave fragments in.
Rows particle_rows(const LightCaster& caster, std::size_t particle, const LightSpace& space,
                   const MapFace* face, const SplitPlace& split);

template <class Sink>
void particle_fragments(const LightCaster& caster, std::size_t particle,
                        const FragmentSource& source, const MapFace* face, Rows rows, Sink&& sink) {
    const auto sphere =
        sphere_in_map(source.split.place(caster.points[particle]), source.space, face);
    if (!sphere) return;
    const auto within = [](float v, int begin, int end) {
        return int(std::clamp(v, float(begin), float(end)));
    };
    const float2 center{sphere->center[0], sphere->center[1]};
    const float optical_depth = optical_depth_of(caster.opacity_at(particle));
    const int size_px = source.space.map_size_px;
    const int last_row = within(sphere->high[1], rows.begin, rows.end);
    const int last_column = within(sphere->high[0], 0, size_px);
    for (int y = within(sphere->low[1], rows.begin, rows.end); y < last_row; ++y)
        for (int x = within(sphere->low[0], 0, size_px); x < last_column; ++x) {
            const float2 middle{float(x) + 0.5f, float(y) + 0.5f};
            if (sphere->is_met_by_rays()) {
                const auto chord = sphere_chord(sphere->face->ray(middle), sphere->center_q,
                                                sphere->radius_q, caster.profile);
                if (chord)
                    sink(x, y, chord->begin, chord->end,
                         [&] { return chord->part * optical_depth; });
                continue;
            }
            const auto coverage =
                sphere_coverage(center, sphere->radius, optical_depth, caster.profile, middle);
            if (!coverage) continue;
            const float half_length = coverage->half_length * sphere->depths_a_texel;
            sink(x, y, sphere->center[2] - half_length, sphere->center[2] + half_length,
                 [&] { return optical_depth_of(coverage->opacity); });
        }
}

}  // namespace opacity
