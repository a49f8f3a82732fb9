// Fits a directional light's map to what casts and what receives: square texels, one texel of
// border, and a depth range from the first caster to the last one that matters. All in float64.
#pragma once

#include <map>

#include "opacity/graph/view.hpp"
#include "opacity/scene/light.hpp"
#include "opacity/scene/scene.hpp"

namespace opacity::render {

class LightFit {
   public:
    // `query` are world points beyond the scene's receivers that will be asked about.
    void update(View& view, const Scene& scene, const DirectionalLight& light, int map_size_px,
                const Box& query);

   private:
    // The exact box of a caster in light space, found again only when shape or light moved.
    struct Cached {
        Revision geometry = 0, transform = 0;
        double3 direction{};
        Box box;
    };
    // What casts and what receives, in light space; the radius of the casters in world space.
    struct Extent {
        Box casters, receivers;
        double radius = 0.0;
        bool surfaces = false;
    };
    Extent measure(const Scene& scene, const double4x4& rotation, const double3& direction);
    void forget_absent(const Scene& scene);
    Box caster_box(const Shape& shape, const double4x4& rotation, const double3& direction);
    std::map<const Shape*, Cached> cache_;
};

}  // namespace opacity::render
