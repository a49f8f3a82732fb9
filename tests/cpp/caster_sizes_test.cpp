// How many texels a caster covers at most: no segment visits more on any face, wherever the light
// is.
#include "techniques/caster_sizes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "map/face.hpp"
#include "opacity/scene/strands.hpp"
#include "scene/positional_fit.hpp"

using namespace opacity;
using namespace opacity::techniques;

namespace {

constexpr int strands = 300;
constexpr float width = 0.03f;

// Strands of a segment each, up to .2 long, in a cube of side 2.
ShapePtr needles() {
    std::mt19937 engine{5};
    std::uniform_real_distribution<double> place{-1.0, 1.0}, step{-0.1, 0.1};
    std::vector<double> xyz;
    std::vector<std::int64_t> offsets{0};
    for (int i = 0; i < strands; ++i) {
        const double3 root{place(engine), place(engine), place(engine)};
        xyz.insert(xyz.end(), root.begin(), root.end());
        for (const double c : root) xyz.push_back(c + step(engine));
        offsets.push_back(2 * (i + 1));
    }
    return std::make_shared<Strands>(Positions{xyz}, offsets, std::vector{width});
}

float3 in_light(const LightSpace& space, const double3& p) {
    const double3 q = transform_point(space.from_world, p);
    return {float(q[0]), float(q[1]), float(q[2])};
}

// As casters/strands.comp.glsl goes through them.
double texels_visited(const LightSpace& space, int face_index, float3 root, float3 tip) {
    const MapFace face{space, face_index};
    const float3 along{tip[0] - root[0], tip[1] - root[1], tip[2] - root[2]};
    const float a = face.seen(root)[2], b = face.seen(tip)[2], least = 1.001f * least_forward;
    if (std::max(a, b) <= least) return 0.0;
    const auto at = [&](float s) {
        return float3{root[0] + s * along[0], root[1] + s * along[1], root[2] + s * along[2]};
    };
    if (a < least) root = at((least - a) / (b - a));
    if (b < least) tip = at((least - a) / (b - a));
    const float range = float(space.depth_range);
    const float3 p = face.place(root), q = face.place(tip);
    const double wide = std::max(face.ribbon_width(root, along, width / range),
                                 face.ribbon_width(tip, along, width / range));
    const int axis = std::abs(q[1] - p[1]) > std::abs(q[0] - p[0]) ? 1 : 0;
    const double slope = double(q[1 - axis] - p[1 - axis]) / double(q[axis] - p[axis]);
    const double half_width = 0.5 * wide * std::sqrt(1.0 + slope * slope);
    const auto on_face = [&](double x) { return std::clamp(x, 0.0, double(space.map_size_px)); };
    double visited = 0.0;
    const double end = on_face(std::ceil(std::max(p[axis], q[axis])));
    for (double column = on_face(std::floor(std::min(p[axis], q[axis]))); column < end; ++column) {
        const double y = p[1 - axis] + slope * (column + 0.5 - p[axis]);
        visited += on_face(std::floor(y + half_width) + 1.0) - on_face(std::floor(y - half_width));
    }
    return visited;
}

}  // namespace

TEST_CASE("no segment visits more texels than its shape's largest may") {
    const ShapePtr shape = needles();
    DrawList list{"casters"};
    list.update({shape});
    const CasterSize size = caster_sizes(list).front();
    for (const double away : {0.0, 0.5, 1.2, 2.0, 4.0, 40.0}) {
        CAPTURE(away);
        Scene scene;
        scene.add(shape);
        PositionalFit fit;
        const LightSpace space = fit.fit(
            scene, PointLight{{0.3 * away, 0.2 * away, away}}, [](double) { return 256; }, Box{});
        const double most = most_texels(size, *shape, space);
        double found = 0.0;
        for (int i = 0; i < strands; ++i)
            for (int face = 0; face < space.face_count(); ++face)
                found = std::max(
                    found, texels_visited(space, face, in_light(space, shape->points()[2 * i]),
                                          in_light(space, shape->points()[2 * i + 1])));
        CHECK(found > 0.0);
        CHECK(found <= most);
        if (away >= 4.0) CHECK(most < 20.0 * found);  // and not much more, where it can tell
    }
}

TEST_CASE("surfaces and volumes cover any number of texels") {
    CHECK(most_texels({}, *needles(), LightSpace{}) == std::numeric_limits<double>::infinity());
}
