// Fits a directional light's map to what casts and what receives: square texels, one texel of
// border, and a depth range from the first caster to the last one that matters. All in float64.
#pragma once

#include <functional>
#include <map>

#include "opacity/scene/light.hpp"
#include "opacity/scene/light_space.hpp"
#include "opacity/scene/scene.hpp"

namespace opacity {

// World to a frame whose z axis is the light's direction, of length 1; x and y are the map's axes.
double4x4 light_rotation(const double3& direction);

// ParameterError for another kind of light.
const DirectionalLight& require_directional(const Light& light);

class LightFit {
   public:
    // Texels along a side of the map, for a map that spans so many world units.
    using MapSizePx = std::function<int(double side)>;
    // `query` are world points beyond the scene's receivers that will be asked about.
    LightSpace fit(const Scene& scene, const DirectionalLight& light, const MapSizePx& map_size_px,
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
