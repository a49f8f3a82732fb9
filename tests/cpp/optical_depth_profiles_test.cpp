// What fine profiles tell of the fragments in their cells.
#include "opacity/core/optical_depth_profiles.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "opacity/core/split.hpp"
#include "opacity/core/split_error.hpp"

using namespace opacity;
using doctest::Approx;

namespace {

const std::vector<float> fine_planes = layer_planes(64, 0.45);

// A medium whose extinction is 2 x: optical depth x^2, of which 2/3 x^3 is the moment.
std::vector<float> wedge() {
    std::vector<float> values;
    for (std::size_t k = 1; k < fine_planes.size(); ++k)
        values.push_back(fine_planes[k] * fine_planes[k]);
    return values;
}

// One texel with fragments in these cells.
std::vector<float> fragments(const std::vector<std::pair<std::size_t, float>>& cells) {
    std::vector<float> values(64, 0.f);
    for (const auto& [cell, optical_depth] : cells)
        for (std::size_t k = cell; k < 64; ++k) values[k] += optical_depth;
    return values;
}

}  // namespace

TEST_CASE("moments at other planes are the integral of position over optical depth") {
    const std::vector<float> values = wedge();
    const FineProfiles fine{{fine_planes, values}};
    for (const double ratio : {0.0, 0.3, 1.0}) {
        const std::vector<float> planes = layer_planes(8, ratio);
        const std::vector<float> moments = fine.rebinned_moments(planes);
        REQUIRE(moments.size() == 8);
        for (std::size_t k = 1; k <= 8; ++k) {
            const double x = double(planes[k]);
            CHECK(moments[k - 1] == Approx(2.0 / 3.0 * x * x * x).epsilon(2e-3));
        }
    }
}

TEST_CASE("the first fragment lies at 0 and the last at 1, so that moments count that alone") {
    const std::vector<float> values = fragments({{0, 0.5f}, {63, 0.25f}});
    const FineProfiles fine{{fine_planes, values}};
    const std::vector<float> moments = fine.rebinned_moments(layer_planes(4, 0.5));
    CHECK(moments[0] == 0.f);
    CHECK(moments[2] == 0.f);
    CHECK(moments[3] == 0.25f);
}

TEST_CASE("a fragment more opaque than most is one where so many cells are empty") {
    std::vector<float> values = fragments({{0, 1.f}, {20, 1.f}, {40, 5.f}, {63, 1.f}});
    const FineProfiles sparse{{fine_planes, values}};
    CHECK(sparse.fragment_of(std::span{values}, 5.0) == 5.0);

    // Every other cell: chance puts several in one.
    std::vector<std::pair<std::size_t, float>> cells;
    for (std::size_t cell = 0; cell < 64; cell += 2) cells.emplace_back(cell, 1.f);
    cells[9].second = 3.f;
    values = fragments(cells);
    const FineProfiles dense{{fine_planes, values}};
    CHECK(dense.fragment_of(std::span{values}, 3.0) == 1.0);
}

TEST_CASE("layers that know their mean position lose nothing of a fragment each") {
    const std::vector<float> values =
        fragments({{0, 0.5f}, {10, 0.5f}, {20, 0.5f}, {30, 0.5f}, {63, 0.5f}});
    const FineProfiles fine{{fine_planes, values}};
    const std::vector<float> planes = layer_planes(16, 0.45);
    const std::vector<float> layers = fine.rebinned(planes),
                             moments = fine.rebinned_moments(planes);
    const double with = split_error({planes, layers, {}, moments}, fine);
    const double without = split_error({planes, layers}, fine);
    CHECK(without > 0.05);
    CHECK(split_error({planes, layers, {}, moments}, fine, {.own_correction = true}) < 1e-6);
    CHECK(with <= without);
}
