// How far points lie apart.
#pragma once

#include "opacity/scene/positions.hpp"

namespace opacity {

// Half the mean distance from a point to its nearest neighbour, so that spheres of this radius just
// touch: of 256 points spread evenly through the list. Points in one place count once; .5 where
// there are no two places.
float half_mean_spacing(const Positions& points);

}  // namespace opacity
