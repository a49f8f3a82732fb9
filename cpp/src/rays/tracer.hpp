// T at receivers, each the mean over its footprint and over the points of a light.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "opacity/scene/light.hpp"
#include "rays/backend.hpp"
#include "rays/casters.hpp"
#include "scene/receivers.hpp"

namespace opacity::rays {

// Where T is asked for. Lists hold one value for all points, or one a point.
struct Asked {
    Receivers receivers;
    std::vector<std::size_t> own;         // which particle of its shape a point is the centre of
    std::vector<double> bias, footprint;  // world units
    int samples = 1;
};

// Everything that threads share.
class Tracer {
   public:
    Tracer(const Casters& casters, const Backend& backend, const Light& light, const Asked& asked);

    double transmittance(std::size_t point, Hits& hits) const;
    // An upper bound.
    std::size_t rays_a_point() const;

   private:
    // A receiver in the frame.
    struct Place {
        double3 center;
        double bias, side;
        std::uint32_t own;  // primitive
    };
    Ray ray_from(const double3& origin, std::size_t source) const;
    double mean_over_footprint(std::size_t point, const Place& place, std::size_t source,
                               Hits& hits) const;
    double transmittance(const Ray& ray, const Span& span, std::uint32_t own, Hits& hits) const;

    const Casters& casters_;
    const Backend& backend_;
    const Asked& asked_;
    const Box box_;
    std::vector<double3> sources_;  // in the frame; none: parallel rays
};

}  // namespace opacity::rays
