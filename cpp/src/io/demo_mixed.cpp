// Every kind of caster but a volume, on one ground, in metres: a dense tuft of grass, a sparse bush
// whose crown stands between it and the usual light, so that one texel of the light's map meets two
// clusters far apart; a cloud of dust over boulders; and boulders in the open.
#include <utility>

#include "io/demo.hpp"
#include "io/demo_branches.hpp"
#include "io/demo_leaves.hpp"
#include "io/demo_meadow.hpp"
#include "io/demo_noise.hpp"
#include "io/demo_particles.hpp"
#include "io/demo_stones.hpp"

namespace opacity::demo {
namespace {

// From centimetres around the origin to metres around a place.
void place_at(Shape& shape, double scale, const glm::dvec2& place) {
    shape.set_transform({scale, 0, 0, place.x, 0, scale, 0, place.y, 0, 0, scale, 0, 0, 0, 0, 1});
}

std::shared_ptr<Mesh> boulders(unsigned seed) {
    const Noise noise{seed, 71};
    Triangles triangles;
    add_stone(triangles, {1.15, -0.2, 0.15}, 0.3, noise);
    add_stone(triangles, {0.75, -0.5, 0.08}, 0.17, noise);
    add_stone(triangles, {0.25, 0.2, 0.1}, 0.2, noise);  // in the grass
    add_stone(triangles, {-0.85, 0.45, 0.06}, 0.14, noise);
    return mesh(std::move(triangles), {{0.42f, 0.4f, 0.38f}});
}

// Of one size at any number of blades, unlike a meadow.
std::shared_ptr<Strands> tuft(std::size_t segments, const Request& request) {
    const double share = double(request.count) / double(request.usual);
    return grass({.blades_per_square_meter = 16'000.0 * share,
                  .height = 26.0,
                  .droop = 0.6,
                  .straw = 0.05,
                  .width = 0.42 * request.size(0.1, 3.0)},
                 segments, request.seed);
}

std::shared_ptr<Particles> dust(std::size_t count, const Request& request) {
    const Noise noise{request.seed, 72};
    Random random{request.seed, 73};
    const double radius = 0.02 * request.size(0.03, 3.0);
    ParticleArrays arrays{count};
    for (std::size_t i = 0; i < count; ++i) {
        const double from_middle = glm::sqrt(random.uniform());
        const glm::dvec3 ball = from_middle * random.unit_vector();
        const glm::dvec3 center =
            glm::dvec3{0.55, -0.55, 1.05} +
            glm::dvec3{0.4, 0.34, 0.22} * (ball + 0.5 * noise.vector(2.0 * ball));
        arrays.add(center, radius * (1.0 + 0.4 * random.around_zero()), 0.16, {0.8, 0.74, 0.64});
    }
    return std::move(arrays).particles();
}

}  // namespace

std::vector<ShapePtr> mixed(const Request& request) {
    const std::size_t leaf_count = request.count / 50, particle_count = request.count / 10;
    const unsigned seed = request.seed;
    std::vector<ShapePtr> shapes{tuft(request.count - leaf_count - particle_count, request)};
    place_at(*shapes.back(), 0.01, {0.2, 0.15});

    Random random{seed, 74};
    const std::vector<Shoot> shoots = grow({.height = 1.5,
                                            .bare = 0.32,
                                            .spread = 0.7,
                                            .branches = 14,
                                            .branches_of_a_branch = 5,
                                            .twigs_of_those = 3,
                                            .upward = 0.7},
                                           random);
    Triangles wood;
    for (const Shoot& shoot : shoots) add_shoot(wood, shoot);
    const Foliage foliage{0.06 * request.size(0.05, 2.5), {{0.08, 0.2, 0.04}, {0.2, 0.34, 0.07}}};
    std::vector<ShapePtr> bush{mesh(std::move(wood), {{0.2f, 0.15f, 0.11f}})};
    if (leaf_count > 0) bush.push_back(leaves(shoots, foliage, leaf_count, seed));
    for (const ShapePtr& part : bush) {
        place_at(*part, 1.0, {-0.6, -0.35});
        shapes.push_back(part);
    }
    if (particle_count > 0) shapes.push_back(dust(particle_count, request));
    shapes.push_back(boulders(seed));
    shapes.push_back(ground(6.0, {0.3f, 0.26f, 0.2f}));
    return shapes;
}

}  // namespace opacity::demo
