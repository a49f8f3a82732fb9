// Hair as it falls: locks of strands around guides, combed away from a parting and from the face,
// waves that grow toward the tips, and strands that fly away from their lock. See demo_bust.hpp for
// why there is no trigonometry.
#include <algorithm>
#include <cmath>
#include <vector>

#include "io/demo.hpp"
#include "io/demo_bust.hpp"
#include "io/demo_strands.hpp"
#include "io/demo_triangles.hpp"
#include "io/random.hpp"
#include "opacity/core/error.hpp"
#include "opacity/io/load.hpp"

namespace opacity {
namespace demo {
namespace {

constexpr std::size_t guide_count = 420;
constexpr float strand_opacity = 0.35f;

using Curve = std::vector<glm::dvec3>;

struct Range {
    double low, high;
};
// A style of the whole head, in centimetres.
struct Cut {
    std::string_view style;
    std::size_t segments;  // of a strand
    double root_width, tip_width;
    Range length, lift, wave, wavelength;
    bool curls;     // waves wind around the lock
    double astray;  // of the tip, from the lock
};
// Widths are full at 10,000 strands of 15 segments, still fine at 100,000.
constexpr Cut cuts[] = {
    {"wavy", 15, 0.05, 0.018, {22.0, 29.0}, {0.3, 1.7}, {0.15, 0.75}, {9.0, 15.0}, false, 0.25},
    {"straight", 15, 0.05, 0.02, {25.0, 31.0}, {0.2, 1.1}, {0.0, 0.12}, {12.0, 20.0}, false, 0.12},
    {"curly", 60, 0.1, 0.04, {14.0, 22.0}, {0.7, 3.0}, {0.55, 0.95}, {2.6, 3.8}, true, 0.35},
};

// What the strands of a lock share, and each varies a little.
struct Style {
    const Cut* cut;
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

// Smooth, of period 1, between -1 and 1: two parabolas.
double wave(double x) {
    const double u = 2.0 * (x - std::floor(x));
    return u < 1.0 ? 4.0 * u * (1.0 - u) : -4.0 * (u - 1.0) * (2.0 - u);
}

glm::dvec3 scalp_direction(Random& random) {
    for (;;) {
        const glm::dvec3 direction = random.unit_vector();
        if (scalp_height(direction) > 0.0) return direction;
    }
}

// Leaves along the normal, then gives way to gravity and, on top of the head, to the comb.
Curve grown(const Style& style) {
    const std::size_t segments = style.cut->segments;
    Curve curve(segments + 1);
    const double step = style.length / double(segments);
    const double yielding = 0.75 * (15.0 / double(segments));
    const glm::dvec3 comb{0.75 * style.side, 0.85, 0.1};
    const double on_top = std::clamp(2.0 * (style.root.z - 0.1), 0.0, 1.0);
    glm::dvec3 heading = glm::normalize(style.root + 0.5 * on_top * comb);
    curve[0] = outside(head_point(style.root), 0.03);
    for (std::size_t i = 1; i <= segments; ++i) {
        const double t = double(i) / double(segments);
        const double combed = on_top * std::max(0.0, 1.0 - 2.5 * t);
        const glm::dvec3 pull = glm::dvec3{0.0, 0.0, -1.0} + 1.6 * combed * comb;
        heading = glm::normalize(heading + yielding * pull);
        const double gap = style.lift * std::min(1.0, 3.0 * t);
        glm::dvec3 next = curve[i - 1] + step * heading;
        // Moving out stretches the step: shortened and moved out again it slides along the surface.
        for (int round = 0; round < 3; ++round) {
            next = outside(next, gap);
            heading = glm::normalize(next - curve[i - 1]);
            next = curve[i - 1] + step * heading;
        }
        curve[i] = outside(next, gap);
    }
    return curve;
}

void add_waves(Curve& curve, const Style& style) {
    const bool curls = style.cut->curls;
    for (std::size_t i = 1; i < curve.size(); ++i) {
        const double t = double(i) / double(style.cut->segments);
        const double along = t * style.length / style.wavelength;
        const double size = style.wave * std::min(1.0, (curls ? 4.0 : 1.4) * t);
        const double x = wave(along + style.phase.x);
        // A quarter behind makes a circle; across it, what lies on top of the head winds as well.
        const double y = wave(along + (curls ? style.phase.x + 0.25 : style.phase.y));
        const double z = curls ? 0.6 * wave(along + style.phase.x + 0.6) : 0.0;
        curve[i] += size * glm::dvec3{x, y, z};
    }
}

double drawn(const Range& range, Random& random) {
    return random.uniform(range.low, range.high);
}

Guide guide(const Cut& cut, Random& random) {
    Guide guide;
    const glm::dvec3 root = scalp_direction(random);
    guide.style = {.cut = &cut,
                   .root = root,
                   .side = root.x > 0.14 ? 1.0 : -1.0,
                   .length = drawn(cut.length, random),
                   .lift = drawn(cut.lift, random),
                   .wave = drawn(cut.wave, random),
                   .wavelength = drawn(cut.wavelength, random),
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
    const double astray = flies_away ? 1.6 : style.cut->astray;
    const glm::dvec3 drift{random.around_zero(), random.around_zero(), random.around_zero()};
    for (std::size_t i = 1; i < curve.size(); ++i) {
        const double t = double(i) / double(style.cut->segments);
        const double pull = together * t * t * (3.0 - 2.0 * t);
        curve[i] += pull * (guide.curve[i] - curve[i]) + astray * t * drift;
        curve[i] = outside(curve[i], std::min(0.15, 0.03 + t));
    }
    return curve;
}

StrandArrays::Point point_of(const Curve& curve, std::size_t i, const Style& style) {
    const glm::dvec3 brown{0.13, 0.065, 0.032}, auburn{0.28, 0.11, 0.045};
    const glm::dvec3 base = style.brightness * (brown + style.tone * (auburn - brown));
    const double t = double(i) / double(style.cut->segments);
    const double root = style.cut->root_width, tip = style.cut->tip_width;
    // Full along most of the strand; the taper belongs to the tip.
    return {curve[i], root + (tip - root) * t * t, base * (0.85 + 0.4 * t)};
}

std::shared_ptr<Strands> strands(const Cut& cut, std::size_t segments, unsigned seed) {
    Random guide_random{seed, 1}, strand_random{seed, 2};
    std::vector<Guide> guides(guide_count);
    std::generate(guides.begin(), guides.end(), [&] { return guide(cut, guide_random); });

    StrandArrays arrays{segments, cut.segments};
    while (!arrays.full()) {
        const glm::dvec3 root = scalp_direction(strand_random);
        const Guide& lock = nearest(guides, root);
        const Style style = varied(lock.style, root, strand_random);
        const Curve curve = strand(style, lock, strand_random);
        arrays.add([&](std::size_t i) { return point_of(curve, i, style); });
    }
    return std::move(arrays).strands(strand_opacity);
}

}  // namespace

std::vector<ShapePtr> hair(const Request& request) {
    const auto cut = std::find_if(std::begin(cuts), std::end(cuts),
                                  [&](const Cut& known) { return known.style == request.style; });
    return {strands(*cut, request.count, request.seed), bust(),
            ground(90.0, {0.55f, 0.56f, 0.58f})};
}

}  // namespace demo

std::vector<ShapePtr> demo_hair(std::size_t segments, unsigned seed) {
    constexpr std::size_t most_segments = 100'000'000;
    if (segments < 1 || segments > most_segments)
        throw ParameterError("segments = " + std::to_string(segments) + " is outside 1.." +
                                 std::to_string(most_segments),
                             "choose a number in this range; 150000 is a full head of hair");
    return demo::hair({segments, segments, seed, "wavy"});
}

}  // namespace opacity
