#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "opacity/core/error.hpp"
#include "opacity/io/load.hpp"
#include "scratch_folder.hpp"
#include "shape_hash.hpp"

using namespace opacity;
using doctest::Approx;

namespace {

std::shared_ptr<Strands> strands_of(const std::vector<ShapePtr>& shapes) {
    REQUIRE(!shapes.empty());
    auto strands = std::dynamic_pointer_cast<Strands>(shapes[0]);
    REQUIRE(strands);
    return strands;
}

std::uint64_t hash(const std::vector<ShapePtr>& shapes) {
    return ShapeHash{}.of(shapes);
}

// 1 inside a closed mesh and 0 outside (van Oosterom and Strackee's solid angle).
double winding_number(const Mesh& mesh, const double3& p) {
    double sum = 0.0;
    const auto& indices = mesh.triangles();
    for (std::size_t t = 0; t < indices.size(); t += 3) {
        double3 v[3];
        double length[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const double3 q = mesh.points()[indices[t + k]];
            v[k] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
            length[k] = std::hypot(v[k][0], v[k][1], v[k][2]);
        }
        const auto dot = [&](int a, int b) {
            return v[a][0] * v[b][0] + v[a][1] * v[b][1] + v[a][2] * v[b][2];
        };
        const double volume = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) +
                              v[0][1] * (v[1][2] * v[2][0] - v[1][0] * v[2][2]) +
                              v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
        sum += 2.0 * std::atan2(volume, length[0] * length[1] * length[2] + dot(0, 1) * length[2] +
                                            dot(1, 2) * length[0] + dot(2, 0) * length[1]);
    }
    return sum / (4.0 * std::numbers::pi);
}

}  // namespace

TEST_CASE("the demo is the same for the same seed, and has the segments asked for") {
    CHECK(hash(demo_hair(1500, 7)) == hash(demo_hair(1500, 7)));
    CHECK(hash(demo_hair(1500, 7)) != hash(demo_hair(1500, 8)));
    for (const std::size_t segments : {1, 14, 15, 16, 1000, 30'000})
        CHECK(strands_of(demo_hair(segments))->segments().size() == segments);
    CHECK(hash(load("demo:hair?segments=1500&seed=7")) == hash(demo_hair(1500, 7)));
    CHECK(strands_of(load("demo:hair"))->segments().size() == 150'000);
    // More hair is more of the same: the first strands stay.
    const auto few = strands_of(demo_hair(150)), many = strands_of(demo_hair(1500));
    for (std::size_t i = 0; i < few->points().size(); ++i)
        CHECK(few->points()[i] == many->points()[i]);
}

TEST_CASE("the demo is hair, outside a head, above a ground that casts nothing") {
    const auto shapes = demo_hair(30'000, 3);
    REQUIRE(shapes.size() == 3);
    const auto hair = strands_of(shapes);
    const auto head = std::dynamic_pointer_cast<Mesh>(shapes[1]);
    const auto ground = std::dynamic_pointer_cast<Mesh>(shapes[2]);
    REQUIRE((head && ground));
    CHECK(head->opaque());
    CHECK(head->casts());
    CHECK(ground->opaque());
    CHECK(!ground->casts());
    CHECK(ground->receives());
    CHECK(ground->bounds().max[2] < hair->points().bounds().min[2]);
    CHECK(ground->bounds().max[2] <= head->bounds().min[2]);
    CHECK(winding_number(*head, {0, 0, 32}) == Approx(1.0));
    double deepest = 0.0;
    for (std::size_t i = 0; i < hair->points().size(); i += 53)
        deepest = std::max(deepest, winding_number(*head, hair->points()[i]));
    CHECK(deepest < 0.5);
    for (const float width : hair->width()) CHECK(width > 0.f);
}

TEST_CASE("a demo that does not exist is refused with what does") {
    const auto refused = [](const std::string& name) {
        return message_of<ParameterError>([&] { load(name); });
    };
    CHECK(contains(refused("demo:hare"), "\"hair\""));
    CHECK(contains(refused("demo:"), "hair"));
    CHECK(contains(refused("demo:hair?segment=5"), "\"segments\""));
    CHECK(contains(refused("demo:hair?=5"), "segments, seed"));
    for (const char* bad :
         {"", "x", "-1", "0", "1.5", "1e3", "100000001", "99999999999999999999", "5 "})
        CHECK(contains(refused(std::string{"demo:hair?segments="} + bad), "1..100000000"));
    CHECK(contains(refused("demo:hair?segments"), "1..100000000"));
    CHECK(contains(refused("demo:hair?seed=4294967296"), "4294967295"));
    CHECK(!message_of<ParameterError>([] { demo_hair(0); }).empty());
}
