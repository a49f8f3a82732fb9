// A ray from a receiver toward the light, with the plane across it. It asks nothing of its
// neighbours, so that each may have a direction of its own.
#pragma once

#include <limits>

#include "opacity/core/math.hpp"

namespace opacity::rays {

inline double dot(const double3& a, const double3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

struct Ray {
    double3 origin;
    double3 x, y, toward;  // orthonormal
    double length = std::numeric_limits<double>::infinity();

    // x and y across the ray, z the distance along it. The same point always gives the same bits:
    // what is decided on a shared edge or joint is decided alike from both sides.
    double3 seen(const double3& p) const {
        const double3 d{p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]};
        return {dot(d, x), dot(d, y), dot(d, toward)};
    }
    double3 at(double distance, const std::array<double, 2>& across = {}) const;
};

// Against a direction of light that is the z axis; x and y are across it.
Ray parallel_ray(const double3& origin);
// To a light at a point. Of length 0 where the origin lies there: then it crosses nothing.
Ray ray_to(const double3& light, const double3& origin);

// Casters count strictly between these distances from a ray's origin.
struct Span {
    double from, to;
};

// The part of a ray that is searched: from a point near the casters, which float32 can hold however
// far the ray's origin is.
struct Reach {
    double3 start;
    double length;  // negative: none
};

// What lies beyond the box need not be searched; where it is missed, nothing.
Reach reach_within(const Ray& ray, const Span& span, const Box& box);

}  // namespace opacity::rays
