// Where light is asked about: world points, what they lie on, and what of that does not count there
// (docs/accuracy.md): of a strand what is nearer than its width, a particle around its own centre,
// half a voxel around its own. A surface has nothing of that kind.
#pragma once

#include "core/matrix3.hpp"
#include "opacity/scene/shape.hpp"

namespace opacity {

struct Receivers {
    Positions world_points;
    double strand_width = 0.0;  // world units
    // Point i is the centre of particle i of the shape: there that particle does not count.
    bool at_particles = false;
    // World to voxels, of the centres of voxels; else all 0.
    double3x3 voxels_from_world{};

    // World units: what a ray from the centre of a voxel passes of that voxel; 0 elsewhere. The
    // direction has length 1.
    double own_half_chord(const double3& direction) const;
};

// A shape's own points, moved by its transform in float64; of a volume the centres of its voxels,
// x fastest. Takes the shape's lock.
Receivers receivers_on(const Shape& shape);
// ParameterError naming the first point that is not finite, or larger than max_coordinate.
void check_receivers(const Positions& world_points);

}  // namespace opacity
