// The maps of the parts of a camera's view: what receives there lies in them, their texels stay on
// one grid, and they stay while they hold what they should.
#include "scene/split_fit.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "opacity/scene/mesh.hpp"
#include "scene/light_fit.hpp"

using namespace opacity;
using doctest::Approx;

namespace {

constexpr int map_size_px = 256;
constexpr ViewSplits four{4, 0.5};

std::shared_ptr<Mesh> plate(double x, double y, double half, double z) {
    return std::make_shared<Mesh>(
        Positions{std::vector<double>{x - half, y - half, z, x + half, y - half, z, x + half,
                                      y + half, z, x - half, y + half, z}},
        std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
}

// A ground of 200 x 200 that casts, too.
std::shared_ptr<Scene> ground() {
    auto scene = std::make_shared<Scene>();
    scene->add(plate(0, 0, 100, 0));
    return scene;
}

LightSpace whole_map(const Scene& scene) {
    LightFit fit;
    return fit.fit(scene, DirectionalLight{{0.3, 0.2, -1.0}}, [](double) { return map_size_px; },
                   {});
}

Camera from(double3 eye) {
    return Camera::look_at(eye, {eye[0], eye[1] + 10.0, 0.0});
}

bool is_in(const LightSplit& split, const double3& q) {
    const double3 p = split.place(q);
    return p[0] > 1.5 && p[1] > 1.5 && p[0] < map_size_px - 1.5 && p[1] < map_size_px - 1.5;
}

// Of the ground, where the camera sees it.
template <class Visit>
void for_each_seen(const Camera& camera, double aspect, Visit visit) {
    const double tangent = std::tan(camera.fov_deg() * 3.14159265358979 / 360.0);
    for (double x = -99.5; x < 100.0; x += 1.0)
        for (double y = -99.5; y < 100.0; y += 1.0) {
            const double3 seen = transform_point(camera.view_from_world(), {x, y, 0.0});
            if (seen[2] < 0.0 && std::abs(seen[1]) < -seen[2] * tangent &&
                std::abs(seen[0]) < -seen[2] * tangent * aspect)
                visit(double3{x, y, 0.0}, -seen[2]);
        }
}

}  // namespace

TEST_CASE("split fit: all that the camera sees of a receiver lies in a split, finer nearby") {
    const auto scene = ground();
    const LightSpace whole = whole_map(*scene);
    for (const double3& eye : {double3{0, -60, 4}, double3{30, -10, 2}, double3{-80, 20, 30}})
        for (const double aspect : {0.5, 1.0, 2.0}) {
            const Camera camera = from(eye);
            SplitFit fit;
            const auto splits = fit.fit(whole, *scene, {camera, aspect}, four);
            REQUIRE(splits.size() == 5);
            CHECK(splits[0] == LightSplit{});
            double nearest = 1e9, farthest = 0.0;
            for_each_seen(camera, aspect, [&](const double3&, double distance) {
                nearest = std::min(nearest, distance), farthest = std::max(farthest, distance);
            });
            const std::vector<double> cuts = view_cuts(nearest, farthest, four);
            for_each_seen(camera, aspect, [&](const double3& p, double distance) {
                const double3 q = transform_point(whole.from_world, p);
                for (std::size_t i = 1; i < splits.size(); ++i)
                    if (distance > 1.1 * cuts[i - 1] && distance < 0.9 * cuts[i] &&
                        splits[i].scale > 1.0)  // else the whole map is as fine
                        CHECK(is_in(splits[i], q));
            });
            CHECK(splits[1].scale > 4.0);
            CHECK(splits[1].scale >= splits[3].scale);
        }
}

TEST_CASE("split fit: texels lie on one grid, and stay while the camera moves a little") {
    const auto scene = ground();
    const LightSpace whole = whole_map(*scene);
    SplitFit fit;
    std::vector<LightSplit> before = fit.fit(whole, *scene, {from({0, -60, 4}), 1.5}, four);
    const double texel = 1.0 / (whole.texels_per_unit * before[1].scale);
    CHECK(fit.fit(whole, *scene, {from({0.9 * texel, -60, 4}), 1.5}, four) == before);
    for (int step = 0; step < 50; ++step) {
        before = fit.fit(whole, *scene, {from({0.0, -60.0 + step, 4}), 1.5}, four);
        for (const LightSplit& split : before) {
            for (const double offset : split.offset_px) CHECK(offset == std::round(offset));
            const double steps = 4.0 * std::log2(split.scale);
            CHECK(steps == Approx(std::round(steps)).epsilon(1e-6));
            CHECK(split.scale <= 131072.0 / map_size_px);
        }
    }
}

TEST_CASE("split fit: none without a view, for a light at a place, or where nothing is seen") {
    const auto scene = ground();
    const LightSpace whole = whole_map(*scene);
    const Camera camera = from({0, -60, 4});
    SplitFit fit;
    CHECK(fit.fit(whole, *scene, {camera, 1.0}, {1, 0.5}).empty());
    LightSpace faces = whole;
    faces.faces.emplace_back();
    CHECK(fit.fit(faces, *scene, {camera, 1.0}, four).empty());
    LightSpace tiny = whole;
    tiny.map_size_px = 8;
    CHECK(fit.fit(tiny, *scene, {camera, 1.0}, four).empty());
    LightSpace large = whole;
    large.map_size_px = 5461;
    CHECK(fit.fit(large, *scene, {camera, 1.0}, four).size() == 5);
    large.map_size_px = 5462;  // three side by side
    CHECK(fit.fit(large, *scene, {camera, 1.0}, four).empty());
    const Camera up = Camera::look_at({0, 0, 4}, {0, 10, 40});
    const auto empty = fit.fit(whole, *scene, {up, 1.0}, four);
    REQUIRE(empty.size() == 5);
    for (std::size_t i = 1; i < empty.size(); ++i)
        for (const double q : {0.0, 3.0, 128.0, 253.0, 256.0}) CHECK(!is_in(empty[i], {q, q, 0.5}));
}

TEST_CASE("view frustum: what it has in common with a box that holds it, and with one inside") {
    const Camera camera = Camera::look_at({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 90.0);
    const Hexahedron frustum = frustum_of({camera, 1.0}, 1.0, 3.0);
    const auto bounds = [](const std::vector<double3>& points) {
        Box box;
        for (const double3& p : points) box.extend(p);
        return box;
    };
    const auto check = [&](const Box& with, const Box& expected) {
        const Box common = bounds(common_corners(frustum, corners_of(with)));
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(common.min[i] == Approx(expected.min[i]));
            CHECK(common.max[i] == Approx(expected.max[i]));
        }
    };
    check({{-9, -9, -9}, {9, 9, 9}}, {{-3, 1, -3}, {3, 3, 3}});
    const Box inside{{-0.5, 1.5, -0.25}, {0.5, 2.0, 0.75}};
    check(inside, inside);
    // It enters through a side, where neither has a corner.
    check({{-9, 1.5, -0.1}, {9, 2.0, 0.1}}, {{-2, 1.5, -0.1}, {2, 2, 0.1}});
    CHECK(common_corners(frustum, corners_of({{4, 0, 0}, {5, 3, 1}})).empty());
}
