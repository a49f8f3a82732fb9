// What coefficient maps sum and tell, in GLSL and in C++: layers_convention_gl_test.cpp has layers.
#include <doctest/doctest.h>

#include <array>
#include <string>

#include "compute_harness.hpp"
#include "map/basis.hpp"
#include "map/moments.hpp"

using namespace opacity;
using harness::check_agreement;
using harness::Evaluator;
using harness::Random;
using harness::Row;
using harness::Table;

namespace {

constexpr int count = 15;

// Begin, end, and a place; every fifth caster is a point, and every seventh as large as can be.
Table casters() {
    Random random;
    Table given{{0.f, 0.f, 0.f}, {1.f, 1.f, 1.f}, {0.f, 1.f, 0.5f}};
    for (int i = 0; i < 2000; ++i) {
        const float begin = random(0, 1), length = i % 5 ? random(0, 1 - begin) : 0.f;
        given.push_back({begin, begin + (i % 7 ? length * random(0, 1) : length), random(0, 1)});
    }
    return given;
}

}  // namespace

TEST_CASE("each basis is the same in GLSL and C++") {
    const auto context = context_or_skip();
    if (!context) return;
    for (const std::string& name : basis_names()) {
        CAPTURE(name);
        const std::string body =
            "Means means = means_over(given(0), given(1));\n"
            "Integrals integrals = integrals_to(given(2));\n"
            "for (int k = 0; k < COEFFICIENTS; ++k) {\n"
            "    result(3 * k) = next_mean(means, k);\n"
            "    result(3 * k + 1) = next_integral(integrals, k);\n"
            "    result(3 * k + 2) = whole_integral(k);\n"
            "}";
        Evaluator evaluator{context,
                            {"#include \"lib/basis.glsl\"\n",
                             3,
                             3 * count,
                             body,
                             {{"BASIS_" + name, "1"}, {"COEFFICIENTS", std::to_string(count)}}}};
        const Basis& basis = basis_of(name);
        const Table given = casters();
        const auto in_cpp = [&](const Row& row) {
            std::array<float, count> means, integrals;
            basis.means(row[0], row[1], means);
            basis.integrals(row[2], integrals);
            Row expected;
            for (std::size_t k = 0; k < count; ++k)
                expected.insert(expected.end(), {means[k], integrals[k], basis.whole(k)});
            return expected;
        };
        check_agreement(given, evaluator(given), in_cpp, 1e-5);
    }
}

TEST_CASE("all of a basis adds up to all of a caster") {
    for (const std::string& name : basis_names()) {
        CAPTURE(name);
        const Basis& basis = basis_of(name);
        for (std::size_t size : {3, 8, 63}) {
            std::vector<float> means(size), integrals(size);
            basis.means(0.3f, 0.4f, means);
            basis.integrals(1.f, integrals);
            float sum = 0.f;
            for (std::size_t k = 0; k < size; ++k) {
                CHECK(integrals[k] == doctest::Approx(basis.whole(k)).epsilon(1e-5));
                sum += means[k] * basis.whole(k);
            }
            CHECK(sum == doctest::Approx(1.f));
        }
    }
}

TEST_CASE("what moments tell is the same in GLSL and C++, and rises along the light") {
    const auto context = context_or_skip();
    if (!context) return;
    const int casters_a_row = 5, places = 8;
    for (const int moments : {4, 6, 8}) {
        CAPTURE(moments);
        Evaluator evaluator{context,
                            {"#include \"lib/moments.glsl\"\n",
                             3 * casters_a_row,
                             places,
                             "for (int i = 0; i < 8; ++i) {\n"
                             "    Sums sums = sums_at(float(i) / 7.0);\n"
                             "    for (int k = 0; k <= MOMENTS; ++k) sums.b[k] = 0.0;\n"
                             "    for (int c = 0; c < 5; ++c) {\n"
                             "        Means means = caster_means(given(3 * c), given(3 * c + 1));\n"
                             "        for (int k = 0; k <= MOMENTS; ++k)\n"
                             "            add(sums, k, sums.b[k] + given(3 * c + 2) * "
                             "next_mean(means, k));\n"
                             "    }\n"
                             "    result(i) = optical_depth_before(sums, sums.b[0]);\n"
                             "}",
                             {{"MOMENTS", std::to_string(moments)}}}};
        Random random;
        Table given;
        for (int i = 0; i < 500; ++i) {
            Row row;
            for (int c = 0; c < casters_a_row; ++c) {
                const float begin = random(0, 0.9f);
                row.insert(row.end(), {begin, begin + random(0, 0.1f), random(0.01f, 1)});
            }
            given.push_back(row);
        }
        const PowerMoments expansion{moments};
        const auto in_cpp = [&](const Row& row) {
            std::vector<float> sums(std::size_t(moments) + 1), one(sums.size());
            for (std::size_t c = 0; c < std::size_t(casters_a_row); ++c) {
                expansion.of_caster(row[3 * c], row[3 * c + 1], one);
                for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += row[3 * c + 2] * one[k];
            }
            Row expected;
            for (int i = 0; i < places; ++i)
                expected.push_back(expansion.optical_depth_before(float(i) / 7.f, sums, sums[0]));
            for (std::size_t i = 1; i < expected.size(); ++i)
                CHECK(expected[i] >= expected[i - 1] - 1e-6f);
            return expected;
        };
        // float32 rounds what moments differ by, the more the higher they are.
        check_agreement(given, evaluator(given), in_cpp, 5e-3);
    }
}
