#include "io/demo_bust.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "io/demo_triangles.hpp"

namespace opacity::demo {
namespace {

constexpr float3 skin{0.62f, 0.47f, 0.38f};
const glm::dvec3 head_center{0.0, 0.0, 32.0};
const glm::dvec3 head_axes{7.9, 9.6, 11.4};

double square(double x) {
    return x * x;
}

// 1 in the middle, 0 from distance 1 on, smooth between.
double bump(double squared_distance) {
    return square(std::max(0.0, 1.0 - squared_distance));
}

// 1 on the head's surface and proportional to the distance from its centre, so that dividing a
// point by it moves the point there. An ellipsoid, narrower toward the chin, with a nose and eye
// sockets.
double head_gauge(const glm::dvec3& q) {
    const double length = glm::length(q);
    if (length == 0.0) return 0.0;
    const glm::dvec3 d = q / length;
    const double width = 1.0 + 0.16 * d.z;
    const double ellipsoid =
        std::sqrt(square(q.x / (head_axes.x * width)) + square(q.y / (head_axes.y * width)) +
                  square(q.z / head_axes.z));
    if (d.y >= 0.0) return ellipsoid;
    const double nose =
        bump(square(d.x / 0.17) + square((d.z + 0.16) / (d.z < -0.16 ? 0.12 : 0.34)));
    const double eye = bump(square((std::abs(d.x) - 0.3) / 0.24) + square((d.z - 0.07) / 0.16));
    const double chin = bump(square(d.x / 0.35) + square((d.z + 0.78) / 0.24));
    return ellipsoid / (1.0 + 0.2 * nose - 0.07 * eye + 0.05 * chin);
}

// Neck and shoulders are ellipses on top of each other.
struct Ring {
    double z, half_width, half_depth, y;
};
constexpr std::array<Ring, 10> rings{{{0.0, 15.4, 8.2, 1.0},
                                      {4.0, 16.8, 8.6, 1.0},
                                      {9.0, 17.4, 8.6, 1.2},
                                      {12.0, 16.8, 8.0, 1.4},
                                      {14.0, 14.6, 7.2, 1.6},
                                      {15.5, 10.6, 6.4, 1.8},
                                      {17.0, 7.0, 5.6, 1.9},
                                      {19.0, 5.3, 5.2, 1.7},
                                      {23.0, 4.9, 5.0, 1.4},
                                      {27.0, 4.9, 5.0, 1.2}}};

double hermite(double a, double b, double slope_a, double slope_b, double t) {
    return a + t * (slope_a + t * (3.0 * (b - a) - 2.0 * slope_a - slope_b +
                                   t * (2.0 * (a - b) + slope_a + slope_b)));
}

// A smooth profile through the rings (Catmull-Rom with uneven steps).
Ring ring_at(double z) {
    std::size_t i = 0;
    while (i + 2 < rings.size() && rings[i + 1].z <= z) ++i;
    const Ring &a = rings[i], &b = rings[i + 1];
    const Ring &before = rings[i > 0 ? i - 1 : 0],
               &after = rings[std::min(i + 2, rings.size() - 1)];
    const double step = b.z - a.z, t = std::clamp((z - a.z) / step, 0.0, 1.0);
    const auto along = [&](double Ring::*m) {
        const double slope_a = (b.*m - before.*m) / (b.z - before.z) * step;
        const double slope_b = (after.*m - a.*m) / (after.z - a.z) * step;
        return hermite(a.*m, b.*m, slope_a, slope_b, t);
    };
    return {z, along(&Ring::half_width), along(&Ring::half_depth), along(&Ring::y)};
}

void add_shoulders(Triangles& mesh) {
    constexpr int levels = 56;
    const std::vector<glm::dvec2> circle = unit_circle(56);
    const auto count = static_cast<std::uint32_t>(circle.size());
    const std::uint32_t first = mesh.count();
    for (int level = 0; level <= levels; ++level) {
        const Ring ring = ring_at(rings.back().z * level / levels);
        for (const glm::dvec2& c : circle)
            mesh.add({ring.half_width * c.x, ring.y + ring.half_depth * c.y, ring.z});
    }
    for (std::uint32_t level = 0; level < levels; ++level)
        mesh.band(first + level * count, first + (level + 1) * count, count);
    // Closed below; above, the opening lies inside the head, and is closed all the same.
    const std::uint32_t bottom = mesh.add({0.0, rings.front().y, 0.0});
    const std::uint32_t top = mesh.add({0.0, rings.back().y, rings.back().z});
    const std::uint32_t last = first + levels * count;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count;
        mesh.triangle(bottom, first + next, first + i);
        mesh.triangle(top, last + i, last + next);
    }
}

}  // namespace

glm::dvec3 head_point(const glm::dvec3& direction) {
    return head_center + direction / head_gauge(direction);
}

double scalp_height(const glm::dvec3& d) {
    return d.z - 0.1 + 0.62 * d.y;
}

glm::dvec3 outside(const glm::dvec3& point, double gap) {
    glm::dvec3 p{point.x, point.y, std::max(point.z, gap)};
    if (p.z < rings.back().z) {
        const Ring ring = ring_at(p.z);
        const double x = p.x / (ring.half_width + gap),
                     y = (p.y - ring.y) / (ring.half_depth + gap);
        const double gauge = std::sqrt(x * x + y * y);
        if (gauge < 1.0 && gauge > 1e-6) {
            p.x /= gauge;
            p.y = ring.y + (p.y - ring.y) / gauge;
        }
    }
    const glm::dvec3 q = p - head_center;
    const double gauge = head_gauge(q), least = 1.0 + gap / head_axes.x;
    return gauge < least && gauge > 1e-6 ? head_center + q * (least / gauge) : p;
}

// Skin, and under the hair the darker scalp, so that a parting does not shine.
float3 skin_color(const glm::dvec3& point) {
    constexpr float3 scalp{0.2f, 0.12f, 0.08f};
    const double height = scalp_height(glm::normalize(point - head_center));
    const auto part = float(glm::smoothstep(-0.02, 0.12, height));
    float3 color = skin;
    for (std::size_t i = 0; i < 3; ++i) color[i] += part * (scalp[i] - skin[i]);
    return color;
}

std::shared_ptr<Mesh> bust() {
    Triangles triangles;
    add_ball(triangles, 28, head_point);
    std::vector<float3> color;
    for (std::size_t i = 0; i < triangles.count(); ++i)
        color.push_back(skin_color(triangles.point(i)));
    add_shoulders(triangles);
    color.resize(triangles.count(), skin);
    return mesh(std::move(triangles), std::move(color));
}

}  // namespace opacity::demo
