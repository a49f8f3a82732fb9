// What a light's map cannot hold anything of.
#pragma once

#include "opacity/scene/light_space.hpp"

namespace opacity {

// Whether nothing in a box of the world that casts can leave anything in any of the map's faces or
// splits: all of it lies beyond one of their sides, or farther from the light than every receiver.
// `reach` is how far casters there go beyond the box: half a width, or a radius.
bool is_out_of_map(const LightSpace& space, const Box& points, double reach);

}  // namespace opacity
