#include "scene/view_frustum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/vector.hpp"

namespace opacity {
namespace {

// Inside: dot(outward, p) <= offset.
struct Plane {
    double3 outward;
    double offset;
};

double3 middle_of(const Hexahedron& corners) {
    double3 sum{};
    for (const double3& corner : corners) sum = plus(sum, corner);
    return scaled(sum, 1.0 / 8.0);
}

std::array<Plane, 6> planes_of(const Hexahedron& corners) {
    const double3 middle = middle_of(corners);
    std::array<Plane, 6> planes;
    for (std::size_t side = 0; side < 6; ++side) {
        const std::size_t axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const std::size_t first = (side % 2) << axis;
        const double3& a = corners[first];
        double3 normal = cross(minus(corners[first | std::size_t{1} << u], a),
                               minus(corners[first | std::size_t{1} << v], a));
        if (dot(normal, minus(middle, a)) > 0.0) normal = scaled(normal, -1.0);
        planes[side] = {normal, dot(normal, a)};
    }
    return planes;
}

// The ends of what of each edge lies inside (Cyrus and Beck 1978).
void add_edges(const Hexahedron& corners, const Hexahedron& within, std::vector<double3>& ends) {
    const std::array<Plane, 6> planes = planes_of(within);
    for (std::size_t from = 0; from < 8; ++from)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (from >> axis & 1) continue;
            const double3& a = corners[from];
            const double3 along = minus(corners[from | std::size_t{1} << axis], a);
            double begin = 0.0, end = 1.0;
            for (const Plane& plane : planes) {
                const double rise = dot(plane.outward, along);
                const double room = plane.offset - dot(plane.outward, a);
                if (rise > 0.0) end = std::min(end, room / rise);
                if (rise < 0.0) begin = std::max(begin, room / rise);
                if (rise == 0.0 && room < 0.0) end = -1.0;
            }
            if (begin > end) continue;
            ends.push_back(plus(a, scaled(along, begin)));
            ends.push_back(plus(a, scaled(along, end)));
        }
}

}  // namespace

Hexahedron corners_of(const Box& box) {
    Hexahedron corners;
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            corners[i][axis] = (i >> axis & 1 ? box.max : box.min)[axis];
    return corners;
}

Hexahedron frustum_of(const CameraView& view, double near, double far) {
    const double4x4 m = view.camera.view_from_world();
    const double3 right{m[0], m[1], m[2]}, up{m[4], m[5], m[6]}, back{m[8], m[9], m[10]};
    const double tangent = std::tan(view.camera.fov_deg() * std::numbers::pi / 360.0);
    Hexahedron corners;
    for (std::size_t i = 0; i < 8; ++i) {
        const double distance = i & 4 ? far : near;
        const double y = (i & 2 ? 1.0 : -1.0) * distance * tangent;
        const double x = (i & 1 ? 1.0 : -1.0) * distance * tangent * view.aspect;
        corners[i] = plus(plus(view.camera.eye(), scaled(back, -distance)),
                          plus(scaled(right, x), scaled(up, y)));
    }
    return corners;
}

bool is_out_of_view(const CameraView& view, const Box& box) {
    constexpr double rounding = 1e-5;  // of how far a corner is; a rasteriser is coarser than this
    const double4x4 to_view = view.camera.view_from_world();
    const double tangent = std::tan(view.camera.fov_deg() * std::numbers::pi / 360.0);
    std::array<bool, 5> beyond;
    beyond.fill(true);
    for (const double3& corner : corners_of(box)) {
        const double3 p = transform_point(to_view, corner);
        const double slack = rounding * (std::abs(p[0]) + std::abs(p[1]) + std::abs(p[2]));
        const double half_height = -p[2] * tangent, half_width = half_height * view.aspect;
        const double outside[5] = {p[2], p[0] - half_width, -p[0] - half_width, p[1] - half_height,
                                   -p[1] - half_height};
        for (std::size_t side = 0; side < beyond.size(); ++side)
            beyond[side] = beyond[side] && outside[side] > slack;
    }
    return !box.empty() && std::ranges::any_of(beyond, [](bool all) { return all; });
}

std::vector<double3> common_corners(const Hexahedron& a, const Hexahedron& b) {
    std::vector<double3> corners;
    add_edges(a, b, corners);
    add_edges(b, a, corners);
    return corners;
}

}  // namespace opacity
