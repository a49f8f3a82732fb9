#include "scene/map_window.hpp"

#include <algorithm>
#include <cmath>

#include "core/vector.hpp"

namespace opacity {
namespace {

// A ribbon reaches farther along the map's axes than across itself, by sqrt(2) at most; and to the
// middle of a column beside its end, and rounding moves it.
constexpr double stretch = 2.0;
constexpr double slack_px = 2.0;
constexpr double slack_depth = 1e-4;
// Nearer to a positional light, in reaches, its picture may be anything.
constexpr double near_reaches = 10.0;

// Depth 1 is that of the last receiver.
constexpr double last_depth = 1.0 + slack_depth;

bool is_out_of_split(const LightSplit& split, const Box& box, double reach_px, int size_px) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const double pad = split.scale * reach_px + slack_px;
        const double low = split.scale * box.min[axis] + split.offset_px[axis] - pad;
        const double high = split.scale * box.max[axis] + split.offset_px[axis] + pad;
        if (high < 0.0 || low > size_px) return true;
    }
    return false;
}

bool is_out_of_parallel_map(const LightSpace& space, const Box& box, double reach) {
    if (box.min[2] - reach / space.depth_range > last_depth) return true;
    const double reach_px = reach * space.texels_per_unit;
    if (space.splits.empty()) return is_out_of_split({}, box, reach_px, space.map_size_px);
    return std::ranges::all_of(space.splits, [&](const LightSplit& split) {
        return is_out_of_split(split, box, reach_px, space.map_size_px);
    });
}

// In light coordinates, turned to the face.
bool is_out_of_face(const LightFace& face, const Box& box, double reach, int size_px) {
    double3 nearest{};
    for (std::size_t i = 0; i < 3; ++i) nearest[i] = std::max({box.min[i], -box.max[i], 0.0});
    const double distance = length(nearest);
    if (!(distance > near_reaches * reach)) return false;
    if (distance - length(face.offset) + face.depth_of_origin > last_depth) return true;
    if (box.max[2] < 0.0) return true;
    // Before the face a place is beyond a side where this is above 0.
    const auto is_beyond = [&](std::size_t axis, double side, double px) {
        const auto least = [&](double factor, std::size_t i) {
            return std::min(factor * box.min[i], factor * box.max[i]);
        };
        return least(side * face.focal_px, axis) + least(side * (face.middle_px[axis] - px), 2) >
               0.0;
    };
    for (std::size_t axis = 0; axis < 2; ++axis)
        if (is_beyond(axis, 1.0, size_px + slack_px) || is_beyond(axis, -1.0, -slack_px))
            return true;
    return false;
}

Box turned(const LightFace& face, const Box& box) {
    Box result;
    for (std::size_t i = 0; i < 8; ++i) {
        double3 corner;
        for (std::size_t axis = 0; axis < 3; ++axis)
            corner[axis] = (i >> axis & 1 ? box.max : box.min)[axis];
        result.extend(face.seen(corner));
    }
    return result;
}

}  // namespace

bool is_out_of_map(const LightSpace& space, const Box& points, double reach) {
    if (points.empty()) return true;
    reach *= stretch;
    if (space.is_parallel())
        return is_out_of_parallel_map(space, points.transformed(space.from_world), reach);
    const double reach_ranges = reach / space.depth_range;
    const Box box = points.transformed(space.from_world).padded(reach_ranges);
    return std::ranges::all_of(space.faces, [&](const LightFace& face) {
        return is_out_of_face(face, turned(face, box), reach_ranges, space.map_size_px);
    });
}

}  // namespace opacity
