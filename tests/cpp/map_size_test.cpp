// The size of a map that a scene asks for: a texel is as wide as the space between strands, or as
// the strands, or as the filter says, in any unit and anywhere in the world.
#include "scene/map_size.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "opacity/scene/mesh.hpp"
#include "opacity/scene/strands.hpp"

using namespace opacity;

namespace {

using StrandsPtr = std::shared_ptr<Strands>;

// count x count parallel strands along z, `spacing` apart.
struct Lattice {
    int count = 64;
    double spacing = 1.0, length = 50.0;
    int points = 40;  // of each strand
    double width = 0.01;
    double scale = 1.0;
    double3 move{};
};

StrandsPtr strands_of(const Lattice& lattice) {
    std::vector<double> xyz;
    std::vector<std::int64_t> offsets{0};
    for (int i = 0; i < lattice.count * lattice.count; ++i) {
        for (int k = 0; k < lattice.points; ++k) {
            const double3 p{lattice.spacing * (i % lattice.count),
                            lattice.spacing * (i / lattice.count),
                            lattice.length * k / (lattice.points - 1)};
            for (std::size_t axis = 0; axis < 3; ++axis)
                xyz.push_back(lattice.scale * p[axis] + lattice.move[axis]);
        }
        offsets.push_back(offsets.back() + lattice.points);
    }
    return std::make_shared<Strands>(Positions{std::move(xyz)}, std::move(offsets),
                                     std::vector<float>{float(lattice.scale * lattice.width)});
}

Scene scene_of(const std::vector<ShapePtr>& shapes) {
    Scene scene;
    for (const ShapePtr& shape : shapes) scene.add(shape);
    return scene;
}

constexpr double no_filter_width = -1.0;

int size_px(const Scene& scene, double side, double filter_width = no_filter_width) {
    MapSizeRule rule;
    return rule.choose(scene, side, filter_width).size_px;
}
int size_px(const Lattice& lattice, double side) {
    return size_px(scene_of({strands_of(lattice)}), side);
}

}  // namespace

// n strands take n - 1 spaces: 1 part in 64, and 32 texels of 2,000 are another.
TEST_CASE("a texel is as wide as the space between parallel strands, to 4 %") {
    for (const double spacing : {0.05, 1.0, 300.0})
        for (const int count : {64, 100}) {
            CAPTURE(spacing);
            CAPTURE(count);
            const Lattice lattice{.count = count, .spacing = spacing, .width = 0.1 * spacing};
            const int found = size_px(lattice, 2000.0 * spacing);
            CHECK(found >= 0.96 * 2000);
            CHECK(found <= 1.04 * 2000);
        }
}

TEST_CASE("cutting strands in more segments changes nothing") {
    const int fine = size_px(Lattice{.points = 60}, 1990.0);
    for (const int points : {2, 3, 10, 33}) {
        CAPTURE(points);
        CHECK(size_px(Lattice{.points = points}, 1990.0) == fine);
    }
}

TEST_CASE("strands wider than the space between them count instead") {
    // 20 / 0.1 = 200 texels, in steps of 32.
    MapSizeRule rule;
    const Scene scene = scene_of({strands_of({.spacing = 0.05, .width = 0.1})});
    const MapSize found = rule.choose(scene, 20.0, no_filter_width);
    CHECK(found.size_px == 224);
    CHECK(found.why.find("width of strands") != std::string::npos);
    CHECK(found.why.find("0.1") != std::string::npos);
}

TEST_CASE("a filter is two texels wide, whatever the strands") {
    const Scene hairy = scene_of({strands_of({})}), empty;
    for (const Scene* scene : {&hairy, &empty}) {
        CHECK(size_px(*scene, 100.0, 0.5) == 416);  // 100 / 0.25, in steps of 32
        CHECK(size_px(*scene, 100.0, 0.25) == 800);
        CHECK(size_px(*scene, 100.0, 0.125) == 1600);
    }
    MapSizeRule rule;
    CHECK(rule.choose(hairy, 100.0, 0.5).why.find("filter_width") != std::string::npos);
}

TEST_CASE("without strands that cast, a map has 512 texels along a side") {
    const auto silent = strands_of({.count = 3}), clear = strands_of({.count = 3});
    silent->set_casts(false);
    clear->set_opacity({0.f});
    const ShapePtr surface =
        std::make_shared<Mesh>(Positions{std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0}},
                               std::vector<std::uint32_t>{0, 1, 2});
    for (const Scene& scene :
         {Scene{}, scene_of({surface}), scene_of({silent}), scene_of({clear})}) {
        MapSizeRule rule;
        const MapSize found = rule.choose(scene, 10.0, no_filter_width);
        CHECK(found.size_px == 512);
        CHECK(found.why.find("no strands") != std::string::npos);
    }
}

TEST_CASE("a size is a multiple of 32 from 64 to 4096, enough for the texel") {
    const Scene scene = scene_of({strands_of({})});
    int last = 0;
    for (double side = 1e-6; side < 1e9; side *= 1.07) {
        const int found = size_px(scene, side, 2.0);  // texels of 1
        REQUIRE(found % 32 == 0);
        REQUIRE(found >= std::max(64, last));
        REQUIRE(found <= 4096);
        if (found > 64 && found < 4096) REQUIRE((found >= side && found < side + 32.0));
        last = found;
    }
    CHECK(size_px(scene, 1e-6) == 64);
    CHECK(size_px(scene, 1e9) == 4096);
    CHECK(size_px(scene, 1e-30, 1e9) == 64);
    CHECK(size_px(scene, 1e18, 1e-30) == 4096);
    CHECK(last == 4096);
    // Fewer strands than the least map has texels.
    CHECK(size_px(Lattice{.count = 8}, 7.0) == 64);
}

TEST_CASE("neither the unit nor the place in the world changes the size") {
    const int found = size_px(Lattice{}, 1990.0);
    for (const double scale : {1e-3, 1.0, 1e3}) {
        CAPTURE(scale);
        CHECK(size_px(Lattice{.scale = scale}, 1990.0 * scale) == found);
        double4x4 transform = identity;
        for (const std::size_t i : {0u, 5u, 10u}) transform[i] = scale;
        transform[3] = 1e6 * scale, transform[7] = -1e6 * scale;
        const auto moved = strands_of({});
        moved->set_transform(transform);
        CHECK(size_px(scene_of({moved}), 1990.0 * scale) == found);
    }
    CHECK(size_px(Lattice{.move = {1e6, -1e6, 1e6}}, 1990.0) == found);
}

TEST_CASE("strands without extent, width or space give some size") {
    for (const float width : {0.f, 0.1f})
        for (const std::vector<double>& xyz :
             {std::vector<double>{0, 0, 0}, {0, 0, 0, 0, 0, 0}, {0, 0, 0, 1, 0, 0}}) {
            const auto count = std::int64_t(xyz.size() / 3);
            const auto one = std::make_shared<Strands>(
                Positions{xyz}, std::vector<std::int64_t>{0, count}, std::vector<float>{width});
            const int found = size_px(scene_of({one}), 1.0);
            CHECK(found >= 64);
            CHECK(found <= 4096);
        }
}

TEST_CASE("what was measured follows the shapes") {
    const auto hair = strands_of({});
    const Scene scene = scene_of({hair});
    MapSizeRule rule;
    const auto found = [&] { return rule.choose(scene, 1000.0, no_filter_width).size_px; };
    const int first = found();
    double4x4 twice = identity;
    for (const std::size_t i : {0u, 5u, 10u}) twice[i] = 2.0;
    hair->set_transform(twice);
    CHECK(std::abs(found() - first / 2) <= 32);
    hair->set_color({{1, 0, 0}});
    CHECK(std::abs(found() - first / 2) <= 32);
    hair->set_transform(identity);
    CHECK(found() == first);
    hair->set_casts(false);
    CHECK(found() == 512);
    hair->set_casts(true);
    hair->set_opacity({0.f});
    CHECK(found() == 512);
}
