// Where a view is cut for parallel splits, in closed form.
#include "opacity/core/view_splits.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace opacity;
using doctest::Approx;

TEST_CASE("view splits: mix 0 cuts evenly, mix 1 into splits of equal ratio") {
    const std::vector<double> even = view_cuts(1.0, 17.0, {4, 0.0});
    CHECK(even == std::vector<double>{1.0, 5.0, 9.0, 13.0, 17.0});
    const std::vector<double> ratio = view_cuts(1.0, 16.0, {4, 1.0});
    REQUIRE(ratio.size() == 5);
    for (std::size_t i = 0; i < 5; ++i) CHECK(ratio[i] == Approx(std::exp2(double(i))));
}

TEST_CASE("view splits: in between they mix the distances") {
    for (const double mix : {0.1, 0.5, 0.9})
        for (const int count : {2, 3, 8}) {
            const std::vector<double> cuts = view_cuts(0.3, 700.0, {count, mix});
            const std::vector<double> even = view_cuts(0.3, 700.0, {count, 0.0});
            const std::vector<double> ratio = view_cuts(0.3, 700.0, {count, 1.0});
            for (std::size_t i = 0; i < cuts.size(); ++i)
                CHECK(cuts[i] == Approx(even[i] + mix * (ratio[i] - even[i])));
        }
}

TEST_CASE(
    "view splits: they rise from near to far, both exact, and sooner with more of the logarithm") {
    for (const double near : {1e-6, 0.1, 3.0})
        for (const double far : {near, 1.1 * near, 1e3 * near, 1e9}) {
            std::vector<double> before;
            for (const double mix : {0.0, 0.25, 0.5, 1.0}) {
                const std::vector<double> cuts = view_cuts(near, far, {5, mix});
                REQUIRE(cuts.size() == 6);
                CHECK(cuts.front() == near);
                CHECK(cuts.back() == far);
                const double rounding = 1e-14 * far;
                for (std::size_t i = 1; i < cuts.size(); ++i) {
                    CHECK(cuts[i] >= cuts[i - 1] - rounding);
                    if (far > 1.05 * near) CHECK(cuts[i] > cuts[i - 1]);
                    if (!before.empty()) CHECK(cuts[i] <= before[i] + rounding);
                }
                before = cuts;
            }
        }
    CHECK(view_cuts(2.0, 9.0, {1, 0.5}) == std::vector<double>{2.0, 9.0});
}
