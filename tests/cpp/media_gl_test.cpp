// What particles, voxels and alpha maps leave in a texel stands twice, in GLSL and in C++: both
// make the same of the same floats.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compute_harness.hpp"
#include "core/opacity.hpp"
#include "map/alpha.hpp"
#include "map/interval.hpp"
#include "map/sphere.hpp"
#include "map/volume_slabs.hpp"
#include "map/voxels.hpp"

using namespace opacity;
using doctest::Approx;
using harness::check_agreement;
using harness::Evaluator;
using harness::Random;
using harness::Row;
using harness::Table;

namespace {

Row chord_row(const std::optional<VoxelChord>& chord) {
    if (!chord) return {0, 0, 0, 0};
    return {1, chord->begin, chord->end, chord->optical_depth};
}

// Some voxels are empty.
std::vector<float> some_extinction(const Voxel& size) {
    Random random{5};
    std::vector<float> extinction;
    for (int i = 0; i < size[0] * size[1] * size[2]; ++i)
        extinction.push_back(random.below(3) ? random(0, 3) : 0.f);
    return extinction;
}

std::shared_ptr<Mesh> leaf(TextureMap alpha, AlphaMode mode) {
    const auto mesh =
        std::make_shared<Mesh>(Positions{std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}},
                               std::vector<std::uint32_t>{0, 1, 2});
    mesh->set_uvs({{0, 0}, {1, 0}, {0, 1}});
    mesh->set_alpha(std::make_shared<TextureMap>(std::move(alpha)), mode);
    return mesh;
}

double mean_of(const TextureMap& map) {
    double sum = 0.0;
    for (const float v : map.values) sum += double(v);
    return sum / double(map.values.size());
}

}  // namespace

TEST_CASE("the part of an interval in front of a depth is the same in GLSL and C++") {
    const auto context = context_or_skip();
    if (!context) return;
    Evaluator evaluator{context,
                        {"#include \"lib/interval.glsl\"\n", 3, 1,
                         "result(0) = part_in_front(given(0), given(1), given(2));"}};
    Random random;
    Table given;
    for (int i = 0; i < 2000; ++i) {
        const float begin = random(0, 1),
                    end = begin + (i % 3 ? std::pow(10.f, random(-7, 0)) : 0.f);
        given.insert(given.end(), {{begin, end, begin}, {begin, end, end}});
        given.insert(given.end(), {{begin, end, random(begin, end)}, {begin, end, random(0, 2)}});
    }
    check_agreement(given, evaluator(given),
                    [](const Row& row) { return Row{part_in_front(row[0], row[1], row[2])}; });
    CHECK(part_in_front(0.5f, 0.5f, 0.5f) == 0.f);
    CHECK(part_in_front(0.25f, 0.5f, 0.25f) == 0.f);
    CHECK(part_in_front(0.25f, 0.5f, 0.5f) == 1.f);
}

TEST_CASE("optical depth to opacity is the same in GLSL and C++, relative to its size") {
    const auto context = context_or_skip();
    if (!context) return;
    Evaluator evaluator{
        context, {"#include \"lib/opacity.glsl\"\n", 1, 1, "result(0) = opacity_of(given(0));"}};
    Random random;
    Table given{{0.f}, {0.5f}, {std::nextafter(0.5f, 0.f)}, {16.6f}};
    for (int i = 0; i < 4000; ++i) given.push_back({std::pow(10.f, random(-8, 1.2f))});
    const Table found = evaluator(given);
    for (std::size_t i = 0; i < given.size(); ++i) {
        const double exact = -std::expm1(-double(given[i][0]));
        REQUIRE(std::abs(found[i][0] - exact) <= 1e-6 * exact);
        REQUIRE(std::abs(opacity_of(given[i][0]) - exact) <= 1e-6 * exact);
    }
}

TEST_CASE("a sphere in a texel is the same in GLSL and C++") {
    const auto context = context_or_skip();
    if (!context) return;
    Evaluator evaluator{
        context,
        {"#include \"lib/sphere.glsl\"\n", 7, 3,
         "SphereCoverage c;\n"
         "bool met = sphere_coverage(given2(0), given(2), given(3), int(given(6)), given2(4), c);\n"
         "result(0) = met ? 1.0 : 0.0;\n"
         "result(1) = c.opacity; result(2) = c.half_length / max(1.0, given(2));"}};
    Random random;
    Table given;
    for (int i = 0; i < 20'000; ++i) {
        const float radius = std::exp(random(-4, 3.5f)), reach = radius + 1.f;
        const float x = random(8, 9), y = random(8, 9);
        given.push_back({x, y, radius, std::exp(random(-9, 2.8f)),
                         std::floor(x + random(-reach, reach)) + 0.5f,
                         std::floor(y + random(-reach, reach)) + 0.5f, float(i % 2)});
    }
    const Table found = evaluator(given);
    // A ring that runs along an edge may be inside in one and outside in the other.
    const auto expected = [](const Row& row) {
        const auto c = sphere_coverage({row[0], row[1]}, row[2], row[3],
                                       DensityProfile(int(row[6])), {row[4], row[5]});
        return c ? Row{1, c->opacity, c->half_length / std::max(1.f, row[2])} : Row{0, 0, 0};
    };
    int apart = 0, met = 0;
    for (std::size_t i = 0; i < given.size(); ++i) {
        const Row cpp = expected(given[i]);
        apart += cpp[0] != found[i][0], met += cpp[0] == 1.f;
        if (cpp[0] != found[i][0]) continue;
        REQUIRE(harness::difference(found[i][1], cpp[1]) < 1e-5);
        REQUIRE(harness::difference(found[i][2], cpp[2]) < 1e-3);
    }
    CHECK(apart < 5);
    CHECK(met > 8000);
}

TEST_CASE("a ray through voxels is the same in GLSL and C++") {
    const auto context = context_or_skip();
    if (!context) return;
    const Voxel size{7, 5, 6};
    const std::vector<float> extinction = some_extinction(size);
    const VoxelGrid grid{size, extinction, {0.5f, 1.f, 2.f}};
    Evaluator evaluator{context,
                        {"#include \"lib/voxels.glsl\"\n", 12, 4,
                         "VoxelChord c; VoxelRay ray = VoxelRay(given3(0), given3(3), -1e30);\n"
                         "bool met = voxel_chord(ray, ivec3(given3(6)), ivec3(given3(9)), c);\n"
                         "result(0) = met ? 1.0 : 0.0; result(1) = c.begin;\n"
                         "result(2) = c.end; result(3) = c.optical_depth;"}};
    gl::Texture texture{context, GL_TEXTURE_3D, GL_R32F, size[0], size[1], size[2]};
    texture.write(std::as_bytes(std::span{extinction}));
    evaluator.set_texture("t_extinction", std::move(texture));
    evaluator.program().set("u_voxel_size", std::vector<float>{0.5f, 1.f, 2.f});
    Random random;
    Table given;
    for (int i = 0; i < 8000; ++i) {
        Row row;
        for (int axis = 0; axis < 3; ++axis) row.push_back(random(-2, float(size[axis]) + 2));
        for (int axis = 0; axis < 3; ++axis)
            row.push_back(i % 4 == axis ? 0.f : random(-20, 20));  // some along a wall
        for (int axis = 0; axis < 3; ++axis) row.push_back(float(random.below(size[axis])));
        for (int axis = 0; axis < 3; ++axis) {
            const int low = int(row[6 + axis]);
            row.push_back(float(low + 1 + random.below(size[axis] - low)));
        }
        given.push_back(row);
    }
    const Table found = evaluator(given);
    const auto voxel = [](const Row& row, std::size_t first) {
        return Voxel{int(row[first]), int(row[first + 1]), int(row[first + 2])};
    };
    check_agreement(
        given, found,
        [&](const Row& row) {
            const VoxelRay ray{{row[0], row[1], row[2]}, {row[3], row[4], row[5]}, -1e30f};
            return chord_row(voxel_chord(ray, grid, voxel(row, 6), voxel(row, 9)));
        },
        1e-5);
    CHECK(std::ranges::count_if(found, [](const Row& row) { return row[0] == 1.f; }) > 400);
}

TEST_CASE("coverage by an alpha map is the same in GLSL and C++, and its levels keep the mean") {
    const auto context = context_or_skip();
    if (!context) return;
    Random random;
    for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend})
        for (const auto& [width, height] : {std::pair{13, 7}, {16, 64}, {1, 5}, {1, 1}}) {
            TextureMap alpha{width, height, 1, {}};
            for (int i = 0; i < width * height; ++i) alpha.values.push_back(random(0, 1));
            const auto levels = coverage_levels(*leaf(alpha, mode));
            for (const TextureMap& level : levels)
                CHECK(mean_of(level) == Approx(mean_of(levels[0])).epsilon(1e-5));
            CHECK(levels.back().values.size() == 1);
            Evaluator evaluator{context,
                                {"#include \"lib/alpha.glsl\"\n", 6, 1,
                                 "result(0) = coverage_at(given2(0), coverage_level(given2(2), "
                                 "given2(4)));"}};
            gl::Texture texture{context, GL_TEXTURE_2D,     GL_R32F, width, height,
                                1,       int(levels.size())};
            for (std::size_t i = 0; i < levels.size(); ++i)
                texture.write(std::as_bytes(std::span{levels[i].values}), int(i));
            texture.set_filter(GL_LINEAR);
            evaluator.set_texture("t_alpha", std::move(texture));
            Table given;
            Row slopes;  // llvmpipe takes one level for neighbouring invocations
            for (int i = 0; i < 64 * 64; ++i) {
                const float size = std::exp(random(-8, 3));
                if (i % 64 == 0)
                    slopes = {size * random(-1, 1), size * random(-1, 1), size * random(-1, 1),
                              size * random(-1, 1)};
                given.push_back({random(-2, 3), random(-2, 3)});
                given.back().insert(given.back().end(), slopes.begin(), slopes.end());
            }
            check_agreement(
                given, evaluator(given),
                [&](const Row& row) {
                    const float level = coverage_level(levels, {row[2], row[3]}, {row[4], row[5]});
                    return Row{coverage_at(levels, {row[0], row[1]}, level)};
                },
                2e-5);
        }
}
