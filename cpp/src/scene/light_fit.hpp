// Fits a directional light's map to what casts and what receives: square texels, one texel of
// border, and a depth range from the first caster to the last one that matters. All in float64.
#pragma once

#include <map>

#include "opacity/scene/light.hpp"
#include "opacity/scene/scene.hpp"

namespace opacity {

// World to a frame whose z axis is the light's direction, of length 1; x and y are the map's axes.
double4x4 light_rotation(const double3& direction);

// Light space, as lib/light.glsl tells: x and y in texels of the map, z in 0 .. 1 along the light.
struct LightSpace {
    double4x4 from_world = identity;
    int map_size_px = 1;
    double depth_range = 1.0;      // world units from z = 0 to z = 1
    double texels_per_unit = 1.0;  // 1 / the side of a texel in world units
    double least_bias = 0.0;       // world units
    bool operator==(const LightSpace&) const = default;
};

class LightFit {
   public:
    // `query` are world points beyond the scene's receivers that will be asked about.
    LightSpace fit(const Scene& scene, const DirectionalLight& light, int map_size_px,
                   const Box& query);

   private:
    // The exact box of a caster in light space, found again only when shape or light moved.
    struct Cached {
        Revision geometry = 0, transform = 0;
        double3 direction{};
        Box box;
    };
    // What casts and what receives, in light space.
    struct Extent {
        Box casters, receivers;
        bool surfaces = false;
    };
    Extent measure(const Scene& scene, const double4x4& rotation, const double3& direction);
    void forget_absent(const Scene& scene);
    Box caster_box(const Shape& shape, const double4x4& rotation, const double3& direction);
    std::map<const Shape*, Cached> cache_;
};

}  // namespace opacity
