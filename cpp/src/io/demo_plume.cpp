// Smoke of a chimney as particles, in metres: puffs that rise, widen, thin out and bend with the
// wind.
#include <utility>

#include "io/demo.hpp"
#include "io/demo_noise.hpp"
#include "io/demo_particles.hpp"
#include "io/demo_triangles.hpp"
#include "io/random.hpp"

namespace opacity::demo {
namespace {

constexpr double mouth = 2.6, rise = 8.0;  // of the chimney, and of the smoke above it
constexpr std::size_t puff_count = 110;

double plume_radius(double risen) {
    return 0.36 + 0.17 * risen;
}

struct Puff {
    glm::dvec3 center;
    double risen, radius, brightness;
};

std::vector<Puff> puffs(unsigned seed) {
    Random random{seed, 61};
    std::vector<Puff> result;
    for (std::size_t i = 0; i < puff_count; ++i) {
        // Slower and further apart the higher they are.
        const double age = (double(i) + random.uniform()) / double(puff_count);
        const double risen = rise * age * (0.35 + 0.65 * age), wide = plume_radius(risen);
        const glm::dvec3 off = random.unit_vector();
        const double away = 0.55 * wide * random.uniform();
        const glm::dvec3 axis{0.05 * risen * risen, 0.02 * risen * risen, mouth + risen};
        const double radius = wide * random.uniform(0.4, 0.75);
        result.push_back({axis + away * off, risen, radius, random.uniform(0.85, 1.15)});
    }
    return result;
}

std::shared_ptr<Particles> rising(const Request& request) {
    const std::vector<Puff> all = puffs(request.seed);
    const Noise noise{request.seed, 62};
    Random random{request.seed, 63};
    const double size = request.size(0.03, 3.0);
    ParticleArrays arrays{request.count};
    for (std::size_t i = 0; i < request.count; ++i) {
        const Puff& puff = all[std::size_t(random.uniform() * double(puff_count))];
        const double from_middle = glm::sqrt(random.uniform());
        const glm::dvec3 still = puff.center + puff.radius * from_middle * random.unit_vector();
        const double wide = plume_radius(puff.risen);
        const glm::dvec3 curl =
            noise.vector(1.1 / wide * still) + 0.5 * noise.vector(2.6 / wide * still);
        const double thin = puff.risen / rise;
        const double radius = 0.15 * wide * size * (1.0 + 0.4 * random.around_zero());
        const glm::dvec3 soot{0.3, 0.29, 0.28}, pale{0.72, 0.72, 0.73};
        arrays.add(still + 0.35 * puff.radius * curl, radius, 0.42 - 0.34 * thin,
                   puff.brightness * (soot + thin * (pale - soot)));
    }
    return std::move(arrays).particles();
}

std::shared_ptr<Mesh> chimney() {
    Triangles triangles;
    add_revolved(triangles,
                 {{0.62, 0.0},
                  {0.62, 0.25},
                  {0.52, 0.3},
                  {0.42, mouth - 0.3},
                  {0.5, mouth - 0.25},
                  {0.5, mouth},
                  {0.36, mouth},
                  {0.36, mouth - 0.5},
                  {0.0, mouth - 0.5}},
                 32);
    return mesh(std::move(triangles), {{0.36f, 0.15f, 0.1f}});
}

}  // namespace

std::vector<ShapePtr> plume(const Request& request) {
    return {rising(request), chimney(), ground(30.0, {0.45f, 0.44f, 0.4f})};
}

}  // namespace opacity::demo
