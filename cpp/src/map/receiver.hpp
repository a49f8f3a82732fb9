// Who asks for T, as lib/receiver.glsl takes it: a point in light space, and what it lies on if
// that casts too. Of a positional light it comes in light coordinates, its strand's direction as
// the whole segment there, or its surface's normal, and its width as a directional light would have
// it.
#pragma once

#include <array>
#include <vector>

#include "map/face.hpp"
#include "map/split_place.hpp"
#include "opacity/scene/particles.hpp"
#include "opacity/scene/scene.hpp"
#include "scene/light_fit.hpp"
#include "scene/receivers.hpp"

namespace opacity {

// Receiver::lies_on, as the shader takes it.
inline constexpr float on_nothing = 0.f, on_strand = 1.f, on_surface = 2.f;

struct Receiver {
    float3 p_ls{};
    float width_texels = 0.f;  // of its strand or particle; 0 elsewhere
    // Of its strand, one texel long on the major axis; of a surface xy = slope; of a particle x =
    // DensityProfile.
    float3 direction{};
    float opacity = 0.f;         // of its own caster; 0 where it lies on none
    float ends[2] = {0.f, 0.f};  // how far its strand reaches both ways, in directions
    float lies_on = on_nothing;  // above: what of its own shape can shadow it
    float own_reach = 0.f;       // world units toward the light: half of its own voxel

    bool operator==(const Receiver&) const = default;
};
static_assert(sizeof(Receiver) == 12 * sizeof(float));  // a multiple of four, as std430 has it

inline bool is_at_particle(const Receiver& receiver) {
    return receiver.width_texels > 0.f && receiver.lies_on != on_strand;
}
inline DensityProfile profile_of(const Receiver& receiver) {
    return DensityProfile(int(receiver.direction[0]));
}
// Of none it is known what it lies on.
inline bool is_bare(const Receiver& receiver) {
    return receiver.lies_on == on_nothing && receiver.width_texels == 0.f &&
           receiver.own_reach == 0.f;
}

// What one face of the map sees of it.
struct SeenReceiver : Receiver {
    std::array<int, 2> corner_px{};  // the first texel of the face
    float texels_per_unit = 1.f;     // there
    float largest_margin = 0.f;      // of a surface there (map/surface.hpp)
};

// By a directional light; through one of its splits, if it has any.
SeenReceiver seen(const Receiver& receiver, const LightSpace& space, int split = 0);
SeenReceiver seen_through(const MapFace& face, const Receiver& receiver, const LightSpace& space);

// Where T is asked for; the width of strands there is for the automatic bias.
struct Query : Receivers {
    Box bounds;                  // of the points
    Revision placed = 0;         // moves when these do; 0: only they themselves tell
    const Shape* own = nullptr;  // the points are this shape's
    bool is_in_maps = false;     // which lies in the opacity maps

    static Query at(Positions world_points, const Scene& scene);
    static Query at(const Shape& shape, const Scene& scene);
    // The points lie on this shape, which has as many; of the scene, or of none.
    void stand_on(const Shape& shape, const Scene& scene);
};

// Where a strand goes on, it does so for as far as any filter reaches; lib/ribbon.glsl.
inline constexpr float endless_texels = 64.f;
// The same before faces, where ends are told in segments; lighting.vert.glsl.
inline constexpr float endless_segments = 1e6f;

// `own_correction`: with what strands and surfaces leave in the map themselves. A particle never
// counts at its own centre.
std::vector<Receiver> receivers_in(const LightSpace& space, const Query& query,
                                   bool own_correction);
// Of points that lie on nothing, in the place of what was asked last. Whether any of it is another.
bool replace_receivers(std::vector<Receiver>& list, const LightSpace& space,
                       const Positions& world_points);

// Finds the world points of a shape, and keeps those of the last one while it does not move.
class ShapeQuery {
   public:
    const Query& at(const Shape& shape, const Scene& scene);

   private:
    Revision geometry_ = 0, transform_ = 0;
    Query query_;
};

}  // namespace opacity
