// Who asks for T, as lib/receiver.glsl takes it: a point in light space, and what it lies on if
// that casts too.
#pragma once

#include <vector>

#include "opacity/scene/scene.hpp"
#include "scene/light_fit.hpp"

namespace opacity {

struct Receiver {
    float3 p_ls{};
    float width_texels = 0.f;  // of its strand; 0 on a surface
    float3 direction{};   // of its strand, one texel long on the major axis; surface: xy = slope
    float opacity = 0.f;  // of its own caster; 0 where it lies on none
    float ends[2] = {0.f, 0.f};  // how far its strand reaches both ways, in directions
    float on_strand = 0.f;       // or 1: no opaque surface that it lies on can shadow itself
    float unused = 0.f;          // a multiple of four floats, as std430 has it
};
static_assert(sizeof(Receiver) == 12 * sizeof(float));

// Where T is asked for.
struct Query {
    Positions world_points;
    double width = 0.0;          // of the strands there, in world units, for the automatic bias
    const Shape* own = nullptr;  // the points are this shape's
    bool is_in_maps = false;     // which lies in the opacity maps

    static Query at(Positions world_points, const Scene& scene);
    static Query at(const Shape& shape, const Scene& scene);
};

// Where a strand goes on, it does so for as far as any filter reaches; lighting.vert.glsl.
inline constexpr float endless_texels = 64.f;

// `own_correction`: with what the receivers themselves leave in the map.
std::vector<Receiver> receivers_in(const LightSpace& space, const Query& query,
                                   bool own_correction);

}  // namespace opacity
