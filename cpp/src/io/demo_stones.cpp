#include "io/demo_stones.hpp"

#include <algorithm>

namespace opacity::demo {

void add_stone(Triangles& mesh, const glm::dvec3& center, double radius, const Noise& noise) {
    add_ball(mesh, 16, [&](const glm::dvec3& direction) {
        // Each from a place of its own in the noise; a flattened ball with dents and bulges.
        const glm::dvec3 place = center / radius + 0.8 * direction;
        const double bulge = 1.0 + 0.3 * noise.fractal(place, 4);
        const glm::dvec3 p = center + radius * bulge * direction * glm::dvec3{1.0, 0.9, 0.7};
        return glm::dvec3{p.x, p.y, std::max(p.z, 0.0)};
    });
}

}  // namespace opacity::demo
