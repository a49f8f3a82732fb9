#include <doctest/doctest.h>

#include <algorithm>
#include <array>

#include "opacity/core/slicing.hpp"

using namespace opacity;

namespace {

void check_planes(const std::vector<float>& planes, int layers) {
    REQUIRE(planes.size() == std::size_t(layers) + 1);
    CHECK(planes.front() == 0.f);
    CHECK(planes.back() == 1.f);
    CHECK(std::adjacent_find(planes.begin(), planes.end(), std::greater_equal{}) == planes.end());
}

const DepthHistogram all_in_one_cell{{0.0, 0.25, 0.5, 0.75, 1.0}, {0.0, 0.0, 1.0, 0.0}};

}  // namespace

TEST_CASE("slices rise strictly from 0 to 1, whatever their number") {
    for (int layers : {1, 2, 3, 16, 100, 1024}) {
        CAPTURE(layers);
        check_planes(uniform_slices(layers), layers);
        check_planes(gamma_slices(layers, 2.2), layers);
        check_planes(gamma_slices(layers, 8.0), layers);
        check_planes(density_slices(layers, all_in_one_cell), layers);
        check_planes(density_slices(layers, {{0.0, 1.0}, {0.0}}), layers);
    }
}

TEST_CASE("uniform slices are even, gamma ones powers of them") {
    CHECK(uniform_slices(4) == std::vector<float>{0.f, .25f, .5f, .75f, 1.f});
    CHECK(gamma_slices(4, 2.0) == std::vector<float>{0.f, .0625f, .25f, .5625f, 1.f});
}

TEST_CASE("dense slabs are halved until they hold as much as the others") {
    // Halves of [0, 1], of its dense half [.5, 1], of the dense half of that, and so on.
    CHECK(density_slices(3, all_in_one_cell) == std::vector<float>{0.f, .5f, .75f, 1.f});
    CHECK(density_slices(5, all_in_one_cell) ==
          std::vector<float>{0.f, .5f, .5625f, .625f, .75f, 1.f});
    // Nothing to go by: the thickest.
    CHECK(density_slices(4, {{0.0, 1.0}, {0.0}}) == uniform_slices(4));
}

TEST_CASE("layers keep their sizes") {
    const std::array sizes{1.0, 2.0, 5.0};
    CHECK(planes_of_sizes(sizes) == std::vector<float>{0.f, .125f, .375f, 1.f});
}
