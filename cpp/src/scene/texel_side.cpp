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

// A bilinear look-up reads what lies within a texel; wider filters leave a split sooner.
constexpr double reach_px = 1.5;

double split_scale_at(const LightSpace& space, const double3& q) {
    for (std::size_t i = 1; i < space.splits.size(); ++i) {
        const double3 p = space.splits[i].place(q);
        const auto is_held = [&](double x) {
            return x > reach_px && x < space.map_size_px - reach_px;
        };
        if (is_held(p[0]) && is_held(p[1])) return space.splits[i].scale;
    }
    return 1.0;
}

}  // namespace

double texel_side(const LightSpace& space, const double3& world_point) {
    const double3 q = transform_point(space.from_world, world_point);
    if (space.is_parallel()) return 1.0 / (split_scale_at(space, q) * space.texels_per_unit);
    double sum = 0.0;
    for (int eye = 0; eye < space.eye_count(); ++eye) sum += side_seen_by(space, eye, q);
    return sum / space.eye_count();
}

}  // namespace opacity
