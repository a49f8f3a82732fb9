// What one ray crosses, gathered from a backend in any order and summed in one.
#pragma once

#include <cstdint>
#include <vector>

#include "rays/casters.hpp"
#include "rays/ray.hpp"

namespace opacity::rays {

// Used again for ray after ray, so that it allocates once.
class Hits {
   public:
    explicit Hits(const Casters& casters) : casters_{casters} {}

    // Casters count within the span, and all but `own`, a primitive, or Casters::none.
    void start(const Ray& ray, const Span& span, std::uint32_t own);
    // For each primitive whose box the ray meets, at least once. False: nothing more can change T.
    bool visit(std::uint32_t primitive);
    // T: exp(-sum of optical depth), in the order of the primitives.
    double transmittance();

    const Ray& ray() const { return ray_; }

   private:
    struct Hit {
        std::uint32_t primitive;
        double optical_depth;  // not of a segment
    };
    double optical_depth_of_strands(std::size_t& next) const;
    bool visit_triangle(std::uint32_t primitive, std::uint32_t triangle);

    const Casters& casters_;
    Ray ray_{};
    Span span_{};
    std::uint32_t own_ = Casters::none;
    bool blocked_ = false;
    std::vector<Hit> hits_;
};

}  // namespace opacity::rays
