// Fits a light's map to what casts and what receives: square texels, one texel of border, and a
// depth range from the first caster to the last one that matters. All in float64.
#pragma once

#include <functional>
#include <optional>

#include "opacity/scene/light.hpp"
#include "opacity/scene/light_space.hpp"
#include "opacity/scene/scene.hpp"
#include "scene/light_extent.hpp"
#include "scene/positional_fit.hpp"
#include "scene/steady_window.hpp"

namespace opacity {

// World to a frame whose z axis is the light's direction, of length 1; x and y are the map's axes.
double4x4 light_rotation(const double3& direction);
// The same, with an x axis as near to another one as can be, so that a light which turns a little
// does not roll.
double4x4 light_rotation(const double3& direction, const double3& x_near);

// ParameterError for another kind of light.
const DirectionalLight& require_directional(const Light& light);

class LightFit {
   public:
    // Texels along a side of the map, for a map that spans so many world units.
    using MapSizePx = std::function<int(double side)>;
    // `query` are world points beyond the scene's receivers that will be asked about. What is
    // fitted depends on the fits before: it holds on to a window and a roll that still do.
    LightSpace fit(const Scene& scene, const Light& light, const MapSizePx& map_size_px,
                   const Box& query);

   private:
    // What casts and what receives, in the light's frame.
    struct Extent {
        Box casters, receivers;
        bool surfaces = false;
    };
    LightSpace fit_directional(const Scene& scene, const DirectionalLight& light,
                               const MapSizePx& map_size_px, const Box& query);
    double4x4 steady_rotation(const double3& direction);
    Window steady_window(const double4x4& rotation, const Window& needed, double depth);
    Extent measure(const Scene& scene, const double4x4& rotation);

    PositionalFit positional_;
    CasterBoxes boxes_;
    // What is held: the axes, a world point in the middle of the window, and its side.
    std::optional<double4x4> rotation_;
    double3 anchor_{};
    std::optional<Window> window_;
};

}  // namespace opacity
