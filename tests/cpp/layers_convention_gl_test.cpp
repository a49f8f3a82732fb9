// What layers are laid, kept and looked up with, in GLSL and in C++: convention_gl_test.cpp has the
// other conventions.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "compute_harness.hpp"
#include "map/block_sample.hpp"
#include "map/clusters.hpp"
#include "map/depth_bits.hpp"
#include "map/monotone_cubic.hpp"
#include "map/planes.hpp"
#include "techniques/drawn_layers.hpp"

using namespace opacity;
using harness::check_agreement;
using harness::Evaluator;
using harness::Random;
using harness::Row;
using harness::Table;

TEST_CASE("the cubic is the same in GLSL and C++, and stays between the planes around it") {
    const auto context = context_or_skip();
    if (!context) return;
    Evaluator evaluator{context,
                        {"#include \"lib/monotone_cubic.glsl\"\n", 9, 1,
                         "vec4 places = vec4(given(0), given(1), given(2), given(3));\n"
                         "vec4 values = vec4(given(4), given(5), given(6), given(7));\n"
                         "result(0) = monotone_cubic(places, values, given(8));"}};
    Random random;
    Table given;
    for (int i = 0; i < 4000; ++i) {
        Row row{0.f, 0, 0, 0, random(0, 1), 0, 0, 0, 0};
        for (int k = 1; k < 4; ++k) {
            row[k] = row[k - 1] + random(0.01f, 1);
            row[4 + k] = row[3 + k] + (random.below(3) ? random(0, 2) : 0.f);
        }
        row[8] = random.below(5) ? random(row[1], row[2]) : row[1 + random.below(2)];
        given.push_back(row);
    }
    check_agreement(given, evaluator(given), [](const Row& row) {
        const float value = monotone_cubic({row[0], row[1], row[2], row[3]},
                                           {row[4], row[5], row[6], row[7]}, row[8]);
        CHECK(value >= row[5] - 1e-5f);
        CHECK(value <= row[6] + 1e-5f);
        return Row{value};
    });
}

TEST_CASE("the cubic is exact at its planes, and on a line") {
    const std::array places{0.f, 1.f, 1.5f, 3.f};
    CHECK(monotone_cubic(places, {0.f, 1.f, 4.f, 5.f}, 1.f) == 1.f);
    CHECK(monotone_cubic(places, {0.f, 1.f, 4.f, 5.f}, 1.5f) == 4.f);
    for (float x : {1.f, 1.1f, 1.3f, 1.5f})
        CHECK(monotone_cubic(places, {0.f, 2.f, 3.f, 6.f}, x) == doctest::Approx(2.f * x));
}

TEST_CASE("depths of few bits are the same in GLSL and C++") {
    const auto context = context_or_skip();
    if (!context) return;
    Evaluator evaluator{context,
                        {"#include \"lib/depth_bits.glsl\"\n", 1, 3,
                         "result(0) = rounded_depth(given(0), 8);\n"
                         "result(1) = rounded_depth(given(0), 16);\n"
                         "result(2) = rounded_depth(given(0), 32);"}};
    Random random;
    Table given{{0.f}, {1.f}, {0.5f}, {0.5f / 255.f}, {std::nextafter(1.f, 0.f)}};
    for (int i = 0; i < 2000; ++i) given.push_back({std::pow(random(0, 1), 4.f)});
    check_agreement(given, evaluator(given), [](const Row& row) {
        const float half = rounded_depth(row[0], 16);
        CHECK(std::abs(half - row[0]) <= std::ldexp(row[0], -11));
        CHECK(std::abs(rounded_depth(row[0], 8) - row[0]) <= 0.5001f / 255.f);
        return Row{rounded_depth(row[0], 8), half, row[0]};
    });
}

TEST_CASE("a tile with planes of its own finds the layers that a list does") {
    const auto context = context_or_skip();
    if (!context) return;
    for (const int layers : {2, 5, 8, 16, 17, 64}) {
        CAPTURE(layers);
        const int images = (layers + 2) / 4;
        Random random;
        std::vector<float> planes(std::size_t(layers) + 1, 1.f);
        for (int k = 0; k < layers; ++k)
            planes[std::size_t(k)] = float(k * k) / float(layers * layers);
        std::vector<float> places(std::size_t(4 * images), 2.f);
        std::copy(planes.begin() + 1, planes.end() - 1, places.begin());
        opacity::gl::Texture texture{context, GL_TEXTURE_2D_ARRAY, GL_RGBA32F, 1, 1, images};
        texture.write(std::as_bytes(std::span{places}));
        Evaluator evaluator{
            context,
            {"#define TILE_PX 1\n#include \"lib/planes.glsl\"\n", 2, 2,
             "int layers = int(given(1)), layer = tile_layer_of(0, given(0), layers);\n"
             "result(0) = float(layer);\n"
             "result(1) = tile_plane(0, layer, layers);"}};
        evaluator.set_texture("t_tile_planes", std::move(texture));
        Table given;
        for (const float plane : planes)
            for (const float x : {plane, std::nextafter(plane, 0.f), std::nextafter(plane, 1.f)})
                given.push_back({x, float(layers)});
        for (int i = 0; i < 500; ++i) given.push_back({random(0, 1), float(layers)});
        check_agreement(given, evaluator(given), [&](const Row& row) {
            const int layer = layer_of(planes, row[0]);
            return Row{float(layer), planes[std::size_t(layer)]};
        });
    }
}

TEST_CASE("planes stand in the same channels in GLSL and C++, each in one of its own") {
    const auto context = context_or_skip();
    if (!context) return;
    for (const bool is_packed : {false, true}) {
        CAPTURE(is_packed);
        Evaluator evaluator{context,
                            {"#include \"lib/layer_map.glsl\"\n", 1, 2,
                             "int k = int(given(0)), slot = slot_of(k);\n"
                             "result(0) = float(slot);\n"
                             "result(1) = float(planes_of(slot / 4)[slot % 4]);",
                             is_packed ? gl::Defines{{"PACKED", "1"}} : gl::Defines{}}};
        Table given;
        for (int k = 1; k <= 64; ++k) given.push_back({float(k)});
        check_agreement(given, evaluator(given), [&](const Row& row) {
            const techniques::Slot slot = techniques::slot_of(int(row[0]), is_packed);
            CHECK_FALSE((is_packed && slot.target == 0 && slot.channel == 3));
            const techniques::Slot alone = techniques::slot_of(int(row[0]), is_packed, 1);
            CHECK(alone.channel == 0);
            CHECK(alone.target == 4 * slot.target + slot.channel);
            return Row{float(4 * slot.target + slot.channel), row[0]};
        });
    }
}

TEST_CASE("the blocks that a search looks at stand in the same places in GLSL and C++") {
    const auto context = context_or_skip();
    if (!context) return;
    for (const int stride : {1, 4, 7}) {
        CAPTURE(stride);
        Evaluator evaluator{
            context,
            {"#include \"lib/block_sample.glsl\"\n",
             2,
             5,
             "ivec2 texel = ivec2(given(0), given(1)), place = packed_place(texel);\n"
             "result(0) = is_sampled(texel) ? 1.0 : 0.0;\n"
             "result(1) = float(place.x);\n"
             "result(2) = float(place.y);\n"
             "result(3) = float(unpacked_texel(texel).x);\n"
             "result(4) = float(unpacked_texel(texel).y);",
             {{"BLOCK_STRIDE", std::to_string(stride)}}}};
        Random random;
        Table given;
        for (int i = 0; i < 2000; ++i)
            given.push_back({float(random.below(512)), float(random.below(512))});
        const BlockSample blocks{stride};
        check_agreement(given, evaluator(given), [&](const Row& row) {
            const int x = int(row[0]), y = int(row[1]);
            return Row{float(blocks.holds(x, y)), float(blocks.packed(x)), float(blocks.packed(y)),
                       float(blocks.unpacked(x)), float(blocks.unpacked(y))};
        });
    }
}

TEST_CASE("clusters of casters are the same in GLSL and C++") {
    const auto context = context_or_skip();
    if (!context) return;
    Evaluator evaluator{
        context,
        {"#define CLUSTERS 3\n#include \"lib/clusters.glsl\"\n", 7, 5,
         "float means[3] = float[3](given(0), given(1), given(2));\n"
         "vec3 sum = vec3(0.0), one;\n"
         "for (int i = 3; i < 6; ++i) {\n"
         "    one = cell_moments(cell_of(means, 1), given(i), given(i) + 0.2, 0.5, means[1]);\n"
         "    sum += one;\n"
         "}\n"
         "Cluster cluster = cluster_of(sum, means[1]);\n"
         "result(0) = cluster.mean;\n"
         "result(1) = cluster.reach;\n"
         "result(2) = optical_depth_before(given(6), cluster);\n"
         "one = cell_moments(cell_of(means, 1), given(5), given(5) + 0.2, 0.5, cluster.mean);\n"
         "cluster = without(cluster, one);\n"
         "result(3) = cluster.optical_depth;\n"
         "result(4) = cluster.optical_depth * cluster.mean;"}};
    Random random;
    Table given;
    for (int i = 0; i < 4000; ++i) {
        Row row{random(0, 0.3f), random(0.35f, 0.6f), random(0.65f, 1)};
        for (int k = 0; k < 4; ++k) row.push_back(random(0, 0.9f));
        given.push_back(row);
    }
    const auto in_cpp = [](const Row& row) {
        const std::array means{row[0], row[1], row[2]};
        const auto held = [&](float begin, float about) {
            return cell_moments(cell_of(means, 1), begin, begin + 0.2f, 0.5f, about);
        };
        ClusterMoments sum{};
        for (int i = 3; i < 6; ++i) {
            const ClusterMoments one = held(row[i], means[1]);
            sum = {sum.optical_depth + one.optical_depth, sum.first + one.first,
                   sum.second + one.second};
        }
        const Cluster cluster = cluster_of(sum, means[1]);
        const Cluster others = without(cluster, held(row[5], cluster.mean));
        return Row{cluster.mean, cluster.reach, optical_depth_before(row[6], cluster),
                   others.optical_depth, others.optical_depth * others.mean};
    };
    check_agreement(given, evaluator(given), in_cpp, 1e-4);
}
