// Which strands a map that holds fewer keeps, and what that adds to T.
#include "scene/strand_ranks.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "scene/map_detail.hpp"

using namespace opacity;
using doctest::Approx;

namespace {

// Strands of one segment each, anywhere in a unit cube.
std::shared_ptr<Strands> scattered(int count) {
    std::mt19937 engine{2};
    std::uniform_real_distribution<double> place{0.0, 1.0};
    std::vector<double> xyz;
    std::vector<std::int64_t> offsets{0};
    for (int i = 0; i < count; ++i) {
        for (int number = 0; number < 6; ++number) xyz.push_back(place(engine));
        offsets.push_back(2 * (i + 1));
    }
    return std::make_shared<Strands>(Positions{xyz}, offsets);
}

std::vector<std::size_t> kept_of(const StrandRanks& ranks, double detail) {
    std::vector<std::size_t> kept;
    for (std::size_t k = 0; k < ranks.of_strands.size(); ++k)
        if (ranks.is_kept(k, detail)) kept.push_back(k);
    return kept;
}

}  // namespace

TEST_CASE("as many strands remain as are asked for, and fewer are among more") {
    for (const int count : {1, 2, 7, 1000}) {
        const auto ranks = scattered(count)->ranks();
        std::vector<std::size_t> more = kept_of(*ranks, 1.0);
        CHECK(more.size() == std::size_t(count));
        for (double detail = 1.0; detail > 1e-3; detail *= 0.93) {
            const std::vector<std::size_t> kept = kept_of(*ranks, detail);
            CHECK(!kept.empty());
            CHECK(kept.size() == ranks->kept(detail));
            CHECK(std::abs(double(kept.size()) - detail * count) <= std::log2(count) + 1.0);
            CHECK(double(kept.size()) * ranks->widening(detail) == Approx(count));
            CHECK(std::ranges::includes(more, kept));
            more = kept;
        }
    }
}

TEST_CASE("they are spread evenly") {
    const auto strands = scattered(4096);
    const auto ranks = strands->ranks();
    // Each octant keeps about its share; of strands drawn by lot its deviation were 14.
    std::vector<int> all(8, 0), kept(8, 0);
    for (std::size_t k = 0; k < strands->strand_count(); ++k) {
        const double3 a = strands->points()[2 * k], b = strands->points()[2 * k + 1];
        std::size_t octant = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            octant |= std::size_t(a[axis] + b[axis] > 1.0) << axis;
        ++all[octant];
        kept[octant] += ranks->is_kept(k, 0.25);
    }
    for (std::size_t octant = 0; octant < 8; ++octant)
        CHECK(std::abs(kept[octant] - 0.25 * all[octant]) <= 3.0);
}

TEST_CASE("the choice stays while points move, and instances share it") {
    const auto strands = scattered(100);
    const auto twin = std::dynamic_pointer_cast<Strands>(strands->instance());
    const std::vector<double> before = strands->ranks()->of_strands;
    std::vector<double> moved;
    for (int i = 0; i < 600; ++i) moved.push_back(600.0 - i);
    strands->set_points(Positions{moved});
    CHECK(strands->ranks()->of_strands == before);
    CHECK(twin->ranks() == strands->ranks());
}

TEST_CASE("the error of a sample is that of strands kept by lot") {
    // T in front of which m casters of opacity a lie, each kept with the chance 1 / n, and then of
    // opacity n a; m even over 0 .. most.
    std::mt19937 engine{3};
    constexpr int most = 60, trials = 4000;
    for (const double n : {1.5, 4.0, 10.0}) {
        const double a = 0.05;
        std::bernoulli_distribution is_kept{1.0 / n};
        double squares = 0.0, sum = 0.0;
        for (int trial = 0; trial < trials; ++trial) {
            double t = 1.0, sampled = 1.0;
            for (int m = 0; m < most; ++m) {
                squares += (sampled - t) * (sampled - t);
                sum += sampled - t;
                t *= 1.0 - a;
                if (is_kept(engine)) sampled *= 1.0 - n * a;
            }
        }
        const double omega = most * -std::log1p(-a);
        CHECK(std::sqrt(squares / (trials * most)) ==
              Approx(sampling_error(n, a, omega)).epsilon(0.05));
        CHECK(std::abs(sum / (trials * most)) < 0.01);  // T is right in the mean
    }
    CHECK(sampling_error(1.0, 0.3, 5.0) == 0.0);
    CHECK(sampling_error(2.0, 0.0, 5.0) == 0.0);
}
