#include "map/particle_fragments.hpp"

namespace opacity {
namespace {

MapSphere directional(const float4& p, const LightSpace& space) {
    const float radius = p[3];
    return {.center = {p[0], p[1], p[2]},
            .radius = radius,
            .low = {std::floor(p[0] - radius), std::floor(p[1] - radius)},
            .high = {std::ceil(p[0] + radius), std::ceil(p[1] + radius)},
            .depths_a_texel = 1.f / (float(space.texels_per_unit) * float(space.depth_range))};
}

}  // namespace

std::optional<MapSphere> sphere_in_map(const float4& p, const LightSpace& space,
                                       const MapFace* face) {
    if (!face) return directional(p, space);
    MapSphere sphere{.face = face, .center_q = {p[0], p[1], p[2]}, .radius_q = p[3]};
    const float3 r = face->seen(sphere.center_q);
    const float distance = length(r);
    if (!(p[3] < near_sphere * distance)) {  // it may be anywhere on the face
        sphere.radius = 1e9f;
        sphere.high = {float(space.map_size_px), float(space.map_size_px)};
        return sphere;
    }
    if (r[2] < 2.f * p[3] + least_forward) return {};
    // The picture of a sphere is an ellipse: the circle of its area, and the square around it.
    const float texels = face->focal_px() * p[3] / r[2], stretch = distance / r[2];
    const float reach = texels * stretch * 1.1f;
    sphere.center = face->place(sphere.center_q);
    sphere.radius = texels * std::sqrt(stretch);
    sphere.depths_a_texel = r[2] / face->focal_px();
    for (std::size_t i = 0; i < 2; ++i) {
        sphere.low[i] = std::floor(sphere.center[i] - reach);
        sphere.high[i] = std::ceil(sphere.center[i] + reach);
    }
    return sphere;
}

Rows particle_rows(const LightCaster& caster, std::size_t particle, const LightSpace& space,
                   const MapFace* face, const SplitPlace& split) {
    const auto sphere = sphere_in_map(split.place(caster.points[particle]), space, face);
    return sphere ? rows_between(sphere->low[1], sphere->high[1], space.map_size_px) : Rows{0, 0};
}

}  // namespace opacity
