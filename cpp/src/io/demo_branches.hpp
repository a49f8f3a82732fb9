// The wood of generated trees, in metres, from the ground z = 0 up.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "io/demo_triangles.hpp"
#include "io/random.hpp"

namespace opacity::demo {

struct TreeShape {
    double height;
    double bare;    // the part of the trunk below the crown
    double spread;  // of the longest branches
    std::size_t branches, branches_of_a_branch, twigs_of_those;
    double upward;  // how steeply branches leave the trunk
};

// One shoot, from where it leaves its parent to its tip.
struct Shoot {
    int level;  // 0: the trunk, 3: twigs
    double length, radius;
    std::vector<glm::dvec3> points;

    glm::dvec3 at(double t) const;
    glm::dvec3 tangent(double t) const;
};

std::vector<Shoot> grow(const TreeShape& shape, Random& random);
// A tapered tube that is closed at its tip.
void add_shoot(Triangles& mesh, const Shoot& shoot);

// A direction across another one, of length 1; which of them, the hint says.
glm::dvec3 across(const glm::dvec3& direction, const glm::dvec3& hint);

}  // namespace opacity::demo
