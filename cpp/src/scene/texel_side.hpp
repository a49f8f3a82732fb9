// How large a texel of a light's map is where something lies.
#pragma once

#include "opacity/scene/light_space.hpp"

namespace opacity {

// World units, across the axis of the face that sees the point; of several points of a light the
// mean.
double texel_side(const LightSpace& space, const double3& world_point);

}  // namespace opacity
