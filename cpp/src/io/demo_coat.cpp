#include "io/demo_coat.hpp"

#include <algorithm>
#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <vector>

#include "io/demo_noise.hpp"
#include "io/demo_strands.hpp"
#include "io/random.hpp"

namespace opacity::demo {
namespace {

constexpr std::size_t hair_segments = 5;
constexpr float hair_opacity = 0.5f;

glm::dvec3 vec(const double3& p) {
    return glm::make_vec3(p.data());
}
glm::dvec3 vec(const float3& n) {
    return {n[0], n[1], n[2]};
}

struct Root {
    glm::dvec3 point, normal;
};

// Draws places on a mesh, each part of its area as likely as any other.
class Skin {
   public:
    explicit Skin(const Mesh& mesh) : mesh_{mesh} {
        double sum = 0.0;
        for (std::size_t t = 0; t < mesh.triangles().size(); t += 3) {
            const glm::dvec3 a = corner(t), ab = corner(t + 1) - a, ac = corner(t + 2) - a;
            sum += glm::length(glm::cross(ab, ac));
            area_.push_back(sum);
        }
    }

    Root root(Random& random) const {
        const double sought = random.uniform() * area_.back();
        const auto found = std::upper_bound(area_.begin(), area_.end() - 1, sought);
        const auto t = std::size_t(found - area_.begin()) * 3;
        double u = random.uniform(), v = random.uniform();
        if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
        const auto mixed = [&](const auto& of) {
            return (1.0 - u - v) * of(t) + u * of(t + 1) + v * of(t + 2);
        };
        return {mixed([&](std::size_t i) { return corner(i); }),
                glm::normalize(mixed([&](std::size_t i) { return normal(i); }))};
    }

   private:
    glm::dvec3 corner(std::size_t i) const { return vec(mesh_.points()[mesh_.triangles()[i]]); }
    glm::dvec3 normal(std::size_t i) const { return vec(mesh_.normals()[mesh_.triangles()[i]]); }

    const Mesh& mesh_;
    std::vector<double> area_;  // up to each triangle's end
};

// From the skin up and over into the lie of the coat; neighbours stray together, as tufts do.
std::array<glm::dvec3, hair_segments + 1> grown(const Root& root, const Lie& lie,
                                                const Noise& tufts, Random& random) {
    const double length = lie.length * (0.85 + 0.15 * random.around_zero());
    const double frequency = 1.0 / lie.length;
    const glm::dvec3 astray = 0.35 * tufts.vector(0.4 * frequency * root.point) +
                              0.45 * tufts.vector(1.3 * frequency * root.point) +
                              0.22 * random.unit_vector();
    const glm::dvec3 comb = lie.comb + astray;
    const glm::dvec3 flat = comb - glm::dot(comb, root.normal) * root.normal;
    std::array<glm::dvec3, hair_segments + 1> hair{root.point};
    for (std::size_t i = 1; i <= hair_segments; ++i) {
        const double t = double(i) / double(hair_segments);
        const double up = std::max(0.12, lie.lift * (1.35 - t));
        const glm::dvec3 heading = glm::normalize(up * root.normal + (0.25 + t) * flat);
        hair[i] = hair[i - 1] + length / double(hair_segments) * heading;
    }
    return hair;
}

}  // namespace

std::shared_ptr<Strands> coat(const Mesh& body, const Request& request, const LieAt& lie_at) {
    const Skin skin{body};
    const Noise tufts{request.seed, 11};
    Random random{request.seed, 12};
    const double size = request.size(0.2, 3.0);
    StrandArrays arrays{request.count, hair_segments};
    while (!arrays.full()) {
        const Root root = skin.root(random);
        const Lie lie = lie_at(root.point, root.normal);
        if (lie.length <= 0.0) continue;
        const auto hair = grown(root, lie, tufts, random);
        const double brightness = 1.0 + 0.3 * random.around_zero();
        arrays.add([&](std::size_t i) {
            const double t = double(i) / double(hair_segments);
            const glm::dvec3 color = lie.root_color + t * (lie.tip_color - lie.root_color);
            return StrandArrays::Point{hair[i], size * lie.width * (1.0 - 0.8 * t * t),
                                       brightness * color};
        });
    }
    return std::move(arrays).strands(hair_opacity);
}

}  // namespace opacity::demo
