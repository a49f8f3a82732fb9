// Smoke over a ring of stones, in metres: a column that widens, billows and drifts with the wind.
#include <algorithm>
#include <utility>

#include "io/demo.hpp"
#include "io/demo_noise.hpp"
#include "io/demo_stones.hpp"
#include "io/demo_triangles.hpp"
#include "io/demo_volume.hpp"

namespace opacity::demo {
namespace {

constexpr double foot = 0.1, top = 6.0;  // of the smoke
constexpr double foot_extinction = 9.0;  // a metre

class Column {
   public:
    explicit Column(unsigned seed) : noise_{seed, 41} {}

    double extinction(const glm::dvec3& p) const {
        if (p.z < foot) return 0.0;
        const double wide = radius(p.z);
        const glm::dvec3 q = (p - axis(p.z)) / wide;
        const double from_axis = glm::length(glm::dvec2{q.x, q.y});
        if (from_axis > 2.0) return 0.0;
        // Eddies grow with the column, and roll more slowly the higher they are.
        const glm::dvec3 eddy = p / (0.45 + 0.16 * p.z) - glm::dvec3{0.0, 0.0, 1.0};
        const double billow = noise_.billows(eddy + 0.5 * noise_.vector(0.6 * eddy), 5);
        const double fade = glm::smoothstep(top, 0.7 * top, p.z + 0.8 * billow);
        const double body = 0.82 - from_axis + 0.62 * billow;
        return std::clamp(3.0 * body, 0.0, 1.0) * fade * foot_extinction * (radius(foot) / wide);
    }

   private:
    static double radius(double z) { return 0.3 + 0.2 * z; }
    glm::dvec3 axis(double z) const {
        const double sway = 0.12 * z;
        return {0.035 * z * z + sway * noise_.at({0.0, 0.4, 0.35 * z}),
                0.01 * z * z + sway * noise_.at({9.0, 0.4, 0.35 * z}), z};
    }

    Noise noise_;
};

std::shared_ptr<Mesh> fireplace(unsigned seed) {
    const Noise noise{seed, 42};
    Triangles triangles;
    for (const glm::dvec2& place : unit_circle(12))
        add_stone(triangles, {0.5 * place, 0.06}, 0.15, noise);
    add_stone(triangles, {0.0, 0.0, 0.0}, 0.3, noise);  // embers
    return mesh(std::move(triangles), {{0.2f, 0.18f, 0.17f}});
}

}  // namespace

std::vector<ShapePtr> smoke(const Request& request) {
    const Column column{request.seed};
    auto shape = volume({{-1.9, -2.0, 0.0}, {3.3, 2.6, top}}, request.count, {0.74f, 0.73f, 0.72f},
                        [&](const glm::dvec3& p) { return column.extinction(p); });
    return {std::move(shape), fireplace(request.seed), ground(18.0, {0.33f, 0.3f, 0.24f})};
}

}  // namespace opacity::demo
