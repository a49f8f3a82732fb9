// Hair as it falls: locks of strands around guides, combed away from a parting and from the face,
// waves that grow toward the tips, and strands that fly away from their lock. See demo_bust.hpp for
// why there is no trigonometry.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "io/demo_bust.hpp"
#include "io/random.hpp"
#include "opacity/core/error.hpp"
#include "opacity/io/load.hpp"
#include "opacity/scene/strands.hpp"

namespace opacity {
namespace {

constexpr std::size_t strand_segments = 15, strand_points = strand_segments + 1;
constexpr std::size_t guide_count = 420;
constexpr float strand_opacity = 0.35f;
constexpr double root_width = 0.05,
                 tip_width = 0.018;  // full at 10,000 strands, still fine at 100,000

using Curve = std::array<glm::dvec3, strand_points>;

// What the strands of a lock share, and each varies a little.
struct Style {
    glm::dvec3 root;  // direction from the head's centre
    double side;      // of the parting, -1 or 1: the whole lock falls to one
    double length, lift, wave, wavelength;
    glm::dvec2 phase;
    double tone, brightness;
};

struct Guide {
    Style style;
    Curve curve;
};

double fraction(std::size_t point) {
    return double(point) / double(strand_segments);
}

// Smooth, of period 1, between -1 and 1: two parabolas.
double wave(double x) {
    const double u = 2.0 * (x - std::floor(x));
    return u < 1.0 ? 4.0 * u * (1.0 - u) : -4.0 * (u - 1.0) * (2.0 - u);
}

glm::dvec3 scalp_direction(Random& random) {
    for (;;) {
        const glm::dvec3 direction = random.unit_vector();
        if (demo::scalp_height(direction) > 0.0) return direction;
    }
}

// Leaves along the normal, then gives way to gravity and, on top of the head, to the comb.
Curve grown(const Style& style) {
    Curve curve;
    const double step = style.length / double(strand_segments);
    const glm::dvec3 comb{0.75 * style.side, 0.85, 0.1};
    const double on_top = std::clamp(2.0 * (style.root.z - 0.1), 0.0, 1.0);
    glm::dvec3 heading = glm::normalize(style.root + 0.5 * on_top * comb);
    curve[0] = demo::outside(demo::head_point(style.root), 0.03);
    for (std::size_t i = 1; i < strand_points; ++i) {
        const double t = fraction(i);
        const double combed = on_top * std::max(0.0, 1.0 - 2.5 * t);
        const glm::dvec3 pull = glm::dvec3{0.0, 0.0, -1.0} + 1.6 * combed * comb;
        heading = glm::normalize(heading + 0.75 * pull);
        const double gap = style.lift * std::min(1.0, 3.0 * t);
        glm::dvec3 next = curve[i - 1] + step * heading;
        // Moving out stretches the step: shortened and moved out again it slides along the surface.
        for (int round = 0; round < 3; ++round) {
            next = demo::outside(next, gap);
            heading = glm::normalize(next - curve[i - 1]);
            next = curve[i - 1] + step * heading;
        }
        curve[i] = demo::outside(next, gap);
    }
    return curve;
}

void add_waves(Curve& curve, const Style& style) {
    for (std::size_t i = 1; i < strand_points; ++i) {
        const double t = fraction(i), along = t * style.length / style.wavelength;
        const double size = style.wave * std::min(1.0, 1.4 * t);
        curve[i] +=
            size * glm::dvec3{wave(along + style.phase.x), wave(along + style.phase.y), 0.0};
    }
}

Guide guide(Random& random) {
    Guide guide;
    const glm::dvec3 root = scalp_direction(random);
    guide.style = {.root = root,
                   .side = root.x > 0.14 ? 1.0 : -1.0,
                   .length = random.uniform(22.0, 29.0),
                   .lift = random.uniform(0.3, 1.7),
                   .wave = random.uniform(0.15, 0.75),
                   .wavelength = random.uniform(9.0, 15.0),
                   .phase = {random.uniform(), random.uniform()},
                   .tone = random.uniform(),
                   .brightness = random.uniform(0.8, 1.2)};
    guide.curve = grown(guide.style);
    add_waves(guide.curve, guide.style);
    return guide;
}

const Guide& nearest(const std::vector<Guide>& guides, const glm::dvec3& root) {
    return *std::max_element(guides.begin(), guides.end(), [&](const Guide& a, const Guide& b) {
        return glm::dot(a.style.root, root) < glm::dot(b.style.root, root);
    });
}

Style varied(Style style, const glm::dvec3& root, Random& random) {
    style.root = root;
    style.length *= 1.0 + 0.1 * random.around_zero();
    style.length *= 1.0 - 0.25 * std::max(0.0, random.uniform() - 0.75);  // some are shorter
    style.lift = std::max(0.15, style.lift + 0.5 * random.around_zero());
    style.wave *= 1.0 + 0.3 * random.around_zero();
    style.phase += 0.08 * glm::dvec2{random.around_zero(), random.around_zero()};
    style.tone = std::clamp(style.tone + 0.35 * random.around_zero(), 0.0, 1.0);
    style.brightness *= 1.0 + 0.25 * random.around_zero();
    return style;
}

Curve strand(const Style& style, const Guide& guide, Random& random) {
    Curve curve = grown(style);
    add_waves(curve, style);
    const bool flies_away = random.uniform() < 0.04;
    const double together = flies_away ? 0.0 : random.uniform(0.5, 0.85);
    const double astray = flies_away ? 1.6 : 0.25;
    const glm::dvec3 drift{random.around_zero(), random.around_zero(), random.around_zero()};
    for (std::size_t i = 1; i < strand_points; ++i) {
        const double t = fraction(i);
        const double pull = together * t * t * (3.0 - 2.0 * t);
        curve[i] += pull * (guide.curve[i] - curve[i]) + astray * t * drift;
        curve[i] = demo::outside(curve[i], std::min(0.15, 0.03 + t));
    }
    return curve;
}

struct StrandArrays {
    std::vector<float> xyz, width;
    std::vector<float3> color;
    std::vector<std::int64_t> offsets{0};

    explicit StrandArrays(std::size_t points) {
        xyz.reserve(3 * points);
        width.reserve(points);
        color.reserve(points);
    }

    void add(const Curve& curve, std::size_t points, const Style& style) {
        const glm::dvec3 brown{0.13, 0.065, 0.032}, auburn{0.28, 0.11, 0.045};
        const glm::dvec3 base = style.brightness * (brown + style.tone * (auburn - brown));
        for (std::size_t i = 0; i < points; ++i) {
            const double t = fraction(i);
            const glm::dvec3& p = curve[i];
            const glm::dvec3 c = base * (0.85 + 0.4 * t);
            xyz.insert(xyz.end(), {float(p.x), float(p.y), float(p.z)});
            color.push_back({float(c.x), float(c.y), float(c.z)});
            // Full along most of the strand; the taper belongs to the tip.
            width.push_back(float(root_width + (tip_width - root_width) * t * t));
        }
        offsets.push_back(std::int64_t(width.size()));
    }
};

std::shared_ptr<Strands> hair(std::size_t segments, unsigned seed) {
    Random guide_random{seed, 1}, strand_random{seed, 2};
    std::vector<Guide> guides(guide_count);
    std::generate(guides.begin(), guides.end(), [&] { return guide(guide_random); });

    const std::size_t strands = (segments + strand_segments - 1) / strand_segments;
    StrandArrays arrays{segments + strands};
    for (std::size_t left = segments; left > 0; left -= std::min(left, strand_segments)) {
        const glm::dvec3 root = scalp_direction(strand_random);
        const Guide& lock = nearest(guides, root);
        const Style style = varied(lock.style, root, strand_random);
        // The last strand is cut where the number asked for is reached.
        arrays.add(strand(style, lock, strand_random), std::min(left, strand_segments) + 1, style);
    }
    return std::make_shared<Strands>(Positions{std::move(arrays.xyz)}, std::move(arrays.offsets),
                                     std::move(arrays.width), std::vector{strand_opacity},
                                     std::move(arrays.color));
}

}  // namespace

std::vector<ShapePtr> demo_hair(std::size_t segments, unsigned seed) {
    constexpr std::size_t most_segments = 100'000'000;
    if (segments < 1 || segments > most_segments)
        throw ParameterError("segments = " + std::to_string(segments) + " is outside 1.." +
                                 std::to_string(most_segments),
                             "choose a number in this range; 150000 is a full head of hair");
    return {hair(segments, seed), demo::bust(), demo::ground()};
}

}  // namespace opacity
