// The faces of a light at a place: every caster lies in one, at its distance, wherever the light
// is.
#include "scene/positional_fit.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "core/vector.hpp"
#include "map/face.hpp"
#include "opacity/scene/strands.hpp"

using namespace opacity;
using doctest::Approx;

namespace {

std::vector<double> scattered(double3 center, double size, int points = 40) {
    std::mt19937 engine{3};
    std::vector<double> xyz;
    for (int i = 0; i < points; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            xyz.push_back(center[axis] + size * (2.0 * double(engine()) / 4294967295.0 - 1.0));
    return xyz;
}

ShapePtr tuft(const std::vector<double>& xyz, float width = 1e-6f) {
    const auto count = std::int64_t(xyz.size() / 3);
    return std::make_shared<Strands>(Positions{xyz}, std::vector<std::int64_t>{0, count},
                                     std::vector{width});
}

LightSpace fitted(const PositionalLight& light, const ShapePtr& shape, int size_px = 256) {
    Scene scene;
    scene.add(shape);
    PositionalFit fit;
    return fit.fit(
        scene, light, [=](double) { return size_px; }, Box{});
}

// In float64: the place, of one eye, that a world point has; and in float32, as the map has it.
struct Place {
    int face = 0;
    double3 exact{};
    float3 found{};
};
Place place_of(const LightSpace& space, const double3& point, int eye = 0) {
    const double3 q = transform_point(space.from_world, point);
    const float3 q32{float(q[0]), float(q[1]), float(q[2])};
    const MapFaces faces{space};
    Place place{.face = faces.face_of(eye, q32)};
    const LightFace& face = space.faces[std::size_t(place.face)];
    const double3 r = face.seen(q);
    place.exact = {face.focal_px * r[0] / r[2] + face.middle_px[0],
                   face.focal_px * r[1] / r[2] + face.middle_px[1],
                   length(r) - length(face.offset) + face.depth_of_origin};
    place.found = faces[place.face].place(q32);
    return place;
}

}  // namespace

TEST_CASE("every caster lies on a face of each point of a light, at its distance") {
    const std::vector<double> xyz = scattered({1, 2, 3}, 1.0);
    const PointLight outside{{1, 2, 13}}, inside{{1, 2, 3}}, at_vertex{{xyz[0], xyz[1], xyz[2]}};
    const SpotLight spot{{1, 2, 13}, {0, 0, -1}, 60.0}, wide{{1, 2, 4.2}, {0, 0, -1}, 170.0};
    const AreaLight area{{1, 2, 9}, {2, 0, 0}, {0, 2, 0}, 2};
    for (const PositionalLight* light : std::initializer_list<const PositionalLight*>{
             &outside, &inside, &at_vertex, &spot, &wide, &area}) {
        CAPTURE(light->kind());
        const LightSpace space = fitted(*light, tuft(xyz));
        const std::vector<double3> eyes = light_points(*light);
        CHECK(space.eye_count() == int(eyes.size()));
        double first = 1e9, last = -1e9;
        for (int eye = 0; eye < space.eye_count(); ++eye)
            for (std::size_t i = 0; i < xyz.size(); i += 3) {
                const double3 point{xyz[i], xyz[i + 1], xyz[i + 2]};
                const double distance = length(minus(point, eyes[std::size_t(eye)]));
                if (distance < 1e-3) continue;  // nothing is seen from itself
                const Place place = place_of(space, point, eye);
                for (std::size_t axis = 0; axis < 2; ++axis) {
                    CHECK(place.exact[axis] >= 0.0);
                    CHECK(place.exact[axis] <= space.map_size_px);
                    CHECK(double(place.found[axis]) == Approx(place.exact[axis]).epsilon(1e-4));
                }
                CHECK(std::abs(double(place.found[2]) - place.exact[2]) < 1e-5);
                first = std::min(first, place.exact[2]);
                last = std::max(last, place.exact[2]);
            }
        CHECK(first >= -1e-9);
        CHECK(last <= 1.0 + 1e-9);
    }
}

TEST_CASE("one face does where the casters lie before the light, six where around it") {
    const auto casters = tuft(scattered({0, 0, 0}, 1.0));
    CHECK(fitted(PointLight{{0, 0, 5}}, casters).face_count() == 1);
    CHECK(fitted(PointLight{{0, 0, 0}}, casters).face_count() == 6);
    CHECK(fitted(AreaLight{{0, 0, 5}, {1, 0, 0}, {0, 1, 0}, 3}, casters).face_count() == 9);
    CHECK(fitted(SpotLight{{0, 0, 0}, {0, 0, -1}, 90.0}, casters).face_count() == 1);
    const LightSpace cube = fitted(PointLight{{0, 0, 0}}, casters);
    CHECK(cube.width_px() == 3 * cube.map_size_px);
    CHECK(cube.height_px() == 2 * cube.map_size_px);
}

TEST_CASE("a light far away keeps its digits") {
    const std::vector<double> xyz = scattered({0, 0, 0}, 1.0);
    for (const double far : {1e2, 1e4, 1e6}) {
        const LightSpace space = fitted(PointLight{{0.3 * far, 0.2 * far, far}}, tuft(xyz));
        for (std::size_t i = 0; i < xyz.size(); i += 3) {
            const Place place = place_of(space, {xyz[i], xyz[i + 1], xyz[i + 2]});
            for (std::size_t axis = 0; axis < 2; ++axis)
                CHECK(std::abs(double(place.found[axis]) - place.exact[axis]) < 1e-2);
            CHECK(std::abs(double(place.found[2]) - place.exact[2]) < 1e-3);
        }
    }
}

TEST_CASE("a face's derivative is the limit of its differences") {
    const LightSpace space = fitted(PointLight{{0.4, 3.0, 0.1}}, tuft(scattered({0, 0, 0}, 1.0)));
    const MapFace face{space, 0};
    const float3 q{0.05f, -0.08f, 0.1f};
    for (const float3& dq : {float3{1, 0, 0}, float3{0, 1, 0}, float3{0.3f, -0.5f, 0.7f}}) {
        const float step = 1e-3f;
        const float3 change = face.place_change(q, dq);
        const float3 difference =
            minus(face.place(plus(q, scaled(dq, step))), face.place(plus(q, scaled(dq, -step))));
        for (std::size_t axis = 0; axis < 3; ++axis)
            CHECK(double(difference[axis]) / (2.0 * step) ==
                  Approx(double(change[axis])).epsilon(0.01));
    }
}

TEST_CASE("a light that moves a little keeps its window and its aim") {
    const auto casters = tuft(scattered({0, 0, 0}, 1.0));
    Scene scene;
    scene.add(casters);
    PositionalFit fit;
    const auto space_at = [&](double x) {
        return fit.fit(
            scene, PointLight{{x, 0, 5}}, [](double) { return 256; }, Box{});
    };
    const LightSpace first = space_at(0.0), moved = space_at(0.01);
    CHECK(moved.faces[0].axes == first.faces[0].axes);
    CHECK(moved.faces[0].focal_px == Approx(first.faces[0].focal_px));
    CHECK(space_at(3.0).faces[0].axes != first.faces[0].axes);
}
