// What a camera sees between two distances, and what of a box that is.
#pragma once

#include <array>
#include <vector>

#include "opacity/scene/camera.hpp"

namespace opacity {

struct CameraView {
    const Camera& camera;
    double aspect;  // width / height of the picture
};

// Eight corners, by the bits of their index; six flat sides.
using Hexahedron = std::array<double3, 8>;

Hexahedron corners_of(const Box& box);
// Distances are along the view. 0 < near < far.
Hexahedron frustum_of(const CameraView& view, double near, double far);
// Whether nothing in a box can be in the picture: all of it lies behind the eye, or beyond one
// side.
bool is_out_of_view(const CameraView& view, const Box& box);
// The corners of what two have in common, some of them more than once; none where that is nothing.
std::vector<double3> common_corners(const Hexahedron& a, const Hexahedron& b);

}  // namespace opacity
