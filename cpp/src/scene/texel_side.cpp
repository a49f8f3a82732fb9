#include "scene/texel_side.hpp"

#include <algorithm>

namespace opacity {
namespace {

// Of the faces of one point of the light, that before which the point lies farthest.
double side_seen_by(const LightSpace& space, int eye, const double3& q) {
    double side = 0.0;
    for (int i = 0; i < space.faces_an_eye; ++i) {
        const LightFace& face = space.faces[std::size_t(eye * space.faces_an_eye + i)];
        const double forward = std::max(face.seen(q)[2], double(least_forward));
        side = std::max(side, forward / face.focal_px);
    }
    return side * space.depth_range;
}

}  // namespace

double texel_side(const LightSpace& space, const double3& world_point) {
    if (space.is_parallel()) return 1.0 / space.texels_per_unit;
    const double3 q = transform_point(space.from_world, world_point);
    double sum = 0.0;
    for (int eye = 0; eye < space.eye_count(); ++eye) sum += side_seen_by(space, eye, q);
    return sum / space.eye_count();
}

}  // namespace opacity
