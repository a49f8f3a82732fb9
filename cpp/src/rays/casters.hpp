// What casts, copied out of the scene into one frame.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "opacity/scene/particles.hpp"
#include "opacity/scene/scene.hpp"
#include "rays/coverage.hpp"
#include "rays/frame.hpp"
#include "rays/voxels.hpp"

namespace opacity::rays {

struct Vertex {
    double3 position;
    double half_width;  // 0 on a surface
    double opacity;
    float2 uv{};
};

struct Sphere {
    double3 center;
    double radius;
    double optical_depth;  // through the centre
    DensityProfile profile;
};

// Triangles first .. end - 1, which an alpha map covers.
struct Foliage {
    std::uint32_t first, end;
    Coverage coverage;
};

enum class Kind { segment, triangle, sphere, volume };

// One number for each primitive: the segments, the triangles, the spheres, the volumes.
struct Casters {
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    Frame frame;
    // Whether all rays run against the frame's z axis.
    bool parallel = true;
    std::vector<Vertex> vertices;
    // The first vertex of each segment, the other is the next one. Two segments that follow one
    // another are of one strand exactly if their vertices do too.
    std::vector<std::uint32_t> segments;
    std::vector<std::array<std::uint32_t, 3>> triangles;  // those of opaque meshes last
    std::uint32_t first_opaque = 0;                       // index into triangles
    std::vector<Foliage> foliage;                         // by triangles
    std::vector<Sphere> spheres;
    std::vector<Voxels> volumes;
    // Of the particles that are asked about, if they cast.
    std::uint32_t first_own_sphere = none;
    Box bounds;  // in the frame, widths included

    struct Primitive {
        Kind kind;
        std::uint32_t index;
    };
    Primitive primitive(std::uint32_t number) const;
    std::uint32_t number_of_sphere(std::uint32_t index) const {
        return std::uint32_t(segments.size() + triangles.size()) + index;
    }
    std::uint32_t primitive_count() const {
        return number_of_sphere(std::uint32_t(spheres.size() + volumes.size()));
    }
    Box bounds_of(std::uint32_t number) const;
};

// Takes each shape's lock while it copies. `own`: whose points are asked about, or null.
Casters casters_of(const Scene& scene, const Light& light, const Shape* own = nullptr);

}  // namespace opacity::rays
