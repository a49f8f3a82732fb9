// A ray from a receiver toward the light, with the plane across it. It asks nothing of its
// neighbours, so that each may have a direction of its own.
#pragma once

#include "opacity/core/math.hpp"

namespace opacity::rays {

inline double dot(const double3& a, const double3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

struct Ray {
    double3 origin;
    double3 x, y, toward;  // orthonormal

    // x and y across the ray, z the distance along it. The same point always gives the same bits:
    // what is decided on a shared edge or joint is decided alike from both sides.
    double3 seen(const double3& p) const {
        const double3 d{p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]};
        return {dot(d, x), dot(d, y), dot(d, toward)};
    }
};

// The part of a ray that is searched: from a point near the casters, which float32 can hold however
// far the ray's origin is.
struct Reach {
    double3 start;
    double length;  // negative: none
};

}  // namespace opacity::rays
