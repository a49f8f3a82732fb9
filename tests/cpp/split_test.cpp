#include <doctest/doctest.h>

#include <cmath>
#include <set>

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

TEST_CASE("linear planes are even, and logarithmic ones match 2^(8 k / K)") {
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

TEST_CASE("the thesis's table gives half of a logarithmic range to the last layer") {
    for (int layers : {2, 4, 8, 16, 32, 64})
        CHECK(layer_planes(layers, 1.0, true)[std::size_t(layers) - 1] == 0.5f);
    // Of 32 layers it names 26; the others are empty.
    const std::vector<float> planes = layer_planes(32, 1.0, true);
    CHECK(std::set<float>(planes.begin(), planes.end() - 1).size() == 26);
}

TEST_CASE("the thesis's table of a linear split is even in 256ths, but for its last layer") {
    for (int layers : {2, 4, 16, 64}) {
        const std::vector<float> planes = layer_planes(layers, 0.0, true);
        for (int k = 0; k < layers; ++k)
            CHECK(std::abs(planes[std::size_t(k)] - double(k) / (layers - 1)) <= 1.0 / 128);
        CHECK(planes[std::size_t(layers) - 1] == 255.f / 256.f);
        CHECK(planes.back() == 1.f);
    }
}

TEST_CASE("planes of the thesis's table never fall, and stand on 256ths") {
    for (int layers = 1; layers <= 64; ++layers)
        for (int tenth = 0; tenth <= 10; ++tenth) {
            const std::vector<float> planes = layer_planes(layers, 0.1 * tenth, true);
            REQUIRE(planes.size() == std::size_t(layers) + 1);
            REQUIRE(planes.front() == 0.f);
            REQUIRE(planes.back() == 1.f);
            for (std::size_t k = 0; k + 1 < planes.size(); ++k) {
                REQUIRE(planes[k] <= planes[k + 1]);
                REQUIRE(256.f * planes[k] == std::floor(256.f * planes[k]));
            }
            REQUIRE((layers == 1 || planes[planes.size() - 2] < 1.f));
        }
}
