#include "map/sphere.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/opacity.hpp"

namespace opacity {
namespace {

constexpr float half_circle = std::numbers::pi_v<float>;
constexpr float least_ring_angle = 1e-5f;  // less is rounding

// Over what is counted: optical depth, in that through the middle; the same times the square of an
// interval of even density, in radii; opacity.
struct SphereSums {
    float depth = 0.f, spread = 0.f, opacity = 0.f;
};

// pi / 2 + asin(x) to 1e-7: Abramowitz and Stegun 1964, 4.4.46.
float arc_below(float x) {
    const float a = std::min(std::abs(x), 1.f);
    float series = -0.0012624911f;
    series = series * a + 0.0066700901f;
    series = series * a - 0.0170881256f;
    series = series * a + 0.0308918810f;
    series = series * a - 0.0501743046f;
    series = series * a + 0.0889789874f;
    series = series * a - 0.2145988016f;
    series = series * a + 1.5707963050f;
    const float arc = std::sqrt(1.f - a) * series;
    return x < 0.f ? arc : half_circle - arc;
}

// Of a circle the angle that lies below both of two lines across the axes, which cut it at arcs.
float angle_below(float x_arc, float y_arc) {
    const float sum = x_arc + y_arc;
    return std::max(std::min(2.f * std::min(x_arc, y_arc), sum - 0.5f * half_circle), 0.f) +
           std::max(sum - 1.5f * half_circle, 0.f);
}

// The integral of (1 - exp(-optical_depth c)) c over half chords of 0 .. c, in radii.
float chord_opacity(float optical_depth, float c) {
    const float x = optical_depth * c;
    if (!(x < 0.5f)) return c * c * (0.5f - (1.f - std::exp(-x) * (1.f + x)) / (x * x));
    float series = 1.f / 45360.f;
    series = 1.f / 5760.f - x * series;
    series = 1.f / 840.f - x * series;
    series = 1.f / 144.f - x * series;
    series = 1.f / 30.f - x * series;
    series = 1.f / 8.f - x * series;
    series = 1.f / 3.f - x * series;
    return c * c * x * series;
}

// Of a metaball the integral of (1 - exp(-optical_depth c^5)) c over half chords of d .. c: Gauss's
// rule of three points in c^2, 1.4e-4 from exact over four rings of optical depth 16.6.
float metaball_opacity(float optical_depth, float c, float d) {
    const float middle = 0.5f * (c * c + d * d), apart = 0.38729833f * (c * c - d * d);
    const auto at = [&](float squared) {
        return opacity_of(optical_depth * squared * squared * std::sqrt(squared));
    };
    const float sum = at(middle - apart) * 5.f + at(middle) * 8.f + at(middle + apart) * 5.f;
    return 0.25f * (c * c - d * d) * sum / 9.f;
}

float ring_opacity(DensityProfile profile, float optical_depth, float c, float d) {
    if (profile == DensityProfile::metaball) return metaball_opacity(optical_depth, c, d);
    return chord_opacity(optical_depth, c) - chord_opacity(optical_depth, d);
}

// The texel's edges about the centre, in radii.
struct Edges {
    float low_x, low_y, high_x, high_y;

    bool hold_all() const {
        return low_x <= -1.f && low_y <= -1.f && high_x >= 1.f && high_y >= 1.f;
    }
    float nearest() const {
        const float x = std::max({low_x, -high_x, 0.f}), y = std::max({low_y, -high_y, 0.f});
        return std::sqrt(x * x + y * y);
    }
    float farthest() const {
        const float x = std::max(-low_x, high_x), y = std::max(-low_y, high_y);
        return std::sqrt(x * x + y * y);
    }
    // Of the circle of that radius.
    float angle_inside(float radius) const {
        const float lx = arc_below(low_x / radius), ly = arc_below(low_y / radius);
        const float hx = arc_below(high_x / radius), hy = arc_below(high_y / radius);
        return (angle_below(hx, hy) - angle_below(lx, hy)) -
               (angle_below(hx, ly) - angle_below(lx, ly));
    }
};

SphereSums ring_sums(const Edges& edges, float radius, float optical_depth,
                     DensityProfile profile) {
    const bool is_metaball = profile == DensityProfile::metaball;
    const int rings =
        edges.hold_all() && !is_metaball ? 1 : int(std::clamp(std::ceil(3.f * radius), 4.f, 24.f));
    const int first = int(edges.nearest() * float(rings));
    const int last = std::min(int(edges.farthest() * float(rings)) + 1, rings);
    const float power = is_metaball ? 7.f : 3.f;  // 2k + 3
    SphereSums sums;
    for (int ring = first; ring < last; ++ring) {
        const float begin = float(ring) / float(rings), end = float(ring + 1) / float(rings);
        const float angle = edges.angle_inside(0.5f * (begin + end));
        if (!(angle > least_ring_angle)) continue;
        const float c = std::sqrt(std::max(1.f - begin * begin, 0.f));
        const float d = std::sqrt(std::max(1.f - end * end, 0.f));
        const float c_depth = c * c * chord_depth(profile, c);
        const float d_depth = d * d * chord_depth(profile, d);
        sums.depth += angle * (c_depth - d_depth) / power;
        sums.spread += angle * (c_depth * c * c - d_depth * d * d) / (power + 2.f);
        sums.opacity += angle * ring_opacity(profile, optical_depth, c, d);
    }
    sums.opacity *= radius * radius;
    return sums;
}

SphereSums point_sums(const Edges& edges, float radius, float optical_depth,
                      DensityProfile profile) {
    SphereSums sums;
    for (int i = 0; i < 9; ++i) {
        const float x = edges.low_x + (float(i % 3) + 0.5f) / (3.f * radius);
        const float y = edges.low_y + (float(i / 3) + 0.5f) / (3.f * radius);
        const float c = std::sqrt(std::max(1.f - (x * x + y * y), 0.f));
        const float depth = chord_depth(profile, c);
        sums.depth += depth;
        sums.spread += depth * c * c;
        sums.opacity += opacity_of(optical_depth * depth) / 9.f;
    }
    return sums;
}

}  // namespace

std::optional<SphereChord> sphere_chord(const LightRay& ray, const float3& center, float radius,
                                        DensityProfile profile) {
    const float3 toward = minus(center, ray.origin);
    const float middle = dot(toward, ray.direction);
    const float3 beside = minus(toward, scaled(ray.direction, middle));
    const float half_squared = radius * radius - dot(beside, beside);
    if (!(half_squared > 0.f)) return {};
    const float half_length = std::sqrt(half_squared);
    if (!(middle + half_length > ray.begin)) return {};
    const float first = std::max(-half_length, ray.begin - middle), h = half_length / radius;
    const float even = even_length(profile) * half_length;
    const float begin = middle + std::max(-even, first);
    return SphereChord{begin, std::max(middle + even, begin),
                       chord_depth_within(profile, h, first / radius, h)};
}

std::optional<SphereCoverage> sphere_coverage(const float2& center, float radius,
                                              float optical_depth, DensityProfile profile,
                                              const float2& texel) {
    if (!(radius > 0.f)) return {};
    const Edges edges{
        (texel[0] - 0.5f - center[0]) / radius, (texel[1] - 0.5f - center[1]) / radius,
        (texel[0] + 0.5f - center[0]) / radius, (texel[1] + 0.5f - center[1]) / radius};
    const SphereSums sums = radius < most_ring_texels
                                ? ring_sums(edges, radius, optical_depth, profile)
                                : point_sums(edges, radius, optical_depth, profile);
    if (!(sums.depth > 0.f)) return {};
    return SphereCoverage{std::min(sums.opacity, 1.f),
                          radius * even_length(profile) * std::sqrt(sums.spread / sums.depth)};
}

}  // namespace opacity
