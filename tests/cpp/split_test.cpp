#include <doctest/doctest.h>

#include <cmath>

#include "opacity/core/split.hpp"

using namespace opacity;

TEST_CASE("the split curve runs from 0 to 1, rises strictly, and its inverse inverts it") {
    for (int tenth = 0; tenth <= 10; ++tenth) {
        const double ratio = 0.1 * tenth;
        CHECK(split_curve(0.0, ratio) == 0.0);
        CHECK(split_curve(1.0, ratio) == doctest::Approx(1.0).epsilon(1e-12));
        double last = -1.0;
        for (int i = 0; i <= 1000; ++i) {
            const double x = i / 1000.0, y = split_curve(x, ratio);
            REQUIRE(y > last);
            last = y;
            REQUIRE(std::abs(split_inverse(y, ratio) - x) < 1e-12);
        }
    }
}

TEST_CASE("linear planes are even; logarithmic ones match 2^(8 k / K)") {
    for (int layers : {1, 2, 3, 16, 64}) {
        const std::vector<float> linear = layer_planes(layers, 0.0),
                                 log = layer_planes(layers, 1.0);
        for (int k = 0; k <= layers; ++k) {
            CHECK(linear[k] == doctest::Approx(double(k) / layers).epsilon(1e-6));
            // log2(1 + 255 x) / 8 = k / K solved for x
            CHECK(log[k] ==
                  doctest::Approx((std::exp2(8.0 * k / layers) - 1.0) / 255.0).epsilon(1e-5));
        }
    }
}

TEST_CASE("planes are strictly increasing floats from 0 to 1 for every K and ratio") {
    for (int layers = 1; layers <= 64; ++layers)
        for (double ratio : {0.0, 0.3, 1.0}) {
            const std::vector<float> planes = layer_planes(layers, ratio);
            REQUIRE(planes.size() == std::size_t(layers) + 1);
            REQUIRE(planes.front() == 0.f);
            REQUIRE(planes.back() == 1.f);
            for (int k = 0; k < layers; ++k) REQUIRE(planes[k] < planes[k + 1]);
        }
}

namespace {

// One texel whose optical depth in front of x is given.
template <class Curve>
std::vector<float> profile(const std::vector<float>& planes, Curve curve) {
    std::vector<float> values;
    for (std::size_t k = 1; k < planes.size(); ++k)
        values.push_back(float(curve(double(planes[k]))));
    return values;
}

}  // namespace

TEST_CASE("the search finds linear planes for even casters, planes near the light for dense ones") {
    const std::vector<float> planes = layer_planes(64, 0.5);
    const std::vector<float> sparse = profile(planes, [](double x) { return 0.5 * x; });
    CHECK(split_error({planes, sparse}, 8, 0.0) < 1e-4);  // layers follow a line
    CHECK(find_split_ratio({planes, sparse}, 8) == 0.0);

    const std::vector<float> dense =
        profile(planes, [](double x) { return 20.0 * std::log1p(50.0 * x); });
    CHECK(find_split_ratio({planes, dense}, 8) >= 0.5);
}

TEST_CASE("more layers rebuild a profile better, and the found ratio is the best of the eleven") {
    const std::vector<float> planes = layer_planes(64, 0.5);
    const std::vector<float> values =
        profile(planes, [](double x) { return 6.0 * x * x + 3.0 * std::sqrt(x); });
    const OpticalDepthProfiles profiles{planes, values};
    CHECK(split_error(profiles, 32, 0.5) < split_error(profiles, 8, 0.5));
    CHECK(split_error(profiles, 8, 0.5) < split_error(profiles, 2, 0.5));
    const double found = find_split_ratio(profiles, 8);
    for (int tenth = 0; tenth <= 10; ++tenth)
        CHECK(split_error(profiles, 8, found) <= split_error(profiles, 8, 0.1 * tenth));
}

TEST_CASE("a receiver does not count its own fragment") {
    // Single fragments, far apart: layers as fine as the profile's own cells place each one
    // exactly, but for the ramp on which it lies.
    const std::vector<float> planes = layer_planes(64, 0.0);
    const std::vector<float> steps =
        profile(planes, [](double x) { return 0.1 * std::floor(8.0 * x); });
    CHECK(split_error({planes, steps}, 64, 0.0) < 0.051);  // half a fragment on its own ramp
    CHECK(split_error({planes, steps}, 8, 0.0) < 0.11);
}

TEST_CASE("no covered texel is no error, and no NaN") {
    const std::vector<float> planes = layer_planes(64, 0.5);
    CHECK(split_error({planes, {}}, 8, 0.5) == 0.0);
    CHECK(find_split_ratio({planes, {}}, 8) == 0.0);
}
