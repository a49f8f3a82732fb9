// How many entries the lists of a light's map get from translucent casters, before one is drawn:
// from sums over the scene, as if what casts lay in all directions alike, and nothing opaque before
// it.
#pragma once

#include <vector>

#include "opacity/scene/scene.hpp"

namespace opacity {

class CasterLoad {
   public:
    // As the scene is now; found again only when a shape moved.
    void update(const Scene& scene);

    // In a map of so many texels in a world unit.
    double entries(double texels_per_unit) const;
    // Of the kinds that cast the one that layers hold worst: intervals of depth, single threads, or
    // surfaces that fill a texel at once.
    enum class Kind { media, strands, surfaces };
    Kind worst_kind() const { return worst_kind_; }

   private:
    // A part of the shapes: coefficients of powers of the texels in a world unit.
    struct Sums {
        double count = 0.0, length = 0.0, area = 0.0;
    };
    static Sums sums_of(const Shape& shape);
    static Kind kind_of(const Shape& shape);

    std::vector<Revision> measured_;
    Sums sums_;
    Kind worst_kind_ = Kind::media;
};

}  // namespace opacity
