#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "opacity/core/error.hpp"
#include "opacity/scene/camera.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/scene.hpp"
#include "opacity/scene/strands.hpp"
#include "scratch_folder.hpp"

using namespace opacity;
using doctest::Approx;

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float inf = std::numeric_limits<float>::infinity();

// Two strands of three points along x.
std::vector<float> strand_points() {
    return {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};
}
Strands two_strands() {
    return Strands{Positions{strand_points()}, {0, 3, 6}};
}

std::vector<double> square_points() {
    return {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
}
Mesh square(std::vector<float3> normals = {}) {
    return Mesh{Positions{square_points()}, {0, 1, 2, 0, 2, 3}, std::move(normals)};
}

template <class Call>
std::string refusal(Call&& call) {
    return message_of<ParameterError>(call);
}

double dot(const double3& a, const double3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

TEST_CASE("positions keep their type, and float64 survives an offset that float32 does not") {
    const std::vector<double> far{1e7 + 0.125, 0, 0, 1e7 + 0.25, 0, 0};
    const Positions points{far};
    const std::vector<float> w{3.f, 4.f};
    CHECK(points.relative_to({1e7, 0, 0}, w) ==
          std::vector<float>{0.125f, 0, 0, 3, 0.25f, 0, 0, 4});
    const std::vector<float> one{5.f};
    CHECK(points.relative_to({1e7, 0, 0}, one)[7] == 5.f);
    CHECK(std::holds_alternative<std::span<const double>>(points.xyz()));
    CHECK(points.bounds() == Box{{1e7 + 0.125, 0, 0}, {1e7 + 0.25, 0, 0}});
}

TEST_CASE("borrowed positions are the caller's numbers, and not a copy") {
    std::vector<float> xyz{1, 2, 3, 4, 5, 6};
    const Positions points = Positions::borrowed(std::span<const float>{xyz});
    CHECK(points.size() == 2);
    CHECK(points.bounds() == Box{{1, 2, 3}, {4, 5, 6}});
    xyz[3] = 7;
    CHECK(points[1] == double3{7, 5, 6});
}

TEST_CASE("segments join the points of one strand only") {
    const Strands strands{Positions{strand_points()}, {0, 3, 3, 4, 6}};
    CHECK(strands.strand_count() == 4);
    CHECK(strands.segments() == std::vector<std::uint32_t>{0, 1, 4});
}

TEST_CASE("bounds hold the ribbons' width, and follow the transform") {
    Strands strands{Positions{strand_points()}, {0, 6}, {0.f, 0.5f, 0.25f, 0, 0, 0}};
    CHECK(strands.local_bounds() == Box{{-0.25, -0.25, -0.25}, {2.25, 1.25, 0.25}});
    CHECK(strands.mean_width() == Approx(0.125));
    double4x4 move = identity;
    move[0] = move[5] = move[10] = 2.0;
    move[3] = 10.0;
    strands.set_transform(move);
    CHECK(strands.bounds() == Box{{9.5, -0.5, -0.5}, {14.5, 2.5, 0.5}});
    CHECK(strands.scale() == Approx(2.0));
}

TEST_CASE("a bad number is refused by index and value, and leaves the shape as it was") {
    Strands strands = two_strands();
    const auto before = strands.revisions();
    for (const float bad : {not_a_number, inf, -inf, 2e18f}) {
        auto xyz = strand_points();
        xyz[3 * 4 + 1] = bad;
        CHECK(contains(refusal([&] { strands.set_points(Positions{xyz}); }), "points[4]"));
        CHECK(contains(refusal([&] { Strands{Positions{xyz}, {0, 6}}; }), "points[4]"));
        CHECK(contains(refusal([&] {
                           strands.set_color({{1, 1, bad > 0 ? inf : bad}});
                       }),
                       "color[0]"));
    }
    for (const float bad : {not_a_number, inf, -inf, -0.1f, 1.5f, std::nextafter(1.f, 2.f)})
        CHECK(contains(refusal([&] {
                           strands.set_opacity({0, 1, 0, bad, bad, 0});
                       }),
                       "opacity[3]"));
    for (const float bad : {not_a_number, inf, -1e-9f})
        CHECK(contains(refusal([&] { strands.set_width({0, 1, bad, 0, 0, 0}); }), "width[2]"));
    CHECK(contains(refusal([&] { strands.set_opacity({0, 1, 1.5f, 0, 0, 0}); }), "1.5"));

    CHECK(strands.points().bounds() == two_strands().points().bounds());
    CHECK(strands.opacity() == std::vector<float>{0.3f});
    CHECK(strands.width() == std::vector<float>{0.1f});
    CHECK(strands.revisions().geometry == before.geometry);
    CHECK(strands.revisions().opacity == before.opacity);
    CHECK(strands.revisions().color == before.color);
}

TEST_CASE("attributes are one for all or one a point") {
    Strands strands = two_strands();
    const std::vector<float> five(5, 0.5f), six(6, 0.5f);
    CHECK(contains(refusal([&] { strands.set_opacity(five); }), "5 entries for 6 points"));
    CHECK(contains(refusal([&] { strands.set_width(five); }), "5 entries for 6 points"));
    CHECK(contains(refusal([&] { strands.set_color({}); }), "0 entries for 6 points"));
    CHECK(contains(refusal([&] { strands.set_points(Positions{std::vector<float>(9)}); }),
                   "3 points"));
    CHECK(contains(refusal([&] {
                       Strands{Positions{std::vector<float>(7)}, {0, 2}};
                   }),
                   "7 numbers"));
    CHECK_NOTHROW(strands.set_opacity(six));
    CHECK_NOTHROW(strands.set_width({0.f}));
}

TEST_CASE("offsets start at 0, never fall, and end at the number of points") {
    const auto make = [](std::vector<std::int64_t> offsets) {
        return refusal([&] { Strands{Positions{strand_points()}, offsets}; });
    };
    CHECK(contains(make({}), "empty"));
    CHECK(contains(make({1, 6}), "offsets[0] = 1"));
    CHECK(contains(make({0, 4, 3, 6}), "offsets[2] = 3"));
    CHECK(contains(make({0, -1, 6}), "offsets[1] = -1"));
    CHECK(contains(make({0, 5}), "ends at 5"));
    CHECK(contains(make({0, 3, std::numeric_limits<std::int64_t>::max()}), "ends at"));
    CHECK(make({0, 0, 6, 6}).empty());
}

TEST_CASE("an empty shape is a shape") {
    const Strands strands{Positions{}, {0}};
    CHECK(strands.strand_count() == 0);
    CHECK(strands.bounds().empty());
    const Mesh mesh{Positions{}, {}};
    CHECK(mesh.bounds().empty());
    CHECK(mesh.normals().empty());
    CHECK(contains(refusal([] { Mesh{Positions{}, {0, 0, 0}}; }), "triangles[0][0] = 0"));
    CHECK(contains(refusal([] { Strands{Positions{}, {0, 1}}; }), "ends at 1"));
}

TEST_CASE("each setter moves the revision of what it changes, and no other") {
    Mesh mesh = square();
    auto last = mesh.revisions();
    const auto moved = [&] {
        const auto now = mesh.revisions();
        const std::string parts = std::string{now.geometry != last.geometry ? "g" : ""} +
                                  (now.transform != last.transform ? "t" : "") +
                                  (now.opacity != last.opacity ? "o" : "") +
                                  (now.color != last.color ? "c" : "") +
                                  (now.flags != last.flags ? "f" : "");
        last = now;
        return parts;
    };
    double4x4 shifted = identity;
    shifted[3] = 1.0;
    mesh.set_points(Positions{square_points()});
    CHECK(moved() == "g");
    mesh.set_normals({4, float3{0, 0, -1}});
    CHECK(moved() == "g");
    mesh.set_opacity({0.5f});
    CHECK(moved() == "o");
    mesh.set_color({{0, 0, 0}});
    CHECK(moved() == "c");
    mesh.set_transform(shifted);
    CHECK(moved() == "t");
    mesh.set_transform(shifted);
    CHECK(moved() == "");
    mesh.set_casts(true);
    mesh.set_receives(true);
    CHECK(moved() == "");
    mesh.set_casts(false);
    CHECK(moved() == "f");
    mesh.set_receives(false);
    CHECK(moved() == "f");
}

TEST_CASE("a transform is affine, finite and invertible, whatever its units") {
    Strands strands = two_strands();
    const auto with = [&](std::size_t element, double value) {
        double4x4 m = identity;
        m[element] = value;
        return refusal([&] { strands.set_transform(m); });
    };
    CHECK(contains(with(6, not_a_number), "transform[1][2]"));
    CHECK(contains(with(3, inf), "transform[0][3]"));
    CHECK(contains(with(12, 1e-3), "last row"));
    CHECK(contains(with(15, 2.0), "last row"));
    CHECK(contains(with(5, 0.0), "invertible"));
    CHECK(strands.transform() == identity);
    double4x4 two_alike = identity;
    two_alike[4] = 1.0, two_alike[5] = 0.0;
    CHECK(contains(refusal([&] { strands.set_transform(two_alike); }), "invertible"));
    CHECK(with(0, 1e-9).empty());
    CHECK(with(0, -1.0).empty());
    CHECK(strands.scale() == Approx(1.0));
}

TEST_CASE("opaque means opacity 1 everywhere, and opacity 0 everywhere casts nothing") {
    Mesh mesh = square();
    CHECK(mesh.opaque());
    mesh.set_opacity({1, 1, 1, std::nextafter(1.f, 0.f)});
    CHECK(!mesh.opaque());
    CHECK(!mesh.invisible_to_light());
    mesh.set_opacity({0, 0, 0, 0});
    CHECK(mesh.invisible_to_light());
    Strands strands = two_strands();
    strands.set_opacity({1.f});
    CHECK(
        !strands
             .opaque());  // thinner than a texel they are translucent (accuracy: the deposit rule)
}

TEST_CASE("made normals weigh triangles by area, and follow the points") {
    // Around the corner at 0: a triangle of area 1/2 facing +z and one of area 2 facing +x.
    Mesh mesh{Positions{std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 2}},
              {0, 1, 2, 0, 3, 4}};
    const double length = std::hypot(1.0, 4.0);
    CHECK(mesh.normals()[0][0] == Approx(4.0 / length));
    CHECK(mesh.normals()[0][2] == Approx(1.0 / length));
    CHECK(mesh.normals()[1] == float3{0, 0, 1});
    CHECK(!mesh.own_normals());

    Mesh flat = square();
    flat.set_points(Positions{std::vector<double>{0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1}});
    for (const float3& n : flat.normals()) CHECK(n == float3{1, 0, 0});
}

TEST_CASE("made normals are of length 1 for degenerate triangles, lone points and huge offsets") {
    const Mesh mesh{Positions{std::vector<double>{0, 0, 0, 1, 0, 0, 2, 0, 0, 5, 5, 5}},
                    {0, 1, 2, 1, 1, 1}};
    for (const float3& n : mesh.normals()) CHECK(std::hypot(n[0], n[1], n[2]) == Approx(1.0));
    const double far = 1e9;
    const Mesh away{
        Positions{std::vector<double>{far, far, far, far + 1, far, far, far, far + 1, far}},
        {0, 1, 2}};
    CHECK(away.normals()[0] == float3{0, 0, 1});
}

TEST_CASE("own normals are kept, brought to length 1, and completed where they are zero") {
    Mesh mesh = square({{0, 0, 0}, {3, 0, 0}, {0, -1e-20f, 0}, {0, 0, -1}});
    CHECK(mesh.normals() == std::vector<float3>{{0, 0, 1}, {1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
    mesh.set_points(Positions{std::vector<double>{0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1}});
    CHECK(mesh.normals()[1] == float3{1, 0, 0});
    CHECK(mesh.normals()[3] == float3{0, 0, -1});
    CHECK(contains(refusal([&] { mesh.set_normals({{0, 0, 1}}); }), "1 entries for 4 points"));
    CHECK(contains(refusal([&] {
                       mesh.set_normals({4, float3{0, not_a_number, 1}});
                   }),
                   "normals[0]"));
    CHECK(mesh.own_normals());
    mesh.set_normals({});
    CHECK(!mesh.own_normals());
    CHECK(mesh.normals()[3] == float3{1, 0, 0});
}

TEST_CASE("triangles name points that exist") {
    const auto make = [](std::vector<std::uint32_t> triangles) {
        return refusal([&] { Mesh{Positions{square_points()}, triangles}; });
    };
    CHECK(contains(make({0, 1}), "2 indices"));
    CHECK(contains(make({0, 1, 2, 0, 4, 3}), "triangles[1][1] = 4"));
    CHECK(make({3, 3, 3}).empty());
}

TEST_CASE("a light's direction has length 1, whatever was given") {
    for (const double size : {1e-300, 1e-3, 1.0, 1e17}) {
        const DirectionalLight light{{3 * size, 0, -4 * size}};
        CHECK(light.direction()[0] == Approx(0.6));
        CHECK(light.direction()[2] == Approx(-0.8));
    }
    DirectionalLight light;
    const double3 before = light.direction();
    CHECK(contains(refusal([&] { light.set_direction({0, 0, 0}); }), "(0, 0, 0)"));
    CHECK(contains(refusal([&] { light.set_direction({0, not_a_number, 0}); }), "direction.y"));
    CHECK(contains(refusal([&] { light.set_color({0, 0, -1}); }), "color[2]"));
    CHECK(contains(refusal([&] { light.set_intensity(inf); }), "intensity"));
    CHECK(light.direction() == before);
    CHECK(light.intensity() == 1.f);
}

TEST_CASE("colours and intensities stay where their products are finite") {
    DirectionalLight light;
    Strands strands = two_strands();
    const float most = 1e9f, more = std::nextafter(most, inf);
    CHECK(contains(refusal([&] { light.set_color({0, more, 0}); }), "color[1]"));
    CHECK(contains(refusal([&] { light.set_intensity(more); }), "is not in 0..1e9"));
    CHECK(contains(refusal([&] { light.set_intensity(-0.1f); }), "intensity = -0.1 is not"));
    CHECK(contains(refusal([&] { strands.set_color({{0, 0, more}}); }), "in 0..1e9"));
    CHECK(contains(refusal([&] {
                       Mesh{Positions{square_points()}, {}, {}, {1.f}, {{more, 0, 0}}};
                   }),
                   "color[0]"));
    CHECK_NOTHROW(light.set_color({most, most, most}));
    CHECK_NOTHROW(light.set_intensity(most));
    CHECK_NOTHROW(strands.set_color({{most, most, most}}));
}

TEST_CASE("a scene holds each shape and light once") {
    Scene scene;
    const auto shape =
        std::make_shared<Strands>(Positions{strand_points()}, std::vector<std::int64_t>{0, 6});
    const auto light = std::make_shared<DirectionalLight>();
    CHECK(scene.bounds().empty());
    scene.add(shape);
    scene.add(light);
    CHECK(contains(refusal([&] { scene.add(shape); }), "already"));
    CHECK(contains(refusal([&] { scene.add(light); }), "already"));
    CHECK(contains(refusal([&] { scene.add(ShapePtr{}); }), "null"));
    CHECK(scene.bounds() == shape->bounds());
    scene.remove(shape);
    scene.remove(light);
    CHECK(scene.shapes().empty());
    CHECK(contains(refusal([&] { scene.remove(shape); }), "not in the scene"));
    CHECK(contains(refusal([&] { scene.remove(light); }), "not in the scene"));
}

TEST_CASE("the view has the eye at 0 and the target straight ahead, and keeps lengths") {
    const Camera camera = Camera::look_at({1, 2, 3}, {4, -1, 5}, {0, 0, 1});
    const double4x4 view = camera.view_from_world();
    const double3 eye = transform_point(view, camera.eye());
    const double3 target = transform_point(view, camera.target());
    const double3 above = transform_point(view, {1, 2, 4});
    for (const double c : eye) CHECK(c == Approx(0.0));
    CHECK(target[0] == Approx(0.0));
    CHECK(target[1] == Approx(0.0));
    CHECK(target[2] == Approx(-std::hypot(3, 3, 2)));
    CHECK(above[0] == Approx(0.0));
    CHECK(above[1] > 0.0);
    CHECK(std::sqrt(dot(above, above)) == Approx(1.0));
}

TEST_CASE("a camera that sees nothing is refused") {
    CHECK(contains(refusal([] { Camera::look_at({1, 1, 1}, {1, 1, 1}); }), "one point"));
    CHECK(contains(refusal([] { Camera::look_at({0, 0, 5}, {0, 0, 0}, {0, 0, 2}); }), "parallel"));
    CHECK(contains(refusal([] { Camera::look_at({0, 1, 5}, {0, 0, 0}, {0, 0, 0}); }), "zero"));
    CHECK(contains(refusal([] { Camera::look_at({0, not_a_number, 5}, {0, 0, 0}); }), "eye.y"));
    for (const double fov : {0.5, 171.0, double(not_a_number)})
        CHECK(contains(refusal([&] {
                           Camera::look_at({0, 1, 0}, {0, 0, 0}, {0, 0, 1}, fov);
                       }),
                       "fov_deg"));
    CHECK(contains(refusal([] { Camera::fit(Scene{}, {0, 0, 0}); }), "direction"));
}

TEST_CASE("fit sees the whole of the bounds, and little more") {
    const Box boxes[] = {{{-1, -2, -3}, {4, 5, 6}},
                         {{1e6, 1e6, 1e6}, {1e6 + 1, 1e6 + 1, 1e6 + 1}},
                         {{-1e-3, -1e-3, -1e-3}, {1e-3, 1e-3, 1e-3}}};
    for (const Box& box : boxes)
        for (const double fov : {1.0, 35.0, 90.0, 170.0}) {
            const Camera camera = Camera::fit(box, {0.3, 1.0, -0.25}, {0, 0, 1}, fov);
            // The tangent of the widest angle under which a corner is seen, over that of the field
            // of view.
            double widest = 0.0;
            for (int corner = 0; corner < 8; ++corner) {
                const double3 p = transform_point(
                    camera.view_from_world(),
                    {corner & 1 ? box.max[0] : box.min[0], corner & 2 ? box.max[1] : box.min[1],
                     corner & 4 ? box.max[2] : box.min[2]});
                REQUIRE(p[2] < 0.0);
                widest = std::max({widest, std::abs(p[0] / p[2]), std::abs(p[1] / p[2])});
            }
            const double used = widest / std::tan(0.5 * fov * std::numbers::pi / 180.0);
            CHECK(used < 1.0);
            if (fov < 100.0) CHECK(used > 0.85);  // wider, the margin is most of it
        }
}

TEST_CASE("fit gives a usable camera for nothing and for a single point") {
    CHECK(Camera::fit(Scene{}).target() == double3{0, 0, 0});
    for (const double at : {0.0, 1e7, 1e17}) {
        const Box point{{at, at, at}, {at, at, at}};
        const Camera camera = Camera::fit(point, {0, 1, 0}, {0, 0, 1}, 35.0);
        for (const double element : camera.view_from_world()) CHECK(std::isfinite(element));
        CHECK(camera.eye() != camera.target());
    }
}
