// Plain types for the public interface; GLM stays inside the library.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

namespace opacity {

using float2 = std::array<float, 2>;
using float3 = std::array<float, 3>;
using float4 = std::array<float, 4>;
using double3 = std::array<double, 3>;
// Row-major, for column vectors: p' = M p. The translation is in elements 3, 7 and 11.
using double4x4 = std::array<double, 16>;

inline constexpr double4x4 identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

inline double3 transform_point(const double4x4& m, const double3& p) {
    return {m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3],
            m[4] * p[0] + m[5] * p[1] + m[6] * p[2] + m[7],
            m[8] * p[0] + m[9] * p[1] + m[10] * p[2] + m[11]};
}

// An axis-aligned box; empty until it is extended.
struct Box {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    double3 min{infinity, infinity, infinity};
    double3 max{-infinity, -infinity, -infinity};

    bool empty() const { return !(min[0] <= max[0]); }
    double3 center() const {
        return {0.5 * (min[0] + max[0]), 0.5 * (min[1] + max[1]), 0.5 * (min[2] + max[2])};
    }
    double radius() const;
    void extend(const double3& p) {
        for (int i = 0; i < 3; ++i) {
            min[i] = std::min(min[i], p[i]);
            max[i] = std::max(max[i], p[i]);
        }
    }
    void extend(const Box& box) {
        if (box.empty()) return;
        extend(box.min);
        extend(box.max);
    }
    // Grown by `margin` on every side.
    Box padded(double margin) const;
    // The box around the eight transformed corners.
    Box transformed(const double4x4& m) const;
    bool operator==(const Box&) const = default;
};

}  // namespace opacity
