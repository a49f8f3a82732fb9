// A coat of fur on any opaque body.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>

#include "io/demo.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/strands.hpp"

namespace opacity::demo {

// How fur lies at one place, in the body's units.
struct Lie {
    double length = 1.0;              // 0: bare
    double width = 0.04;              // at the root, of the usual number of strands
    double lift = 0.6;                // of its start: 0 lies on the skin, 1 stands up
    glm::dvec3 comb{0.0, 0.0, -1.0};  // whither; only what lies along the surface counts
    glm::dvec3 root_color{0.1}, tip_color{0.4};
};
using LieAt = std::function<Lie(const glm::dvec3& point, const glm::dvec3& normal)>;

// Strands that start all over the body, as many on each part of its area; none where it is bare.
std::shared_ptr<Strands> coat(const Mesh& body, const Request& request, const LieAt& lie);

}  // namespace opacity::demo
