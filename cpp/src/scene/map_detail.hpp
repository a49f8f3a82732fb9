// How many strands a light's map needs: docs/accuracy.md, "Fewer strands in maps".
#pragma once

#include <map>
#include <string>

#include "opacity/core/param.hpp"
#include "opacity/scene/light_space.hpp"
#include "opacity/scene/scene.hpp"
#include "opacity/scene/strands.hpp"

namespace opacity {

struct MapDetail {
    double strand_detail = 1.0;  // LightSpace's
    std::string why;             // empty where it holds all of them because that was asked for
};

// What sampling adds to T, root mean square over receivers that are spread evenly through strands
// of this optical depth, where each of those kept stands for `widening`, and one of these in a
// texel has opacity `opacity`.
double sampling_error(double widening, double opacity, double optical_depth);

class MapDetailRule {
   public:
    static constexpr double most_error = 0.02;  // of "auto"

    // For maps of `space`, which is fitted.
    MapDetail choose(const Scene& scene, const LightSpace& space,
                     const AutoParam<double>& map_detail);

   private:
    // Sums over a shape's segments in the world: length times width times optical depth; times
    // opacity; times the squares of width and opacity.
    struct Sums {
        double optical_area = 0.0, opaque_area = 0.0, squared = 0.0;
    };
    struct Measured {
        Revision geometry = 0, transform = 0, opacity = 0;
        Sums sums;
    };
    static Sums sums_of(const Strands& strands);
    const Sums& measured(const Strands& strands);
    double find(const Scene& scene, const LightSpace& space);

    std::map<const Shape*, Measured> measured_;
};

}  // namespace opacity
