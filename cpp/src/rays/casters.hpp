// What casts, copied out of the scene into one frame: float64, so that nothing depends on where the
// scene lies, and about one unit large, so that a hierarchy in float32 fits any scene.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "opacity/core/math.hpp"
#include "opacity/scene/scene.hpp"

namespace opacity::rays {

// World to the frame: turned, moved and scaled by a power of two, which rounds nothing.
struct Frame {
    double3 center{};               // in world space
    double4x4 rotation = identity;  // world to frame
    double scale = 1.0;             // the frame's units per world unit

    double3 from_world(const double3& p) const;
};

struct Vertex {
    double3 position;
    double half_width;  // 0 on a surface
    double opacity;
};

// One number for each primitive: first the segments, then the triangles.
struct Casters {
    Frame frame;
    std::vector<Vertex> vertices;
    // The first vertex of each segment, the other is the next one. Two segments that follow one
    // another are of one strand exactly if their vertices do too.
    std::vector<std::uint32_t> segments;
    std::vector<std::array<std::uint32_t, 3>> triangles;  // those of opaque meshes last
    std::uint32_t first_opaque = 0;                       // index into triangles
    Box bounds;                                           // in the frame, widths included

    std::uint32_t primitive_count() const {
        return std::uint32_t(segments.size() + triangles.size());
    }
    Box bounds_of(std::uint32_t primitive) const;
};

// Takes each shape's lock while it copies. The frame's axes are the rows of `rotation`.
Casters casters_of(const Scene& scene, const double4x4& rotation);

}  // namespace opacity::rays
