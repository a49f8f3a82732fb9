// What receivers know of their own caster, which is what it left in the map; and the copies of
// casters in light space, which follow their shapes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "map/fragments.hpp"
#include "map/own_deposit.hpp"
#include "opacity/core/error.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/strands.hpp"

using namespace opacity;
using doctest::Approx;

namespace {

constexpr int size_px = 128;

// A map of 8 x 8 world units about the origin, seen along z: powers of two, so that coordinates on
// a grid stay exact.
LightSpace plain_space() {
    LightSpace space;
    space.map_size_px = size_px;
    space.depth_range = 8.0;
    space.texels_per_unit = 16.0;
    space.from_world = {16, 0, 0, 64, 0, 16, 0, 64, 0, 0, 0.125, 0.5, 0, 0, 0, 1};
    return space;
}

using StrandsPtr = std::shared_ptr<Strands>;

StrandsPtr strand(std::vector<double> xyz, float width = 0.1f, std::vector<float> opacity = {.5f}) {
    const auto count = std::int64_t(xyz.size() / 3);
    return std::make_shared<Strands>(Positions{std::move(xyz)}, std::vector<std::int64_t>{0, count},
                                     std::vector<float>{width}, std::move(opacity));
}

std::shared_ptr<Mesh> mesh(std::vector<double> xyz, std::vector<std::uint32_t> triangles,
                           std::vector<float> opacity = {0.5f}) {
    return std::make_shared<Mesh>(Positions{std::move(xyz)}, std::move(triangles),
                                  std::vector<float3>{}, std::move(opacity));
}

std::vector<Receiver> receivers_on(const ShapePtr& shape, bool own_correction = true) {
    Scene scene;
    scene.add(shape);
    return receivers_in(plain_space(), Query::at(*shape, scene), own_correction);
}

void check_finite(const std::vector<Receiver>& receivers) {
    for (const Receiver& r : receivers)
        for (const float v : {r.p_ls[0], r.p_ls[1], r.p_ls[2], r.direction[0], r.direction[1],
                              r.direction[2], r.width_texels, r.opacity, r.ends[0], r.ends[1]})
            CHECK(std::isfinite(v));
}

// The largest difference between what the map holds of a strand alone and what its receivers take
// it to hold, over the texels around each of them; the ends of the strand apart.
double own_error(const StrandsPtr& shape, double* depth_error) {
    const LightSpace space = plain_space();
    const std::vector<ShapePtr> shapes{shape};
    LightCasters casters;
    std::vector<double> optical_depth(std::size_t(size_px) * size_px), depth(optical_depth.size());
    for_each_fragment(FragmentSource{casters, shapes, space, {}}, [&](const Fragment& f) {
        optical_depth[f.texel] += f.optical_depth;
        depth[f.texel] += double(f.optical_depth) * f.depth;
    });
    double worst = 0.0;
    const std::vector<Receiver> receivers = receivers_on(shape);
    for (std::size_t i = 2; i + 2 < receivers.size(); ++i) {
        const int x0 = int(receivers[i].p_ls[0]), y0 = int(receivers[i].p_ls[1]);
        for (int y = y0 - 4; y <= y0 + 4; ++y)
            for (int x = x0 - 4; x <= x0 + 4; ++x) {
                const std::size_t texel = std::size_t(y) * size_px + x;
                const OwnDeposit own =
                    own_deposit(seen(receivers[i], space), x, y, space.depth_range);
                worst = std::max(worst, std::abs(own.optical_depth - optical_depth[texel]));
                if (own.optical_depth > 1e-3f)
                    *depth_error = std::max(
                        *depth_error, std::abs(own.depth - depth[texel] / optical_depth[texel]));
            }
    }
    return worst;
}

double slope_per_texel(double slope) {
    const LightSpace space = plain_space();
    return slope / (space.depth_range * space.texels_per_unit);
}

}  // namespace

TEST_CASE("a straight strand left in the map what its receivers take out again") {
    // On a grid, where light space has no roundings, and segments end between columns.
    for (const auto& [dx, dy] :
         {std::pair{0.5, 0.0}, {0.0, 0.5}, {0.5, 0.25}, {-0.25, 0.5}, {0.5, 0.5}, {-0.5, -0.25}})
        for (const float width : {0.03125f, 0.0625f, 0.5f}) {
            CAPTURE(dx);
            CAPTURE(dy);
            CAPTURE(width);
            const double beside = 0.015625;  // a quarter of a texel across
            const bool steep = std::abs(dy) > std::abs(dx);
            std::vector<double> xyz;
            for (int i = -6; i <= 6; ++i)
                xyz.insert(xyz.end(), {i * dx + (steep ? beside : 0), i * dy + (steep ? 0 : beside),
                                       0.25 * i});
            double depth_error = 0.0;
            CHECK(own_error(strand(xyz, width, {0.9f}), &depth_error) < 1e-6);
            CHECK(depth_error < 1e-6);
        }
    // Anyhow: to the roundings of coordinates near 64, 4e-6 each. A segment that ends in a column
    // has its depth at the end there, up to half a texel beside the middle.
    for (int i = 0; i < 40; ++i) {
        const double angle = 0.157 * i;
        std::vector<double> xyz;
        for (int k = -9; k <= 9; ++k)
            xyz.insert(xyz.end(),
                       {0.33 * k * std::cos(angle), 0.33 * k * std::sin(angle) + 0.01, 0.1 * k});
        double depth_error = 0.0;
        CHECK(own_error(strand(xyz, 0.07f, {0.7f}), &depth_error) < 1e-4);
        CHECK(depth_error < 0.5 * slope_per_texel(0.1 / 0.23));
    }
}

TEST_CASE("receivers on a strand know its direction, where it ends, its width and opacity") {
    const auto bent = strand({0, 0, 0, 1, 0, 2, 1, 1, 2}, 0.25f, {0.1f, 0.2f, 0.3f});
    const std::vector<Receiver> list = receivers_on(bent);
    REQUIRE(list.size() == 3);
    const float dz = 0.125f / 16;  // of a world unit of depth along a world unit across
    CHECK(list[0].p_ls == float3{64, 64, 0.5f});
    CHECK(list[0].direction == float3{1, 0, 2 * dz});
    CHECK(list[1].direction == float3{1, 1, 2 * dz});  // from the point before to the one after
    CHECK(list[2].direction == float3{0, 1, 0});
    CHECK(std::tuple{list[0].ends[0], list[0].ends[1]} == std::tuple{0.f, endless_texels});
    CHECK(std::tuple{list[1].ends[0], list[1].ends[1]} ==
          std::tuple{-endless_texels, endless_texels});
    CHECK(std::tuple{list[2].ends[0], list[2].ends[1]} == std::tuple{-endless_texels, 0.f});
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(list[i].width_texels == 4.f);
        CHECK(list[i].opacity == bent->opacity()[i]);
    }
    double4x4 twice = identity;
    twice[0] = twice[5] = twice[10] = 2.0;
    bent->set_transform(twice);
    CHECK(receivers_on(bent)[1].width_texels == Approx(8.f));
    CHECK(receivers_on(bent)[1].direction == list[1].direction);
}

TEST_CASE("strands of one list do not run into each other") {
    const auto two = std::make_shared<Strands>(
        Positions{std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 2, 0}},
        std::vector<std::int64_t>{0, 2, 4});
    const std::vector<Receiver> list = receivers_on(two);
    CHECK(list[1].direction == float3{1, 0, 0});
    CHECK(list[1].ends[1] == 0.f);
    CHECK(list[2].direction == float3{0, 1, 0});
    CHECK(list[2].ends[0] == 0.f);
}

TEST_CASE("what has no direction across the light corrects nothing, and is no NaN") {
    for (const auto& shape : {strand({1, 1, 1}), strand({1, 1, 1, 1, 1, 1, 1, 1, 1}),
                              strand({0, 0, 0, 0, 0, 3}), strand({1e18, 0, 0, 1e18, 0, 0})}) {
        const std::vector<Receiver> list = receivers_on(shape);
        check_finite(list);
        for (const Receiver& r : list) {
            CHECK(r.opacity == 0.f);
            CHECK(own_deposit(seen(r, plain_space()), 64, 64, plain_space().depth_range)
                      .optical_depth == 0.f);
        }
    }
    // Two points on one place: the others know.
    const std::vector<Receiver> list = receivers_on(strand({0, 0, 0, 0, 0, 0, 1, 0, 0}));
    check_finite(list);
    CHECK(list[0].opacity == 0.f);
    CHECK(list[1].direction == float3{1, 0, 0});
    CHECK(list[2].direction == float3{1, 0, 0});
}

TEST_CASE("receivers on a surface know its slope, whichever way it is wound") {
    const auto plane = [](double x, double y) { return 0.5 * x - 2.0 * y; };
    const std::vector<double> corners{0, 0, plane(0, 0), 1, 0, plane(1, 0),
                                      1, 1, plane(1, 1), 0, 1, plane(0, 1)};
    const std::vector<std::vector<std::uint32_t>> windings{{0, 1, 2, 0, 2, 3}, {2, 1, 0, 0, 2, 3}};
    for (const auto& triangles : windings) {
        const std::vector<Receiver> list =
            receivers_on(mesh(corners, triangles, {0.1f, 0.2f, 0.3f, 0.4f}));
        REQUIRE(list.size() == 4);
        for (std::size_t i = 0; i < 4; ++i) {
            CHECK(list[i].direction[0] == Approx(slope_per_texel(0.5)));
            CHECK(list[i].direction[1] == Approx(slope_per_texel(-2.0)));
            CHECK(list[i].width_texels == 0.f);
            CHECK(list[i].opacity == Approx(0.1 * double(i + 1)));
        }
    }
}

TEST_CASE("surfaces without a slope correct nothing, and are no NaN") {
    const std::vector<std::uint32_t> triangle{0, 1, 2};
    const std::vector<std::vector<double>> degenerate{
        {1, 1, 1, 1, 1, 1, 1, 1, 1},  // a point
        {0, 0, 0, 1, 1, 0, 2, 2, 0},  // a line
        {0, 0, 0, 1, 0, 0, 0, 0, 1},  // the light grazes it
        {0, 0, 0, 1e18, 0, 0, 0, 1e-18, 1e18}};
    for (const auto& corners : degenerate) {
        const std::vector<Receiver> list = receivers_on(mesh(corners, triangle));
        check_finite(list);
        for (const Receiver& r : list) CHECK(r.opacity == 0.f);
    }
    // A vertex of no triangle beside one.
    const std::vector<Receiver> list =
        receivers_on(mesh({0, 0, 0, 1, 0, 0, 0, 1, 0, 3, 3, 3}, triangle));
    check_finite(list);
    CHECK(list[0].opacity == 0.5f);
    CHECK(list[3].opacity == 0.f);
}

TEST_CASE("only who casts into the opacity maps has something to take out") {
    const std::vector<double> xyz{0, 0, 0, 1, 0, 0};
    const auto silent = strand(xyz);
    silent->set_casts(false);
    const auto opaque = mesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}, {1.f});
    for (const ShapePtr& shape :
         {ShapePtr{silent}, ShapePtr{opaque}, ShapePtr{strand(xyz, 0.1f, {0.f})}})
        for (const Receiver& r : receivers_on(shape)) CHECK(r.opacity == 0.f);
    for (const Receiver& r : receivers_on(strand(xyz), false)) CHECK(r.opacity == 0.f);
    const auto absent = strand(xyz);
    for (const Receiver& r : receivers_in(plain_space(), Query::at(*absent, Scene{}), true))
        CHECK(r.opacity == 0.f);

    Scene scene;
    scene.add(strand(xyz, 0.25f));
    const Query points = Query::at(Positions{std::vector<double>{0, 0, 0}}, scene);
    CHECK(points.strand_width == Approx(0.25));
    CHECK(receivers_in(plain_space(), points, true)[0].opacity == 0.f);
    CHECK_THROWS_AS(Query::at(Positions{std::vector<double>{NAN, 0, 0}}, scene), ParameterError);
}

TEST_CASE("copies in light space follow their shape and the light, and are else kept") {
    const auto hair = strand({0, 0, 0, 1, 0, 0, 1, 1, 1}, 0.25f, {0.5f});
    LightSpace space = plain_space();
    LightCasters casters;
    // Whether the copy was made again; either way it is what a new one would be.
    const float4* last = nullptr;
    const auto moves = [&] {
        LightCasters fresh;
        const LightCaster &kept = casters.caster(hair, space), &made = fresh.caster(hair, space);
        CHECK(kept.points == made.points);
        CHECK(kept.indices == made.indices);
        CHECK(kept.opacity == made.opacity);
        CHECK(kept.kind == CasterKind::strands);
        return std::exchange(last, kept.points.data()) != kept.points.data();
    };
    CHECK(moves());
    CHECK(casters.caster(hair, space).points[1] == float4{80, 64, 0.5f, 4});
    CHECK_FALSE(moves());
    hair->set_color({{1, 0, 0}});
    CHECK_FALSE(moves());
    hair->set_opacity({0.1f, 0.2f, 0.3f});
    CHECK_FALSE(moves());
    CHECK(casters.caster(hair, space).opacity_at(2) == 0.3f);
    hair->set_points(Positions{std::vector<double>{0, 0, 0, 2, 0, 0, 1, 1, 1}});
    CHECK(moves());
    hair->set_width({0.5f});
    CHECK(moves());
    CHECK(casters.caster(hair, space).points[0][3] == 8.f);
    double4x4 shifted = identity;
    shifted[3] = 1.0;
    hair->set_transform(shifted);
    CHECK(moves());
    space.from_world[3] += 1.0;
    CHECK(moves());
    CHECK_FALSE(moves());
    casters.collect();
    CHECK_FALSE(moves());
}
