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

// What all faces of a light share.
struct FaceScale {
    double3 center;      // of the casters, world: the origin of light coordinates
    double near;         // world units from the light to depth 0
    double depth_range;  // world units
    double free_px;      // a face without its border
    int map_size_px;
};

class PositionalFit {
   public:
    using MapSizePx = std::function<int(double side)>;
    // As LightFit::fit. It holds on to each point's window and aim while they fit.
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
        double3 forward{};  // 0: not aimed yet, nothing lies before it
        double4x4 rotation = identity;
        std::optional<Window> window;  // of tangents
        CasterBoxes boxes;
    };
    static Extent measure(const Scene& scene);
    // What the casters span before a point, in tangents; nothing where they do not lie before it.
    std::optional<Box> tangents(const Scene& scene, Lens& lens, const double3& point) const;
    bool aim(const Scene& scene, const PositionalLight& light, const Extent& extent);

    double widest_window() const;
    std::vector<LightFace> faces(const FaceScale& scale) const;

    std::vector<double3> points_;
    std::vector<Lens> lenses_;  // one a point; none: cubes
};

}  // namespace opacity
