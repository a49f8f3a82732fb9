// Opaque bodies of generated scenes, put together from triangles.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "opacity/scene/mesh.hpp"

namespace opacity::demo {

struct Triangles {
    std::vector<float> xyz;
    std::vector<std::uint32_t> indices;

    std::uint32_t count() const { return static_cast<std::uint32_t>(xyz.size() / 3); }
    glm::dvec3 point(std::size_t index) const {
        return {xyz[3 * index], xyz[3 * index + 1], xyz[3 * index + 2]};
    }
    std::uint32_t add(const glm::dvec3& p) {
        xyz.insert(xyz.end(), {float(p.x), float(p.y), float(p.z)});
        return count() - 1;
    }
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        indices.insert(indices.end(), {a, b, c});
    }
    void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        indices.insert(indices.end(), {a, b, c, a, c, d});
    }
    // Between two rings of `points` points each, the lower from `low` on.
    void band(std::uint32_t low, std::uint32_t high, std::uint32_t points);
};

// What moves here changes the mesh: `color` is one for all, or one a point.
std::shared_ptr<Mesh> mesh(Triangles triangles, std::vector<float3> color);

// A cube's grid of n cells an edge, pushed out to where `surface` says that a direction of length 1
// leads: no poles, and no trigonometry.
void add_ball(Triangles& mesh, int n,
              const std::function<glm::dvec3(const glm::dvec3& direction)>& surface);

// The unit circle, counter-clockwise from (1, 0), in four equal parts, each by its rational
// parametrisation; the number of points is brought down to a multiple of 4.
std::vector<glm::dvec2> unit_circle(int points);

// A profile (distance from the z axis, height) turned around that axis, its outside to the right of
// the profile's way; `around` is a multiple of 4.
void add_revolved(Triangles& mesh, const std::vector<glm::dvec2>& profile, int around);

// A square of z = 0 around the origin that receives and does not cast.
std::shared_ptr<Mesh> ground(double half_side, float3 color);

}  // namespace opacity::demo
