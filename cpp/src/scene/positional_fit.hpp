// Fits the faces of a light at a place to what casts: one for each of its points where the casters
// lie within a cone before it, else the six of a cube around it.
#pragma once

#include <functional>
#include <vector>

#include "opacity/scene/light.hpp"
#include "opacity/scene/light_space.hpp"
#include "opacity/scene/scene.hpp"
#include "scene/light_extent.hpp"
#include "scene/steady_window.hpp"

namespace opacity {

class PositionalFit {
   public:
    using MapSizePx = std::function<int(double side)>;
    // As LightFit::fit.
    LightSpace fit(const Scene& scene, const PositionalLight& light, const MapSizePx& map_size_px,
                   const Box& query);

   private:
    // In world space.
    struct Extent {
        Box casters, receivers;
        bool surfaces = false;
    };
    // A face that is held on to while it still fits.
    struct Lens {
        double3 forward{0, 0, -1};
        double4x4 rotation = identity;
        std::optional<Window> window;  // of tangents
        CasterBoxes boxes;
    };
    static Extent measure(const Scene& scene);
    // What the casters span before a point, in tangents; nothing where they do not lie before it.
    std::optional<Box> tangents(const Scene& scene, Lens& lens, const double3& point) const;
    bool aim(const Scene& scene, const PositionalLight& light, const Extent& extent);

    std::vector<double3> points_;
    std::vector<Lens> lenses_;  // one a point; none: cubes
};

}  // namespace opacity
