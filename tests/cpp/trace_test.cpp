// Rays: the same bits on any number of threads and with any backend, strata that cover a footprint,
// and threads that are gone when a call ends, however it ends.
#include "opacity/trace.hpp"

#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "core/parallel.hpp"
#include "opacity/core/error.hpp"
#include "opacity/io/load.hpp"
#include "opacity/scene/mesh.hpp"
#include "opacity/scene/particles.hpp"
#include "opacity/scene/strands.hpp"
#include "opacity/scene/volume.hpp"
#include "rays/backend.hpp"
#include "rays/crossing.hpp"
#include "rays/footprint.hpp"
#include "scene/light_fit.hpp"

using namespace opacity;
using doctest::Approx;

namespace {

Scene lit(std::vector<ShapePtr> shapes, const double3& direction = {0, 0, -1}) {
    Scene scene;
    for (ShapePtr& shape : shapes) scene.add(std::move(shape));
    scene.add(std::make_shared<DirectionalLight>(direction));
    return scene;
}

ShapePtr strand(std::vector<double> xyz, float width = 0.2f, float opacity = 0.5f) {
    const auto points = std::int64_t(xyz.size() / 3);
    return std::make_shared<Strands>(Positions{std::move(xyz)},
                                     std::vector<std::int64_t>{0, points},
                                     std::vector<float>{width}, std::vector<float>{opacity});
}

ShapePtr square(double height, float opacity) {
    return std::make_shared<Mesh>(
        Positions{std::vector<double>{-1, -1, height, 1, -1, height, 1, 1, height, -1, 1, height}},
        std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}, std::vector<float3>{},
        std::vector<float>{opacity});
}

Positions at(std::vector<double> xyz) {
    return Positions{std::move(xyz)};
}

// Without a bias, so that the closed forms hold at once.
TraceSettings strict(const std::string& backend = "auto") {
    TraceSettings settings;
    settings.bias = {0.0};
    settings.backend = backend;
    return settings;
}

TraceSettings footprint(double side, int samples) {
    TraceSettings settings;
    settings.footprint = {side};
    settings.samples = samples;
    return settings;
}

}  // namespace

TEST_CASE("rays: ribbons, sheets and opaque surfaces") {
    const std::vector<ShapePtr> shapes{strand({-1, 0, 3, 1, 0, 3}), square(2, 0.25f),
                                       square(1, 1.f)};
    const Scene scene = lit(shapes);
    const Positions points = at({0, 0, 4, 0, 0, 2.5, 0, 0.05, 1.5, 0, 0.2, 1.5, 0, 0, 0, 2, 0, 0});
    for (const std::string& backend : trace_backends()) {
        CAPTURE(backend);
        const std::vector<float> expected{1.f, 0.5f, 0.375f, 0.75f, 0.f, 1.f};
        const std::vector<float> t = trace_transmittance(scene, points, strict(backend));
        for (std::size_t i = 0; i < expected.size(); ++i) CHECK(t[i] == Approx(expected[i]));
    }
}

TEST_CASE("rays: the same bits on 1, 2 and 8 threads, with every backend") {
    const Scene scene = lit(load("demo:hair?segments=2000"), {0.5, 0.3, -0.8});
    TraceSettings settings = footprint(1.0, 5);
    settings.threads = 1;
    settings.backend = "builtin";
    const Shape& hair = *scene.shapes().front();
    const std::vector<float> expected = trace_transmittance(scene, hair, settings);
    CHECK(expected.size() == hair.points().size());
    for (const std::string& backend : trace_backends())
        for (const int threads : {1, 2, 8}) {
            settings.backend = backend;
            settings.threads = threads;
            CHECK(trace_transmittance(scene, hair, settings) == expected);
        }
}

TEST_CASE("rays: particles, voxels and foliage, the same bits however they are found") {
    std::vector<double> centers;
    for (int i = 0; i < 600; ++i) centers.push_back(std::sin(12.9898 * i) * 3.0);
    std::vector<float> extinction(12 * 10 * 9);
    for (std::size_t i = 0; i < extinction.size(); ++i) extinction[i] = i % 7 == 0 ? 0.5f : 0.f;
    const auto dust = std::make_shared<Particles>(Positions{centers}, std::vector<float>{0.2f});
    const auto smoke = std::make_shared<Volume>(Volume::Size{12, 10, 9}, extinction,
                                                double3{-2, -2, -2}, double3{0.4, 0.4, 0.4});
    const auto leaf = std::static_pointer_cast<Mesh>(square(0, 0.9f));
    leaf->set_uvs({{0.f, 3.f}, {2.f, 3.f}, {2.f, 0.f}, {0.f, 0.f}});
    leaf->set_alpha(std::make_shared<TextureMap>(TextureMap{2, 2, 1, {0.f, 1.f, 0.3f, 0.8f}}),
                    AlphaMode::blend);
    Scene scene;
    for (const ShapePtr& shape : {ShapePtr{dust}, ShapePtr{smoke}, ShapePtr{leaf}})
        scene.add(shape);
    scene.add(std::make_shared<AreaLight>(double3{1, 2, 5}, double3{1, 0, 0}, double3{0, 1, 0}, 2));
    TraceSettings settings = footprint(0.2, 5);
    settings.threads = 1;
    settings.backend = "builtin";
    for (const ShapePtr& shape : scene.shapes()) {
        const std::vector<float> expected = trace_transmittance(scene, *shape, settings);
        CHECK(expected.size() == (shape == smoke ? extinction.size() : shape->points().size()));
        for (const std::string& backend : trace_backends())
            for (const int threads : {1, 2, 8}) {
                TraceSettings other = settings;
                other.backend = backend;
                other.threads = threads;
                CHECK(trace_transmittance(scene, *shape, other) == expected);
            }
    }
}

TEST_CASE("rays: any number of samples lies one in each part of equal area") {
    for (const int samples : {1, 2, 3, 5, 12, 16, 63, 64, 65, 1000}) {
        CAPTURE(samples);
        std::array<double, 2> mean{};
        for (int i = 0; i < samples; ++i) {
            const auto offset = rays::footprint_offset(7, i, samples);
            CHECK(offset == rays::footprint_offset(7, i, samples));
            for (std::size_t axis = 0; axis < 2; ++axis) {
                CHECK(std::abs(offset[axis]) <= 0.5);
                mean[axis] += offset[axis] / samples;
            }
        }
        CHECK(std::abs(mean[0]) < 1.2 / samples + 1e-3);
        CHECK(std::abs(mean[1]) < 1.2 / samples + 1e-3);
    }
    // 8 x 8 cells: one sample in each.
    std::array<int, 64> cells{};
    for (int i = 0; i < 64; ++i) {
        const auto offset = rays::footprint_offset(3, i, 64);
        ++cells[std::size_t(int((offset[1] + 0.5) * 8) * 8 + int((offset[0] + 0.5) * 8))];
    }
    for (const int count : cells) CHECK(count == 1);
    CHECK(rays::footprint_offset(3, 5, 64) != rays::footprint_offset(4, 5, 64));
}

TEST_CASE("rays: both triangles beside an edge decide alike, wherever it lies") {
    std::vector<double> corners;
    for (int i = 0; i < 40; ++i) {
        const double x = 0.37 * i - 7.0, y = 2.0 * std::sin(1.7 * i);
        for (const double v : {x, y, 1.0}) corners.push_back(v);
    }
    std::vector<std::uint32_t> strip;
    for (std::uint32_t i = 0; i + 2 < 40; ++i) strip.insert(strip.end(), {i, i + 1, i + 2});
    // A strip that folds over itself: across any edge the count changes by 0 or 2.
    const auto mesh = std::make_shared<Mesh>(Positions{corners}, strip, std::vector<float3>{},
                                             std::vector<float>{0.5f});
    const Scene scene = lit({mesh});
    std::vector<double> on_edges;
    for (std::size_t i = 0; i + 1 < 40; ++i)
        for (const double along : {0.25, 0.5}) {
            on_edges.push_back(std::lerp(corners[3 * i], corners[3 * i + 3], along));
            on_edges.push_back(std::lerp(corners[3 * i + 1], corners[3 * i + 4], along));
            on_edges.push_back(0.0);
        }
    std::vector<double> beside[2] = {on_edges, on_edges};
    for (std::size_t i = 0; i < on_edges.size(); i += 3) {
        beside[0][i] -= 1e-9;
        beside[1][i] += 1e-9;
    }
    const auto on = trace_transmittance(scene, at(on_edges), strict());
    const auto left = trace_transmittance(scene, at(beside[0]), strict());
    const auto right = trace_transmittance(scene, at(beside[1]), strict());
    for (std::size_t i = 0; i < on.size(); ++i) CHECK((on[i] == left[i] || on[i] == right[i]));
}

TEST_CASE("rays: many pieces in one place, and far more of them than a search can hold") {
    // All boxes alike, then each half as far as the one before: what a hierarchy splits worst.
    std::vector<double> xyz;
    std::vector<std::int64_t> offsets{0};
    for (int i = 0; i < 3000; ++i) {
        const double scale = i < 1000 ? 1.0 : std::exp2(-(i - 1000) / 2.0);
        for (const double v : {-scale, 0.0, 1.0, scale, 0.0, 1.0}) xyz.push_back(v);
        offsets.push_back(offsets.back() + 2);
    }
    const auto strands = std::make_shared<Strands>(
        Positions{std::move(xyz)}, offsets, std::vector<float>{0.1f}, std::vector<float>{0.001f});
    const Scene scene = lit({strands});
    for (const std::string& backend : trace_backends()) {
        const auto t = trace_transmittance(scene, at({0.9, 0, 0, 0.3, 0, 0}), strict(backend));
        CHECK(t[0] == Approx(std::pow(0.999, 1001)).epsilon(1e-5));
        CHECK(t[1] == Approx(std::pow(0.999, 1004)).epsilon(1e-5));
    }
}

TEST_CASE("rays: a search reaches what lies in front, wherever the ray comes from") {
    const Scene scene = lit({square(0, 0.5f)});
    const Positions points = at({0.3, 0, -1e9, 0.3, 0, 1e9, 1e9, 0, -1, 0.3, 0, -1e-7});
    for (const std::string& backend : trace_backends())
        CHECK(trace_transmittance(scene, points, strict(backend)) ==
              std::vector<float>{0.5f, 1.f, 1.f, 0.5f});
}

TEST_CASE("rays: what is wrong is named") {
    const Scene scene = lit({square(0, 0.5f)});
    const auto refused = [&](auto change) {
        TraceSettings settings;
        change(settings);
        CHECK_THROWS_AS(trace_transmittance(scene, at({0, 0, 0}), settings), ParameterError);
    };
    refused([](TraceSettings& s) { s.light = 1; });
    refused([](TraceSettings& s) { s.samples = 0; });
    refused([](TraceSettings& s) { s.footprint = {std::nan("")}; });
    refused([](TraceSettings& s) { s.bias = {0.1, 0.2}; });
    refused([](TraceSettings& s) { s.bias = {-1.0}; });
    refused([](TraceSettings& s) { s.threads = -1; });
    refused([](TraceSettings& s) { s.backend = "optix"; });
    CHECK_THROWS_AS(trace_transmittance(scene, at({0, 0, std::nan("")})), ParameterError);
    CHECK(trace_backends().back() == "builtin");
    if (trace_backends().size() == 1) refused([](TraceSettings& s) { s.backend = "embree"; });
}

TEST_CASE("rays: work is done once each, and what is thrown ends it") {
    for (const int threads : {0, 1, 3, 8}) {
        std::vector<std::atomic<int>> done(100);
        in_parallel(
            done.size(), threads, [&](std::size_t i, std::stop_token) { ++done[i]; },
            [](double) {});
        for (const auto& count : done) CHECK(count == 1);

        std::atomic<int> started{0};
        const auto fail = [&](std::size_t i, std::stop_token) {
            ++started;
            if (i == 10) throw std::runtime_error{"broken"};
        };
        CHECK_THROWS_WITH(in_parallel(100000, threads, fail, [](double) {}), "broken");
        CHECK(started < 100000);

        std::atomic<bool> working{false};
        const auto wait = [&](std::size_t, std::stop_token stop) {
            working = true;
            while (!stop.stop_requested()) std::this_thread::yield();
            working = false;
        };
        const auto refuse = [](double) { throw std::runtime_error{"enough"}; };
        CHECK_THROWS_WITH(in_parallel(1, threads, wait, refuse), "enough");
        CHECK(!working);
    }
}
