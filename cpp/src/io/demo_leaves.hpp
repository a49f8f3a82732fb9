// Leaves of generated trees: a quad each, cut out by an alpha map.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "io/demo_branches.hpp"
#include "opacity/scene/mesh.hpp"

namespace opacity::demo {

struct Foliage {
    double leaf_length;  // in metres
    std::vector<glm::dvec3> colors;
};

// Along the shoots' outer parts, most on twigs, each of a colour between two that are neighbours.
std::shared_ptr<Mesh> leaves(const std::vector<Shoot>& shoots, const Foliage& foliage,
                             std::size_t count, unsigned seed);

}  // namespace opacity::demo
