// The automatic bias (docs/accuracy.md): how far in front of a receiver casters begin to count, so
// that a strand's own neighbourhood and the joint of its segments do not darken it.
#pragma once

#include <vector>

#include "opacity/scene/scene.hpp"

namespace opacity {

// World units. No receiver's automatic bias is less: 1e-4 of the radius of what lets light through.
double least_bias(const Scene& scene);
// Of the strands that cast, each point counted once, in world units: what a point of unknown kind
// is taken to lie on.
double mean_strand_width(const std::vector<ShapePtr>& shapes);

}  // namespace opacity
