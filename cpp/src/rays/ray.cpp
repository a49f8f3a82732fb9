#include "rays/ray.hpp"

#include <algorithm>
#include <cmath>

namespace opacity::rays {
namespace {

double3 cross(const double3& a, const double3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double3 divided(const double3& v, double by) {
    return {v[0] / by, v[1] / by, v[2] / by};
}

double length_of(const double3& v) {
    return std::hypot(v[0], v[1], v[2]);
}

// The axis that is farthest from a direction.
double3 axis_across(const double3& direction) {
    std::size_t smallest = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(direction[i]) < std::abs(direction[smallest])) smallest = i;
    double3 axis{};
    axis[smallest] = 1.0;
    return axis;
}

}  // namespace

double3 Ray::at(double distance, const std::array<double, 2>& across) const {
    double3 p = origin;
    for (std::size_t i = 0; i < 3; ++i)
        p[i] += across[0] * x[i] + across[1] * y[i] + distance * toward[i];
    return p;
}

Ray parallel_ray(const double3& origin) {
    return {origin, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
}

Ray ray_to(const double3& light, const double3& origin) {
    const double3 way{light[0] - origin[0], light[1] - origin[1], light[2] - origin[2]};
    Ray ray = parallel_ray(origin);
    ray.length = length_of(way);
    if (!(ray.length > 0.0)) return ray;
    ray.toward = divided(way, ray.length);
    const double3 x = cross(axis_across(ray.toward), ray.toward);
    ray.x = divided(x, length_of(x));
    ray.y = cross(ray.toward, ray.x);
    return ray;
}

Reach reach_within(const Ray& ray, const Span& span, const Box& box) {
    double from = span.from, to = span.to;
    for (std::size_t i = 0; i < 3; ++i) {
        const double low = box.min[i] - ray.origin[i], high = box.max[i] - ray.origin[i];
        if (ray.toward[i] == 0.0) {
            if (low > 0.0 || high < 0.0) return {{}, -1.0};
            continue;
        }
        const double a = low / ray.toward[i], b = high / ray.toward[i];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    Reach reach{ray.at(from), to - from};
    for (std::size_t i = 0; i < 3; ++i)  // what a far origin rounds away is put right
        reach.start[i] = std::clamp(reach.start[i], box.min[i], box.max[i]);
    return reach;
}

}  // namespace opacity::rays
