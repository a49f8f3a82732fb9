#include "io/demo_rabbit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "io/demo_implicit.hpp"

namespace opacity::demo {
namespace {

// It is built looking along x, y to its left, and then turned toward the camera.
constexpr double turn_cos = -0.936, turn_sin = -0.352;

glm::dvec3 turned(const glm::dvec3& p) {
    return {turn_cos * p.x - turn_sin * p.y, turn_sin * p.x + turn_cos * p.y, p.z};
}
glm::dvec3 turned_back(const glm::dvec3& p) {
    return {turn_cos * p.x + turn_sin * p.y, -turn_sin * p.x + turn_cos * p.y, p.z};
}

// An ellipsoid of the body with its fur. A part beside the middle stands for both sides.
struct Part {
    glm::dvec3 center, half_axes;
    glm::dvec3 upward;  // where its z axis points
    double reach;       // of its blending into the rest
    double fur_length;
    glm::dvec3 comb;
};
const Part parts[] = {
    {{-5.0, 0.0, 9.4}, {9.2, 7.2, 8.6}, {0, 0, 1}, 3.0, 1.7, {-1.0, 0.0, -0.45}},      // rump
    {{4.5, 0.0, 9.6}, {6.6, 5.4, 7.0}, {-0.2, 0, 1}, 5.0, 1.6, {-0.7, 0.0, -0.8}},     // chest
    {{8.3, 0.0, 14.2}, {3.8, 3.7, 4.2}, {0.5, 0, 1}, 4.0, 1.4, {-0.8, 0.0, -0.8}},     // neck
    {{11.5, 0.0, 18.3}, {5.0, 3.9, 4.1}, {0, 0, 1}, 3.0, 0.8, {-1.0, 0.0, -0.2}},      // head
    {{15.2, 0.0, 17.2}, {2.8, 2.5, 2.3}, {0, 0, 1}, 2.5, 0.45, {-1.0, 0.0, -0.1}},     // muzzle
    {{13.6, 2.0, 16.6}, {2.3, 1.7, 1.9}, {0, 0, 1}, 1.5, 0.55, {-1.0, 0.0, -0.3}},     // cheeks
    {{-5.2, 5.2, 6.6}, {6.4, 3.4, 5.8}, {0.3, 0, 1}, 2.0, 1.5, {-0.8, 0.0, -0.7}},     // thighs
    {{-0.5, 6.4, 1.5}, {5.2, 1.7, 1.5}, {0, 0, 1}, 1.2, 0.6, {1.0, 0.0, -0.1}},        // hind feet
    {{7.6, 2.7, 5.2}, {1.9, 1.7, 5.4}, {-0.12, 0, 1}, 2.0, 0.8, {0.1, 0.0, -1.0}},     // forelegs
    {{9.3, 2.7, 1.3}, {2.6, 1.5, 1.3}, {0, 0, 1}, 1.0, 0.45, {1.0, 0.0, -0.2}},        // paws
    {{-14.0, 0.0, 8.0}, {2.9, 2.7, 2.9}, {0, 0, 1}, 1.0, 2.3, {-0.8, 0.0, 0.6}},       // tail
    {{8.1, 2.6, 26.4}, {1.0, 1.9, 6.6}, {-0.36, 0.15, 1}, 1.2, 0.4, {-0.3, 0.1, 1.0}}  // ears
};
const glm::dvec3 eye{12.9, 3.35, 19.3};
constexpr double eye_radius = 0.85;

double distance(const Part& part, glm::dvec3 p) {
    if (part.center.y > 0.0) p.y = std::abs(p.y);
    const glm::dvec3 up = glm::normalize(part.upward), q = p - part.center;
    const glm::dvec3 forward = glm::normalize(glm::dvec3{up.z, 0.0, -up.x}),
                     left = glm::cross(up, forward);
    return ellipsoid_distance({glm::dot(q, forward), glm::dot(q, left), glm::dot(q, up)},
                              part.half_axes);
}

double body(const glm::dvec3& p) {
    double result = 1e3;
    for (const Part& part : parts) result = smooth_union(result, distance(part, p), part.reach);
    return result;
}

// Where two parts meet, their fur blends.
Lie blended(const glm::dvec3& p) {
    Lie lie{.length = 0.0, .comb = glm::dvec3{0.0}};
    double sum = 0.0;
    for (const Part& part : parts) {
        const double near = std::max(distance(part, p), 0.0) + 0.25;
        const double weight = 1.0 / (near * near * near * near);
        const double side = part.center.y > 0.0 && p.y < 0.0 ? -1.0 : 1.0;
        lie.length += weight * part.fur_length;
        lie.comb += weight * part.comb * glm::dvec3{1.0, side, 1.0};
        sum += weight;
    }
    lie.length /= sum;
    lie.comb /= sum;
    return lie;
}

// Brown above, pale below and under the tail, rosy inside the ears.
glm::dvec3 fur_color(const glm::dvec3& p, const glm::dvec3& normal) {
    const glm::dvec3 brown{0.3, 0.18, 0.095}, pale{0.66, 0.58, 0.48}, rose{0.58, 0.36, 0.28};
    const bool on_ear = p.z > 22.5;
    if (on_ear) return normal.x > 0.55 ? rose : brown;
    double light = glm::smoothstep(0.05, 0.75, -normal.z);
    light = std::max(light, glm::smoothstep(15.0, 16.6, p.x));      // muzzle
    light = std::max(light, glm::smoothstep(-14.5, -16.5, p.x));    // tail
    light = std::max(light, 0.8 * glm::smoothstep(4.0, 1.0, p.z));  // feet
    const double ring = glm::length(glm::dvec3{p.x, std::abs(p.y), p.z} - eye);
    light = std::max(light, 0.7 * glm::smoothstep(1.7, 1.2, ring));
    return brown + light * (pale - brown);
}

}  // namespace

std::shared_ptr<Mesh> rabbit() {
    Triangles triangles;
    add_surface(triangles, body, {-18.0, -9.0, -1.0}, {19.0, 9.0, 34.0}, 0.45);
    for (std::size_t i = 0; i < triangles.xyz.size(); i += 3) {
        const glm::dvec3 p = turned(triangles.point(i / 3));
        triangles.xyz[i] = float(p.x);
        triangles.xyz[i + 1] = float(p.y);
        triangles.xyz[i + 2] = float(std::max(p.z, 0.0));
    }
    return mesh(std::move(triangles), {{0.2f, 0.13f, 0.1f}});
}

std::shared_ptr<Mesh> rabbit_eyes() {
    Triangles triangles;
    for (const double side : {1.0, -1.0})
        add_ball(triangles, 8, [&](const glm::dvec3& direction) {
            return turned(eye * glm::dvec3{1.0, side, 1.0} + eye_radius * direction);
        });
    return mesh(std::move(triangles), {{0.02f, 0.015f, 0.012f}});
}

Lie rabbit_fur(const glm::dvec3& point, const glm::dvec3& normal) {
    const glm::dvec3 p = turned_back(point), n = turned_back(normal);
    Lie lie = blended(p);
    lie.comb = turned(lie.comb);
    lie.width = 0.045;
    lie.lift = 0.55;
    const double from_eye = glm::length(glm::dvec3{p.x, std::abs(p.y), p.z} - eye);
    lie.length *= glm::smoothstep(eye_radius, eye_radius + 1.6, from_eye);
    if (from_eye < eye_radius + 0.15 || p.z < 0.05) lie.length = 0.0;
    lie.tip_color = fur_color(p, n);
    lie.root_color = 0.45 * lie.tip_color;
    return lie;
}

}  // namespace opacity::demo
