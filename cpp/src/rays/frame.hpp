// Where rays are followed: float64, so that nothing depends on where the scene lies, and about one
// unit large, so that a hierarchy in float32 fits any scene.
#pragma once

#include "opacity/core/math.hpp"

namespace opacity::rays {

// World to the frame: turned, moved and scaled by a power of two, which rounds nothing.
struct Frame {
    double3 center{};               // in world space
    double4x4 rotation = identity;  // world to frame
    double scale = 1.0;             // the frame's units per world unit

    double3 from_world(const double3& p) const {
        const double3 turned =
            transform_point(rotation, {p[0] - center[0], p[1] - center[1], p[2] - center[2]});
        return {turned[0] * scale, turned[1] * scale, turned[2] * scale};
    }
    // A direction in world space, of the same length.
    double3 turned_back(const double3& d) const {
        const double4x4& m = rotation;
        return {m[0] * d[0] + m[4] * d[1] + m[8] * d[2], m[1] * d[0] + m[5] * d[1] + m[9] * d[2],
                m[2] * d[0] + m[6] * d[1] + m[10] * d[2]};
    }
};

}  // namespace opacity::rays
