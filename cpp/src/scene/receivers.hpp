// Where light is asked about: world points, and how wide the strand is that they lie on.
#pragma once

#include "opacity/scene/shape.hpp"

namespace opacity {

struct Receivers {
    Positions world_points;
    double strand_width = 0.0;  // world units
};

// A shape's own points, moved by its transform in float64. Takes the shape's lock.
Receivers receivers_on(const Shape& shape);
// ParameterError naming the first point that is not finite, or larger than max_coordinate.
void check_receivers(const Positions& world_points);

}  // namespace opacity
