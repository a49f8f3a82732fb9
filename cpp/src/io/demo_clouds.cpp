// A layer of fair-weather cumulus over a plain, in kilometres: flat below, where water begins to
// condense, and domed above.
#include <algorithm>
#include <utility>
#include <vector>

#include "io/demo.hpp"
#include "io/demo_noise.hpp"
#include "io/demo_triangles.hpp"
#include "io/demo_volume.hpp"
#include "io/random.hpp"

namespace opacity::demo {
namespace {

constexpr double half_side = 3.0, base = 0.9, top = 2.0;
constexpr double full_extinction = 11.0;  // a kilometre
constexpr int cells = 6;                  // with a cloud each, along a side

struct Cloud {
    glm::dvec2 center;
    double radius, height;
};

class Sky {
   public:
    explicit Sky(unsigned seed) : noise_{seed, 51} {
        Random random{seed, 52};
        for (int cell = 0; cell < cells * cells; ++cell) {
            const double x = cell % cells + random.uniform(), y = cell / cells + random.uniform();
            const double size = random.uniform(), radius = 0.2 + 0.55 * size * size;
            const double height = radius * random.uniform(0.75, 1.1);
            const glm::dvec2 place = 2.0 / cells * glm::dvec2{x, y} - 1.0;
            clouds_.push_back({(half_side - 1.1 * radius) * place, radius, height});
        }
    }

    double extinction(const glm::dvec3& p) const {
        const double above = p.z - base - 0.025 * noise_.at(3.0 * p);
        if (above < 0.0) return 0.0;
        double dome = -1.0;
        for (const Cloud& cloud : clouds_) {
            const glm::dvec2 q = (glm::dvec2{p.x, p.y} - cloud.center) / cloud.radius;
            const double up = above / cloud.height;
            dome = std::max(dome, 1.0 - glm::dot(q, q) - up * up);
        }
        if (dome <= -0.9) return 0.0;
        const double body = dome - 0.25 + 0.75 * noise_.billows(2.6 * p, 6);
        // More water the higher in the cloud.
        return full_extinction * std::clamp(4.0 * body, 0.0, 1.0) *
               std::min(1.0, 0.5 + 2.0 * above);
    }

   private:
    Noise noise_;
    std::vector<Cloud> clouds_;
};

}  // namespace

std::vector<ShapePtr> clouds(const Request& request) {
    const Sky sky{request.seed};
    auto shape =
        volume({{-half_side, -half_side, base - 0.05}, {half_side, half_side, top}}, request.count,
               {0.95f, 0.95f, 0.96f}, [&](const glm::dvec3& p) { return sky.extinction(p); });
    return {std::move(shape), ground(2.5 * half_side, {0.27f, 0.33f, 0.17f})};
}

}  // namespace opacity::demo
