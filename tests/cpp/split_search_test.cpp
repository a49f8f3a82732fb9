#include "opacity/core/split_search.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <utility>

#include "opacity/core/correlation.hpp"
#include "opacity/core/split.hpp"
#include "opacity/core/split_error.hpp"

using namespace opacity;

namespace {

const std::vector<float> fine_planes = layer_planes(64, 0.45);

using Images = std::pair<std::vector<double>, std::vector<double>>;

double in_one_pass(const Images& images) {
    Correlation correlation;
    for (std::size_t i = 0; i < images.first.size(); ++i)
        correlation.add(images.first[i], images.second[i]);
    return correlation.coefficient();
}

// Equation 5.2.3.1 as it stands: first the means, then the sums.
double in_two_passes(const Images& images) {
    const auto& [x, y] = images;
    const double n = double(x.size());
    double mean_x = 0.0, mean_y = 0.0, xy = 0.0, xx = 0.0, yy = 0.0;
    for (double v : x) mean_x += v / n;
    for (double v : y) mean_y += v / n;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xy += (x[i] - mean_x) * (y[i] - mean_y);
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        yy += (y[i] - mean_y) * (y[i] - mean_y);
    }
    return xy / std::sqrt(xx * yy);
}

// y = offset + slope x + noise; x of mean `mean` and deviation 1.
Images random_images(double mean, double slope, double noise, std::size_t count = 100000) {
    std::mt19937_64 random{5};
    std::normal_distribution<double> normal;
    Images images;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = mean + normal(random);
        images.first.push_back(x);
        images.second.push_back(mean + slope * (x - mean) + noise * normal(random));
    }
    return images;
}

using Curve = std::function<double(double)>;

// Texels whose optical depth in front of x is given.
std::vector<float> profiles_of(const std::vector<Curve>& texels,
                               const std::vector<float>& planes = fine_planes) {
    std::vector<float> values;
    for (const Curve& texel : texels)
        for (std::size_t k = 1; k < planes.size(); ++k)
            values.push_back(float(texel(double(planes[k]))));
    return values;
}

double score(const OpticalDepthProfiles& profiles, int layers, double ratio,
             const SplitMeasure& measure = {}) {
    const FineProfiles fine{profiles};
    const std::vector<float> planes = layer_planes(layers, ratio);
    const std::vector<float> values = fine.rebinned(planes);
    return split_score(measure, {planes, values}, fine);
}

double found(const OpticalDepthProfiles& fine, int layers, Similarity similarity) {
    return trial_ratio(find_split_trial(FineProfiles{fine}, layers, {.similarity = similarity}));
}

// Texels of random fragments between 0 and 1, denser toward one end by a power of their depth.
std::vector<Curve> random_curves(std::uint64_t seed, double power, double mean_count, double tau) {
    std::mt19937_64 random{seed};
    std::uniform_real_distribution<double> uniform{0.0, 1.0};
    std::vector<Curve> texels;
    for (int t = 0; t < 400; ++t) {
        std::poisson_distribution<int> count{mean_count * uniform(random)};
        std::vector<double> depths;
        for (int i = count(random); i > 0; --i) depths.push_back(std::pow(uniform(random), power));
        texels.push_back([depths, tau](double x) {
            double sum = 0.0;
            for (double depth : depths) sum += depth < x ? tau : 0.0;
            return sum;
        });
    }
    return texels;
}

std::vector<float> random_casters(std::uint64_t seed, double power, double mean_count, double tau) {
    return profiles_of(random_curves(seed, power, mean_count, tau));
}

constexpr Similarity all_similarities[] = {
    Similarity::error, Similarity::absolute_difference, Similarity::correlation,
    Similarity::paper_absolute_difference, Similarity::paper_correlation};

}  // namespace

TEST_CASE("one pass over two images gives the C of two passes, also far from zero") {
    for (double mean : {0.0, 1.0, 1e4})
        for (double slope : {0.9, 0.01, 0.0, -2.0})
            for (double noise : {0.5, 1e-3}) {
                const Images images = random_images(mean, slope, noise);
                CHECK(std::abs(in_one_pass(images) - in_two_passes(images)) < 1e-6);
            }
    CHECK(in_one_pass(random_images(1e4, 1.0, 0.0)) == doctest::Approx(1.0).epsilon(1e-9));
    CHECK(in_one_pass(random_images(1e4, -1.0, 0.0)) == doctest::Approx(-1.0).epsilon(1e-9));
}

TEST_CASE("C lies in [-1, 1], and a constant image counts as 1, never NaN") {
    CHECK(Correlation{}.coefficient() == 1.0);
    CHECK(in_one_pass({{1.0}, {2.0}}) == 1.0);
    CHECK(in_one_pass({{0.1, 0.1, 0.1}, {1.0, 2.0, 3.0}}) == 1.0);
    CHECK(in_one_pass({{1.0, 2.0, 3.0}, {0.1, 0.1, 0.1}}) == 1.0);
    CHECK(in_one_pass({{1e-200, 2e-200}, {1e-200, 2e-200}}) <= 1.0);
    for (std::size_t count : {2, 3, 7}) {
        CHECK(std::abs(in_one_pass(random_images(1e9, 1.0, 0.0, count))) <= 1.0);
        CHECK(std::abs(in_one_pass(random_images(1e9, -1.0, 0.0, count))) <= 1.0);
    }
}

TEST_CASE("only covered texels are compared: empty ones around them change no score") {
    const std::vector<float> covered = random_casters(1, 1.0, 12.0, 0.4);
    std::vector<float> masked(3 * covered.size(), 0.f);
    std::copy(covered.begin(), covered.end(), masked.begin() + std::ptrdiff_t(covered.size()));
    for (Similarity similarity :
         {Similarity::error, Similarity::absolute_difference, Similarity::correlation})
        CHECK(score({fine_planes, masked}, 8, 0.4, {.similarity = similarity}) ==
              doctest::Approx(score({fine_planes, covered}, 8, 0.4, {.similarity = similarity}))
                  .epsilon(1e-12));
    const SplitMeasure paper{.similarity = Similarity::paper_correlation};
    CHECK(score({fine_planes, masked}, 8, 0.4, paper) >
          score({fine_planes, covered}, 8, 0.4, paper));  // background looks like information
}

TEST_CASE("error finds linear planes for even casters, planes near the light for dense ones") {
    const std::vector<float> sparse = profiles_of({[](double x) { return 0.5 * x; }});
    CHECK(score({fine_planes, sparse}, 8, 0.0) < 1e-4);  // layers follow a line
    CHECK(found({fine_planes, sparse}, 8, Similarity::error) == 0.0);

    const std::vector<float> dense =
        profiles_of({[](double x) { return 20.0 * std::log1p(50.0 * x); }});
    CHECK(found({fine_planes, dense}, 8, Similarity::error) >= 0.5);
}

TEST_CASE("error finds the ratio at which optical depth is linear between the planes") {
    const std::vector<double> steps{0.3, 0.1, 0.8, 0.2, 0.0, 0.5, 0.9, 0.4};
    for (int tenth : {0, 3, 6, 10}) {
        const std::vector<float> coarse = layer_planes(8, tenth / 10.0);
        std::vector<float> planes{0.f}, values;  // eight cells to a layer
        double optical_depth = 0.0;
        for (std::size_t layer = 0; layer < 8; ++layer)
            for (int part = 1; part <= 8; ++part) {
                planes.push_back(
                    float(std::lerp(double(coarse[layer]), double(coarse[layer + 1]), part / 8.0)));
                values.push_back(float(optical_depth += steps[layer] / 8.0));
            }
        CHECK(found({planes, values}, 8, Similarity::error) == tenth / 10.0);
    }
}

TEST_CASE("absolute_difference finds the ratio at which each layer adds the same opacity") {
    for (int tenth : {0, 2, 5, 7}) {
        const std::vector<float> values = profiles_of(
            {[&](double x) { return -std::log1p(-0.8 * split_curve(x, tenth / 10.0)); }});
        CHECK(found({fine_planes, values}, 8, Similarity::absolute_difference) == tenth / 10.0);
    }
}

TEST_CASE("correlation puts the plane between two groups that know nothing of each other") {
    std::mt19937_64 random{3};
    std::uniform_real_distribution<double> uniform{0.0, 2.0};
    std::vector<Curve> texels;
    for (int t = 0; t < 500; ++t) {
        const double near = uniform(random), far = uniform(random);
        texels.push_back([near, far](double x) { return near * (x > 0.1) + far * (x > 0.4); });
    }
    const double ratio = found({fine_planes, profiles_of(texels)}, 2, Similarity::correlation);
    const float plane = layer_planes(2, ratio)[1];
    CHECK(plane > 0.1f);
    CHECK(plane < 0.4f);
}

TEST_CASE("more layers rebuild a profile better, and the found ratio is the best of the eleven") {
    const std::vector<float> values =
        profiles_of({[](double x) { return 6.0 * x * x + 3.0 * std::sqrt(x); }});
    const OpticalDepthProfiles fine{fine_planes, values};
    CHECK(score(fine, 32, 0.5) < score(fine, 8, 0.5));
    CHECK(score(fine, 8, 0.5) < score(fine, 2, 0.5));
    for (Similarity similarity : all_similarities) {
        const SplitMeasure measure{.similarity = similarity};
        const double best = score(fine, 8, found(fine, 8, similarity), measure);
        for (int tenth = 0; tenth <= 10; ++tenth)
            CHECK(best <= score(fine, 8, tenth / 10.0, measure));
    }
}

TEST_CASE("a receiver does not count its own fragment") {
    // Single fragments, far apart: layers as fine as the profile's own cells place each one
    // exactly, but for the ramp on which it lies.
    const std::vector<float> planes = layer_planes(64, 0.0);
    const std::vector<float> steps =
        profiles_of({[](double x) { return 0.1 * std::floor(8.0 * x); }}, planes);
    CHECK(split_error({planes, steps}, FineProfiles{{planes, steps}}) <
          0.051);  // half a fragment on its ramp
    CHECK(score({planes, steps}, 8, 0.0) < 0.11);
}

TEST_CASE("with own_correction, layers that hold one fragment each make no error") {
    const std::vector<float> planes = layer_planes(64, 0.0);
    const std::vector<float> steps =
        profiles_of({[](double x) { return 0.3 * std::floor(7.99 * x + 0.5); }}, planes);
    const SplitMeasure corrected{.look_up = {.own_correction = true}};
    CHECK(score({planes, steps}, 64, 0.0, corrected) < 1e-6);
    CHECK(score({planes, steps}, 8, 0.0, corrected) < 1e-6);
    CHECK(score({planes, steps}, 8, 0.0) > 0.03);
    // Smoke has no fragments to take away.
    const std::vector<float> smoke = profiles_of({[](double x) { return 2.0 * x * x; }}, planes);
    CHECK(score({planes, smoke}, 8, 0.3, corrected) ==
          doctest::Approx(score({planes, smoke}, 8, 0.3)).epsilon(1e-4));
}

TEST_CASE("what a receiver's bias leaves out, and the first caster, are no error") {
    const std::vector<float> planes = layer_planes(64, 0.0);
    const std::vector<float> values =
        profiles_of({[](double x) { return 0.4 * (x > 0.0) + 0.4 * (x > 0.57); }}, planes);
    const auto error = [&](float bias) {
        return score({planes, values, {&bias, 1}}, 4, 0.0);  // layers begin at 0, .25, .5, .75
    };
    // Two fragments, of which the first is lit; the second lies at the middle of cell 36, and its
    // layer counts a part of it.
    const double along = (36.5 / 64 - 0.5) / 0.25;
    const double error_of_second = std::exp(-0.4) * (1.0 - std::exp(-0.4 * along));
    CHECK(error(0.f) == doctest::Approx(error_of_second).epsilon(1e-6));
    CHECK(error(0.1f) < 1e-7);  // looks up in front of its layer
    CHECK(error(1.f) == 0.0);   // in front of everything
    const std::vector<float> single =
        profiles_of({[](double x) { return 0.4 * (x > 0.0); }}, planes);
    CHECK(score({planes, single}, 4, 0.7) == 0.0);
}

TEST_CASE("the last caster lies at the end of its layer, whatever the ratio") {
    const std::vector<float> values =
        profiles_of({[](double x) { return 0.4 * (x > 0.0) + 0.4 * (x >= 1.0); }});
    for (int tenth = 0; tenth <= 10; ++tenth) {
        const double error = std::exp(-0.4) - std::exp(-0.8);
        CHECK(score({fine_planes, values}, 8, tenth / 10.0) ==
              doctest::Approx(error).epsilon(1e-6));
        CHECK(score({fine_planes, values}, 8, tenth / 10.0, {.look_up = {.own_correction = true}}) <
              1e-6);
    }
}

TEST_CASE("layers from the histogram score like layers drawn from the casters themselves") {
    for (double power : {0.5, 1.0, 3.0}) {
        const std::vector<Curve> casters = random_curves(7, power, 12.0, 0.1);
        const std::vector<float> histogram = profiles_of(casters);
        const FineProfiles fine{{fine_planes, histogram}};
        for (Similarity similarity : all_similarities)
            for (double ratio : {0.0, 0.5, 1.0}) {
                const std::vector<float> planes = layer_planes(8, ratio);
                const std::vector<float> drawn = profiles_of(casters, planes);
                const std::vector<float> rebinned = fine.rebinned(planes);
                const SplitMeasure measure{.similarity = similarity};
                const double of_drawn = split_score(measure, {planes, drawn}, fine);
                CHECK(split_score(measure, {planes, rebinned}, fine) ==
                      doctest::Approx(of_drawn).epsilon(0.05));
            }
    }
}

TEST_CASE(
    "erratum: on raw optical depth, neighbours telescope, and the largest ratios win on "
    "everything") {
    const std::vector<float> values = random_casters(2, 1.0, 3.0, 0.1);
    const std::vector<float> planes = layer_planes(8, 0.4);
    const OpticalDepthProfiles fine{fine_planes, values};
    const std::vector<float> layers = FineProfiles{fine}.rebinned(planes);
    const auto in_8_bits = [](float tau) { return std::floor(255.0 * std::fmin(tau, 1.f) + 0.5); };
    double last_minus_first = 0.0;
    for (std::size_t t = 0; t < layers.size(); t += 8)
        last_minus_first += in_8_bits(layers[t + 7]) - in_8_bits(layers[t]);
    CHECK(score(fine, 8, 0.4, {.similarity = Similarity::paper_absolute_difference}) ==
          -last_minus_first);

    std::uint64_t seed = 10;
    for (double power : {0.5, 1.0, 2.0})
        for (double tau : {0.01, 0.05}) {
            CAPTURE(power);
            CAPTURE(tau);
            const std::vector<float> casters = random_casters(++seed, power, 20.0, tau);
            const OpticalDepthProfiles all{fine_planes, casters};
            const SplitMeasure difference{.similarity = Similarity::paper_absolute_difference};
            for (int tenth = 0; tenth < 10; ++tenth)
                CHECK(score(all, 8, 1.0, difference) <= score(all, 8, tenth / 10.0, difference));
            CHECK(found(all, 8, Similarity::error) < 1.0);
            if (power < 1.0) continue;  // at 8 bits the first layers are empty from some ratio on
            CHECK(found(all, 8, Similarity::paper_absolute_difference) == 1.0);
            CHECK(found(all, 8, Similarity::paper_correlation) >= 0.9);
        }
}

TEST_CASE("the thesis's 8 bits: steps of 1/255, and nothing above 1") {
    const SplitMeasure paper{.similarity = Similarity::paper_absolute_difference};
    const std::vector<float> planes = layer_planes(2, 0.0);
    const auto difference = [&](float first, float last) {
        const std::vector<float> values{first, last};
        return -split_score(paper, {planes, values}, FineProfiles{{planes, values}});
    };
    CHECK(difference(0.f, 0.4f / 255.f) == 0.0);
    CHECK(difference(0.f, 0.6f / 255.f) == 1.0);
    CHECK(difference(0.5f, 7.f) == 255.0 - 128.0);
    CHECK(difference(2.f, 7.f) == 0.0);
}

TEST_CASE("no texel, an empty one, equal ones: a finite score and the first ratio") {
    const std::vector<float> empty(64, 0.f),
        twice = profiles_of({[](double x) { return x; }, [](double x) { return x; }});
    for (Similarity similarity : all_similarities) {
        for (const std::vector<float>& values : {std::vector<float>{}, empty, twice})
            for (int layers : {2, 3, 64})
                CHECK(std::isfinite(
                    score({fine_planes, values}, layers, 0.5, {.similarity = similarity})));
        CHECK(found({fine_planes, {}}, 8, similarity) == 0.0);
        CHECK(found({fine_planes, empty}, 8, similarity) == 0.0);
    }
    CHECK(found({fine_planes, twice}, 8, Similarity::correlation) == 0.0);  // all constant
}
