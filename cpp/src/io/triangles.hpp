// Corners as files list them, as three a triangle.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace opacity {

// Around the first corner of a polygon.
inline void add_fan(std::vector<std::uint32_t>& triangles, std::span<const std::uint32_t> corners) {
    for (std::size_t i = 2; i < corners.size(); ++i)
        triangles.insert(triangles.end(), {corners[0], corners[i - 1], corners[i]});
}

// Each corner with the two before it, every other triangle turned so that all face the same way.
inline void add_strip(std::vector<std::uint32_t>& triangles,
                      std::span<const std::uint32_t> corners) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const std::size_t odd = i % 2;
        triangles.insert(triangles.end(), {corners[i - 2 + odd], corners[i - 1 - odd], corners[i]});
    }
}

}  // namespace opacity
