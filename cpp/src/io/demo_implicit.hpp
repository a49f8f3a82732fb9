// Rounded bodies as the surface where a function of space is zero.
#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "io/demo_triangles.hpp"

namespace opacity::demo {

// Negative inside; near the surface about the distance to it.
using Field = std::function<double(const glm::dvec3&)>;

// An ellipsoid of these half axes along x, y, z.
double ellipsoid_distance(const glm::dvec3& from_center, const glm::dvec3& half_axes);
// The smaller of two, rounded where they are nearer to each other than `reach`.
double smooth_union(double a, double b, double reach);

// The surface within a box that holds it, in cells of this edge, by surface nets (Gibson 1998): a
// point in each cell that it passes, moved onto it, and a quad around each edge that it crosses.
void add_surface(Triangles& mesh, const Field& field, const glm::dvec3& low, const glm::dvec3& high,
                 double cell);

}  // namespace opacity::demo
