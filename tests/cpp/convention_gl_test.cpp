// The conventions stand twice, in GLSL and in C++: both make the same of the same floats, to 1e-6
// (absolute up to 1, relative above; harness::difference).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compute_harness.hpp"
#include "core/opacity.hpp"
#include "map/filter.hpp"
#include "map/fragments.hpp"
#include "map/own_deposit.hpp"
#include "map/planes.hpp"
#include "map/ribbon.hpp"
#include "map/surface.hpp"
#include "opacity/core/split.hpp"

using namespace opacity;
using harness::check_agreement;
using harness::Evaluator;
using harness::Random;
using harness::Row;
using harness::Table;

namespace {

// ---- segments ----

enum class Kind { anyhow, thin, wide, steep, diagonal, along_axis, on_grid, dot, count };

// Root, tip, widths at both, and the middle of a texel near the segment: 10 floats.
Row segment_row(Random& random) {
    const Kind kind = Kind(random.below(int(Kind::count)));
    float x = random(8, 24), y = random(8, 24);
    const float angle = random(-float(std::numbers::pi), float(std::numbers::pi));
    const float length = std::exp(random(-5, 4));
    float dx = length * std::cos(angle), dy = length * std::sin(angle);
    if (kind == Kind::steep) dx *= 1e-3f;
    if (kind == Kind::diagonal) dx = dy;
    if (kind == Kind::along_axis) (random.below(2) ? dx : dy) = 0.f;
    if (kind == Kind::dot) dx = dy = 0.f;
    if (kind == Kind::on_grid) {
        const auto snap = [](float& v) { v = std::round(2.f * v) / 2.f; };
        snap(x), snap(y), snap(dx), snap(dy);
    }
    const float least = kind == Kind::wide ? 1.f : 0.f, most = kind == Kind::thin ? 0.05f : 4.f;
    const float along = random(-0.1f, 1.1f);
    const float texel_x = std::floor(x + along * dx + random(-2, 2)) + 0.5f;
    const float texel_y = std::floor(y + along * dy + random(-2, 2)) + 0.5f;
    return {x,
            y,
            random(0, 1),
            x + dx,
            y + dy,
            random(0, 1),
            random(least, most),
            random(least, most),
            texel_x,
            texel_y};
}

Table segment_rows(int count) {
    Random random;
    Table rows;
    for (int i = 0; i < count; ++i) {
        rows.push_back(segment_row(random));
        // Its two parts, which share the point at which it was cut.
        const Row whole = rows.back();
        const float cut = random(0, 1);
        Row first = whole, second = whole;
        for (std::size_t axis = 0; axis < 3; ++axis)
            first[3 + axis] = second[axis] = whole[axis] * (1.f - cut) + whole[3 + axis] * cut;
        first[7] = second[6] = whole[6] * (1.f - cut) + whole[7] * cut;
        rows.push_back(first);
        rows.push_back(second);
    }
    return rows;
}

MajorSegment segment_of(const Row& row) {
    return {{row[0], row[1], row[2]}, {row[3], row[4], row[5]}};
}

// A row of ribbon_coverage's, or of line_coverage's, result.
Row coverage_row(const std::optional<Coverage>& c) {
    if (!c) return {0, 0, 0, 0, 0};
    return {1, c->along, c->across, c->place, c->depth};
}

harness::Shader coverage_shader(const std::string& call) {
    return {"#include \"lib/ribbon.glsl\"\n", 10, 5,
            "MajorSegment s = major_segment(given3(0), given3(3));\n"
            "Coverage c;\n"
            "bool covered = " +
                call +
                ";\n"
                "result(0) = covered ? 1.0 : 0.0;\n"
                "result(1) = c.along; result(2) = c.across;\n"
                "result(3) = c.place; result(4) = c.depth;"};
}

// The part of the rows whose first number is 1.
double part_covered(const Table& rows) {
    const auto covered = std::ranges::count_if(rows, [](const Row& r) { return r[0] == 1.f; });
    return double(covered) / double(rows.size());
}

// ---- spaces ----

LightSpace some_space() {
    LightSpace space;
    space.map_size_px = 32;
    space.depth_range = 2.5;
    space.texels_per_unit = 12.0;
    space.least_bias = 1e-3;
    return space;
}

void set_space(Evaluator& evaluator, const LightSpace& space) {
    auto& program = evaluator.program();
    program.set("u_light_map_size_px", space.map_size_px);
    program.set("u_light_depth_range", float(space.depth_range));
    program.set("u_light_texels_per_unit", float(space.texels_per_unit));
    program.set("u_light_least_bias", float(space.least_bias));
}

}  // namespace

TEST_CASE("opacity to optical depth is the same in GLSL and C++, relative to its size") {
    const auto context = context_or_skip();
    if (!context) return;
    Evaluator evaluator{
        context,
        {"#include \"lib/opacity.glsl\"\n", 1, 1, "result(0) = optical_depth_of(given(0));"}};
    Random random;
    Table given{{0.f}, {1.f}, {2.f}, {-1.f}, {0.5f}, {std::nextafter(0.5f, 0.f)}};
    for (float rest = 0.5f; rest >= 1.f / 16777216.f; rest *= 0.5f) given.push_back({1.f - rest});
    for (int i = 0; i < 4000; ++i) {
        given.push_back({std::pow(10.f, random(-8, 0))});
        given.push_back({1.f - std::pow(10.f, random(-7, 0))});
    }
    const Table found = evaluator(given);
    CHECK(found[0][0] == 0.f);
    for (std::size_t i = 0; i < given.size(); ++i) {
        const double a = std::clamp(double(given[i][0]), 0.0, 1.0 - 1.0 / 16777216.0);
        const double exact = -std::log1p(-a);
        REQUIRE(std::abs(found[i][0] - exact) <= 1e-6 * exact);
        REQUIRE(std::abs(optical_depth_of(given[i][0]) - exact) <= 1e-6 * exact);
    }
}

TEST_CASE("ribbon coverage is the same in GLSL and C++") {
    const auto context = context_or_skip();
    if (!context) return;
    Evaluator evaluator{context, coverage_shader("ribbon_coverage(s, given2(6), given2(8), c)")};
    const Table given = segment_rows(4000), found = evaluator(given);
    check_agreement(given, found, [](const Row& row) {
        const MajorSegment s = segment_of(row);
        return coverage_row(ribbon_coverage(s, row[6], row[7], s.steep ? row[9] : row[8],
                                            s.steep ? row[8] : row[9]));
    });
    CHECK(part_covered(found) > 0.2);
    CHECK(part_covered(found) < 0.8);
}

TEST_CASE("line coverage is the same in GLSL and C++") {
    const auto context = context_or_skip();
    if (!context) return;
    Evaluator evaluator{context, coverage_shader("line_coverage(s, given2(8), c)")};
    const Table given = segment_rows(4000), found = evaluator(given);
    check_agreement(given, found, [](const Row& row) {
        const MajorSegment s = segment_of(row);
        return coverage_row(line_coverage(s, s.steep ? row[9] : row[8], s.steep ? row[8] : row[9]));
    });
    CHECK(part_covered(found) > 0.02);
}

TEST_CASE("the position between two bounds is the same in GLSL and C++") {
    const auto context = context_or_skip();
    if (!context) return;
    Evaluator evaluator{context,
                        {"#include \"lib/planes.glsl\"\n", 3, 1,
                         "result(0) = between(given(0), given(1), given(2));"}};
    Random random;
    Table given{{0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.7f}, {1.f, 0.f, 0.5f}, {0.f, 1.f, 2.f}};
    for (int i = 0; i < 2000; ++i) {
        const float a = random(0, 1), b = a + std::pow(10.f, random(-7, 0));
        given.insert(given.end(), {{a, b, a}, {a, b, b}, {a, a, b}, {b, a, a}});
        given.insert(given.end(), {{a, b, random(a, b)}, {a, b, random(-1, 2)}});
    }
    check_agreement(given, evaluator(given),
                    [](const Row& row) { return Row{between(row[0], row[1], row[2])}; });
}

TEST_CASE("the layer of a position, and what is counted of it, are the same in GLSL and C++") {
    const auto context = context_or_skip();
    if (!context) return;
    Evaluator evaluator{context,
                        {"#include \"lib/planes.glsl\"\n", 5, 3,
                         "result(0) = float(layer_of(0, given(0)));\n"
                         "result(1) = counted(0, given(0), given(1), int(given(2)), given(3));\n"
                         "result(2) = counted_at(0, int(given(4)), given(0), given(1));"}};
    Random random;
    for (int layers = 1; layers <= 64; ++layers) {
        CAPTURE(layers);
        const std::vector<float> planes = layer_planes(layers, random(0, 1));
        evaluator.program().set("u_layers", layers);
        evaluator.program().set("u_planes", planes);
        Table given;
        const auto ask = [&](float x) {
            const float begin = std::clamp(x, 0.f, 1.f);
            const float end = random.below(2) ? random(begin, 1) : begin;  // a point
            given.push_back({begin, end, float(random.below(layers)), random(0, 1),
                             float(random.below(layers + 1))});
        };
        for (const float plane : planes)
            ask(plane), ask(std::nextafter(plane, 0.f)), ask(std::nextafter(plane, 2.f));
        for (int i = 0; i < 64; ++i) ask(random(0, 1));
        check_agreement(given, evaluator(given), [&](const Row& row) {
            const int layer = layer_of(planes, row[0]);
            CHECK(planes[std::size_t(layer)] <= row[0]);
            CHECK((layer == layers - 1 || row[0] < planes[std::size_t(layer) + 1]));
            return Row{float(layer), counted(planes, row[0], row[1], int(row[2]), row[3]),
                       counted_at(planes, int(row[4]), row[0], row[1])};
        });
    }
}

TEST_CASE("filter weights are the same in GLSL and C++, none below 0, and add up to 1") {
    const auto context = context_or_skip();
    if (!context) return;
    for (const char* name : {"box", "bartlett", "gaussian"}) {
        CAPTURE(name);
        const FilterKernel kernel = filter_kernel(name);
        Evaluator evaluator{context,
                            {"#include \"lib/filter.glsl\"\n",
                             2,
                             1,
                             "result(0) = filter_weight(given(0), given(1));",
                             {{std::string{"FILTER_"} + name, "1"}}}};
        Random random;
        Table given;
        std::vector<std::size_t> first_of;  // of each receiver
        for (int i = 0; i < 300; ++i) {
            const float radius = i == 0 ? 1.f / 1024.f : i == 1 ? 32.f : std::exp(random(-3, 3.4f));
            const float p = i % 4 ? random(0, 1) : 0.25f * float(random.below(4));
            first_of.push_back(given.size());
            for (float x = std::floor(p - radius); x < std::ceil(p + radius); ++x)
                given.push_back({x - p, radius});
        }
        first_of.push_back(given.size());
        const Table found = evaluator(given);
        const auto expected = [&](const Row& row) {
            return Row{filter_weight(kernel, row[0], row[1])};
        };
        check_agreement(given, found, expected);
        for (std::size_t i = 0; i + 1 < first_of.size(); ++i) {
            double glsl = 0.0, cpp = 0.0;
            for (std::size_t k = first_of[i]; k < first_of[i + 1]; ++k) {
                REQUIRE(found[k][0] >= 0.f);
                REQUIRE(expected(given[k])[0] >= 0.f);
                glsl += found[k][0], cpp += expected(given[k])[0];
            }
            REQUIRE(std::abs(glsl - 1.0) < 1e-5);
            REQUIRE(std::abs(cpp - 1.0) < 1e-5);
        }
    }
}

TEST_CASE("a filter's radius follows its width, and stays within its limits") {
    const auto context = context_or_skip();
    if (!context) return;
    Evaluator evaluator{
        context,
        {"#include \"lib/filter.glsl\"\n", 1, 1, "result(0) = filter_radius_texels(given(0));"}};
    const auto radius = [&](float radius_texels, float width, float texels_per_unit) {
        evaluator.program().set("u_filter_radius", radius_texels);
        evaluator.program().set("u_filter_width", width);
        return evaluator({{texels_per_unit}})[0][0];
    };
    CHECK(radius(2.f, -1.f, 7.f) == 2.f);
    CHECK(radius(2.f, 3.f, 7.f) == 10.5f);
    CHECK(radius(2.f, 1e9f, 7.f) == largest_filter_radius);
    CHECK(radius(0.f, -1.f, 7.f) == 1.f / 1024.f);
    CHECK(radius(2.f, 0.f, 7.f) == 1.f / 1024.f);
}

TEST_CASE("a surface's margin is the same in GLSL and C++") {
    const auto context = context_or_skip();
    if (!context) return;
    const LightSpace space = some_space();
    Evaluator evaluator{context,
                        {"#include \"lib/surface.glsl\"\n", 2, 1,
                         "result(0) = surface_margin(given2(0), u_light_texels_per_unit);"}};
    set_space(evaluator, space);
    const float largest = largest_surface_margin(float(space.texels_per_unit), space.depth_range);
    Random random;
    Table given{{0, 0}, {1e20f, 1e20f}, {-1e20f, 0}, {largest, 0}};
    for (int i = 0; i < 2000; ++i) {
        const float size = std::pow(10.f, random(-6, 1));
        given.push_back({size * random(-1, 1), size * random(-1, 1)});
    }
    check_agreement(given, evaluator(given), [&](const Row& row) {
        return Row{surface_margin({row[0], row[1]}, largest)};
    });
}

// Corners on a grid, on which the products of differences are exact floats.
TEST_CASE("the slope of a triangle gives it the same margin in GLSL and C++") {
    const auto context = context_or_skip();
    if (!context) return;
    const LightSpace space = some_space();
    Evaluator evaluator{context,
                        {"#include \"lib/surface.glsl\"\n", 6, 3,
                         "vec2 slope = surface_slope(given3(0), given3(3));\n"
                         "result(0) = slope.x; result(1) = slope.y;\n"
                         "result(2) = surface_margin(slope, u_light_texels_per_unit);"}};
    set_space(evaluator, space);
    Random random;
    Table given;
    while (given.size() < 2000) {
        Row row;
        for (int k = 0; k < 6; ++k)
            row.push_back(k % 3 == 2 ? float(random.below(64) - 32) / 256.f
                                     : float(random.below(256) - 128) / 16.f);
        if (row[0] * row[4] - row[1] * row[3] != 0.f) given.push_back(row);
    }
    const float largest = largest_surface_margin(float(space.texels_per_unit), space.depth_range);
    // A triangle with these two edges, about the middle of the map.
    const auto expected = [&](const Row& e) {
        const double determinant = double(e[0]) * e[4] - double(e[1]) * e[3];
        const double x = (double(e[2]) * e[4] - double(e[1]) * e[5]) / determinant;
        const double y = (double(e[0]) * e[5] - double(e[2]) * e[3]) / determinant;
        float margin = surface_margin({float(x), float(y)}, largest);
        triangle_texels(
            {{{16, 16, 0, 0}, {16 + e[0], 16 + e[1], e[2], 0}, {16 + e[3], 16 + e[4], e[5], 0}}},
            space, {0, space.map_size_px},
            [&](const TriangleTexel& texel) { margin = texel.margin; });
        return Row{float(x), float(y), margin};
    };
    check_agreement(given, evaluator(given), expected);
    // The light grazes it: beyond every margin.
    const Table grazed = evaluator({{1, 0, 1, 2, 0, 3}, {0, 0, 1, 1, 1, 0}});
    for (const Row& row : grazed) CHECK(row[2] == largest);
}

TEST_CASE("a receiver's own deposit is the same in GLSL and C++") {
    const auto context = context_or_skip();
    if (!context) return;
    const LightSpace space = some_space();
    Evaluator evaluator{
        context,
        {"#include \"lib/receiver.glsl\"\n", 13, 3,
         "Receiver r = point_receiver(given3(0), 0.0); r.opacity = given(4);\n"
         "r.width_texels = given(3); r.direction = given3(5); r.ends = given2(8);\n"
         "r.on_strand = given(12) == 1.0; r.on_surface = given(12) == 2.0;\n"
         "OwnDeposit own = own_deposit(r, own_segment(r), ivec2(given2(10)));\n"
         "result(0) = own.depth; result(1) = own.depth_end; result(2) = own.optical_depth;"}};
    set_space(evaluator, space);
    Random random;
    Table given;
    for (int i = 0; i < 8000; ++i) {
        const float x = random(4, 28), y = random(4, 28), opacity = random(-0.2f, 1.f);
        const bool surface = i % 3 == 0, steep = i % 2 == 0;
        const float minor = random(-1, 1), sign = i % 5 ? 1.f : -1.f, size = random(0, 0.4f);
        const float ends[] = {-endless_texels, -random(0, 3), 0.f, endless_texels, random(0, 3)};
        Row row{x, y, random(0, 1), surface ? 0.f : std::exp(random(-4, 1)), opacity};
        if (surface)
            row.insert(row.end(), {size * random(-1, 1), size * random(-1, 1), 0.f});
        else
            row.insert(row.end(), {steep ? minor : sign, steep ? sign : minor, random(-.1f, .1f)});
        row.insert(row.end(), {ends[random.below(3)], ends[2 + random.below(3)]});
        const float reach = i % 7 ? 2.f : 9.f;
        row.insert(row.end(),
                   {std::floor(x + random(-reach, reach)), std::floor(y + random(-reach, reach))});
        row.push_back(surface ? on_surface : i % 11 ? on_strand : on_nothing);  // in a particle
        given.push_back(row);
    }
    const Table found = evaluator(given);
    check_agreement(
        given, found,
        [&](const Row& row) {
            const Receiver receiver{.p_ls = {row[0], row[1], row[2]},
                                    .width_texels = row[3],
                                    .direction = {row[5], row[6], row[7]},
                                    .opacity = row[4],
                                    .ends = {row[8], row[9]},
                                    .lies_on = row[12]};
            const OwnDeposit own =
                own_deposit(seen(receiver, space), int(row[10]), int(row[11]), space.depth_range);
            return Row{own.depth, own.depth_end, own.optical_depth};
        },
        1e-5);
    const auto something = std::ranges::count_if(found, [](const Row& r) { return r[2] > 0.f; });
    CHECK(something > 2000);
}
