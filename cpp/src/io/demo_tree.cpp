// Broad-leaved trees on a lawn, in metres: one in full leaf, and a young one in autumn.
#include <utility>

#include "io/demo.hpp"
#include "io/demo_branches.hpp"
#include "io/demo_leaves.hpp"
#include "io/demo_noise.hpp"

namespace opacity::demo {
namespace {

// Furrowed along the trunk, paler on twigs.
std::shared_ptr<Mesh> wood(const std::vector<Shoot>& shoots, unsigned seed) {
    const Noise noise{seed, 33};
    Triangles triangles;
    std::vector<float3> color;
    for (const Shoot& shoot : shoots) {
        add_shoot(triangles, shoot);
        for (std::size_t i = color.size(); i < triangles.count(); ++i) {
            const double furrow =
                noise.fractal(triangles.point(i) * glm::dvec3{14.0, 14.0, 3.0}, 3);
            const glm::dvec3 bark =
                glm::dvec3{0.17, 0.125, 0.09} * (1.0 + 0.35 * furrow + 0.1 * shoot.level);
            color.push_back({float(bark.x), float(bark.y), float(bark.z)});
        }
    }
    return mesh(std::move(triangles), std::move(color));
}

std::vector<ShapePtr> tree_on_lawn(const TreeShape& shape, Foliage foliage,
                                   const Request& request) {
    // More leaves are smaller ones, so that the crown lets about as much light through.
    foliage.leaf_length *= request.size(0.05, 2.5);
    Random random{request.seed, 31};
    const std::vector<Shoot> shoots = grow(shape, random);
    return {leaves(shoots, foliage, request.count, request.seed), wood(shoots, request.seed),
            ground(20.0, {0.2f, 0.24f, 0.11f})};
}

}  // namespace

std::vector<ShapePtr> tree(const Request& request) {
    const TreeShape shape{.height = 7.0,
                          .bare = 0.24,
                          .spread = 3.2,
                          .branches = 28,
                          .branches_of_a_branch = 8,
                          .twigs_of_those = 6,
                          .upward = 0.45};
    return tree_on_lawn(
        shape, {0.12, {{0.06, 0.17, 0.025}, {0.12, 0.26, 0.04}, {0.24, 0.36, 0.07}}}, request);
}

std::vector<ShapePtr> sparse_tree(const Request& request) {
    const TreeShape shape{.height = 5.0,
                          .bare = 0.3,
                          .spread = 2.1,
                          .branches = 16,
                          .branches_of_a_branch = 5,
                          .twigs_of_those = 4,
                          .upward = 0.8};
    return tree_on_lawn(shape, {0.11, {{0.62, 0.36, 0.05}, {0.68, 0.2, 0.03}, {0.42, 0.07, 0.025}}},
                        request);
}

}  // namespace opacity::demo
