// Where a ray crosses a caster: the geometric rule, which stands here only (docs/accuracy.md,
// "Truth by rays").
#pragma once

#include <cstdint>
#include <optional>

#include "rays/casters.hpp"
#include "rays/ray.hpp"

namespace opacity::rays {

// -log(1 - opacity); opacity 1 on what is not an opaque mesh is the next smaller float32.
double optical_depth(double opacity);

// Of a strand or a surface, which have no extent along the ray.
struct Crossing {
    double distance;  // from the ray's origin, in the frame's units; may be negative
    double optical_depth;

    bool is_within(const Span& span) const { return distance > span.from && distance < span.to; }
};

// Segments of one strand that follow one another, joined at points that lie within half the width
// of the ray. However many they are, the strand is crossed there once, where its axis passes the
// ray most closely; or not at all, where the ray passes beyond an end of the strand.
struct Stretch {
    std::uint32_t last = 0;  // segment
    std::optional<Crossing> crossing;
};

// Whether the axis of the segment comes within half the width of the ray.
bool touches(const Casters& casters, const Ray& ray, std::uint32_t segment);
// The stretch that a touching segment belongs to.
Stretch stretch_around(const Casters& casters, const Ray& ray, std::uint32_t segment);
// A ray through an edge or a corner that triangles share crosses one of them.
std::optional<Crossing> cross_triangle(const Casters& casters, const Ray& ray,
                                       std::uint32_t triangle);
// Along the part of the chord that lies within the span.
double optical_depth_through(const Sphere& sphere, const Ray& ray, const Span& span);

}  // namespace opacity::rays
