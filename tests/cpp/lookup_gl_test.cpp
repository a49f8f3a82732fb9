// The whole look-up stands twice, in GLSL and in C++: front test, opaque depth map, filter and the
// receiver's own deposit give the same T, to 1e-6, over the same made-up map.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "compute_harness.hpp"
#include "map/lookup.hpp"

using namespace opacity;
using harness::check_agreement;
using harness::Evaluator;
using harness::Random;
using harness::Row;
using harness::Table;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

// Every texel has casters spread evenly from some depth on, and counts the receiver's own softly,
// so that nothing jumps by a rounding.
class MadeUpMap : public TexelMap {
   public:
    explicit MadeUpMap(int size_px) : size_px_{size_px} {}
    float optical_depth(std::size_t texel, float depth, const OwnDeposit& own) const override {
        const int x = int(texel) % size_px_, y = int(texel) / size_px_;
        const float front = float((3 * x + 5 * y) % 7) / 8.f;
        const float density = float((7 * x + 13 * y) % 5);
        const float counted = std::clamp(4.f * (depth - own.depth), 0.f, 1.f);
        return density * std::max(std::min(depth, 2.f) - front, 0.f) - own.optical_depth * counted;
    }

   private:
    int size_px_;
};

constexpr const char* made_up_map = R"(
#include "lib/receiver.glsl"
float texel_optical_depth(ivec2 texel, float depth, OwnDeposit own) {
    float front = float((3 * texel.x + 5 * texel.y) % 7) / 8.0;
    float density = float((7 * texel.x + 13 * texel.y) % 5);
    float counted = clamp(4.0 * (depth - own.depth), 0.0, 1.0);
    return density * max(min(depth, 2.0) - front, 0.0) - own.optical_depth * counted;
}
#include "lib/lookup.glsl"
)";

struct Setup {
    const char* filter;  // as in FILTER_
    float radius;
    bool density = false;
    float bias = -1.f;
    int size_px = 16;
    std::optional<float> opaque_everywhere = {};
};

std::string name_of(const Setup& s) {
    return std::string{s.filter} + " " + std::to_string(s.radius) + (s.density ? " density" : "") +
           " bias " + std::to_string(s.bias) + " size " + std::to_string(s.size_px);
}

LightSpace space_of(const Setup& setup) {
    LightSpace space;
    space.map_size_px = setup.size_px;
    space.depth_range = 3.0;
    space.texels_per_unit = 5.0;
    space.least_bias = 0.01;
    return space;
}

// A third of the texels has an opaque caster.
std::vector<float> opaque_depth(const Setup& setup) {
    Random random{3};
    std::vector<float> depth;
    for (int i = 0; i < setup.size_px * setup.size_px; ++i)
        depth.push_back(setup.opaque_everywhere.value_or(random.below(3) ? 1.f : random(0, 1)));
    return depth;
}

// For bare points it lies somewhat farther from the light.
std::vector<float> opaque_moved(std::vector<float> depth) {
    for (float& d : depth)
        if (d < 1.f) d = std::min(1.02f * d, 1.f);
    return depth;
}

// Position, width in world units, opacity, width in texels, direction, ends, what it lies on: 12
// floats.
Row receiver_row(float x, float y, float z) {
    return {x, y, z, 0.f, 0.f, 0.f, 0.f, 0.f, 0.f, 0.f, 0.f, on_nothing};
}

Table receivers(int size_px, int count) {
    Random random;
    Table rows;
    for (int i = 0; i < count; ++i) {
        const float far = i % 8 ? 0.f : 40.f;  // some beside the map
        Row row = receiver_row(random(-far, size_px + far), random(-far, size_px + far),
                               random(-0.1f, 1.2f));
        if (i % 5 == 0) row[0] = std::round(2.f * row[0]) / 2.f;  // on edges and middles
        if (i % 10 == 0) row[1] = std::round(2.f * row[1]) / 2.f;
        row[3] = random.below(2) ? random(0, 0.3f) : 0.f;
        if (i % 3 == 1)  // on a strand
            row = {row[0],        row[1],        row[2],
                   row[3],        random(0, 1),  random(0.05f, 2),
                   random(-1, 1), 1.f,           random(-.1f, .1f),
                   -64.f,         random(0, 64), on_strand};
        if (i % 3 == 2)  // on a surface
            row = {row[0],
                   row[1],
                   row[2],
                   row[3],
                   random(0, 1),
                   0.f,
                   random(-.1f, .1f),
                   random(-.1f, .1f),
                   0.f,
                   0.f,
                   0.f,
                   on_surface};
        rows.push_back(row);
    }
    return rows;
}

class BothSides {
   public:
    BothSides(const std::shared_ptr<gl::Context>& context, const Setup& setup)
        : space_{space_of(setup)},
          map_{setup.size_px},
          opaque_depth_{opaque_depth(setup)},
          opaque_moved_{opaque_moved(opaque_depth_)},
          cpp_{space_, map_, {opaque_depth_, opaque_moved_}, filter_of(setup), setup.bias},
          glsl_{context, shader_of(setup)} {
        auto& program = glsl_.program();
        program.set("u_light_map_size_px", space_.map_size_px);
        program.set("u_light_depth_range", float(space_.depth_range));
        program.set("u_light_texels_per_unit", float(space_.texels_per_unit));
        program.set("u_light_least_bias", float(space_.least_bias));
        program.set("u_bias", setup.bias);
        program.set("u_filter_radius", setup.radius);
        program.set("u_filter_width", -1.f);
        glsl_.set_map("t_opaque_depth", setup.size_px, opaque_depth_);
        glsl_.set_map("t_opaque_moved", setup.size_px, opaque_moved_);
    }
    Table glsl(const Table& rows) { return glsl_(rows); }
    Row cpp(const Row& row) const {
        const Receiver receiver{.p_ls = {row[0], row[1], row[2]},
                                .width_texels = row[5],
                                .direction = {row[6], row[7], row[8]},
                                .opacity = row[4],
                                .ends = {row[9], row[10]},
                                .lies_on = row[11]};
        return {cpp_.transmittance(receiver, row[3])};
    }

   private:
    static Filter filter_of(const Setup& setup) {
        const std::string name = setup.filter;
        return {filter_kernel(name == "bilinear" ? "box" : name), setup.radius, -1.f,
                setup.density};
    }
    static harness::Shader shader_of(const Setup& setup) {
        harness::Shader shader{made_up_map, 12, 1,
                               "Receiver r = point_receiver(given3(0), given(3));\n"
                               "r.opacity = given(4); r.width_texels = given(5);\n"
                               "r.direction = given3(6); r.ends = given2(9);\n"
                               "r.on_strand = given(11) == 1.0; r.on_surface = given(11) == 2.0;\n"
                               "result(0) = shadow_transmittance(r);"};
        shader.defines = {{std::string{"FILTER_"} + setup.filter, "1"}, {"BARE_POINTS", "1"}};
        if (setup.density) shader.defines.emplace_back("DENSITY_FILTER", "1");
        return shader;
    }

    LightSpace space_;
    MadeUpMap map_;
    std::vector<float> opaque_depth_, opaque_moved_;
    MapLookUp cpp_;
    Evaluator glsl_;
};

}  // namespace

TEST_CASE("a look-up gives the same T in GLSL and C++, whatever the filter") {
    const auto context = context_or_skip();
    if (!context) return;
    const Setup setups[] = {{"bilinear", 0.5f},
                            {"bilinear", 0.5f, true},
                            {"bilinear", 0.5f, false, 0.05f},
                            {"bilinear", 0.5f, false, 0.f, 2},
                            {"box", 0.f},
                            {"box", 1.7f, false, -1.f, 3},
                            {"none", 0.5f, true},
                            {"none", 0.5f, false, 0.2f},
                            {"bartlett", 2.f},
                            {"bartlett", 3.3f, true, 0.1f},
                            {"gaussian", 2.5f},
                            {"gaussian", 32.f, true},
                            {"pcf", 2.f},
                            {"pcf", 5.f, true, 0.f}};
    for (const Setup& setup : setups) {
        CAPTURE(name_of(setup));
        BothSides sides{context, setup};
        const int count = setup.radius > 8.f ? 50 : 1000;
        const Table given = receivers(setup.size_px, count), found = sides.glsl(given);
        check_agreement(given, found, [&](const Row& row) { return sides.cpp(row); });
        int between = 0;
        for (std::size_t i = 0; i < given.size(); ++i) {
            const float cpp = sides.cpp(given[i])[0];
            REQUIRE((cpp >= 0.f && cpp <= 1.f));
            REQUIRE((found[i][0] >= 0.f && found[i][0] <= 1.f));
            between += cpp > 0.f && cpp < 1.f;
        }
        CHECK(between > count / 5);
    }
}

TEST_CASE("T is 1 exactly where nothing is in front, and where a coordinate is not finite") {
    const auto context = context_or_skip();
    if (!context) return;
    Table lit{receiver_row(8, 8, 0),      receiver_row(8, 8, -1e30f), receiver_row(-34, 8, 1),
              receiver_row(8, 49.5f, 1),  receiver_row(1e18f, 8, 1),  receiver_row(8, -1e18f, 1),
              receiver_row(-1.f, 8, 0.9f)};
    for (const float value : {infinity, -infinity, not_a_number})
        lit.insert(lit.end(), {receiver_row(value, 8, 1), receiver_row(8, value, 1),
                               receiver_row(value, value, value)});
    lit.insert(lit.end(), {receiver_row(8, 8, not_a_number), receiver_row(8, 8, -infinity)});
    for (const char* filter : {"bilinear", "none", "box"}) {
        CAPTURE(std::string{filter});
        BothSides sides{context, {filter, 0.5f}};
        const Table found = sides.glsl(lit);
        for (std::size_t i = 0; i < lit.size(); ++i) {
            CAPTURE(harness::text_of(lit[i]));
            CHECK(found[i][0] == 1.f);
            CHECK(sides.cpp(lit[i])[0] == 1.f);
        }
        // Endlessly far behind all casters T is what it is anywhere behind them.
        const Table behind = sides.glsl({receiver_row(8, 8, infinity), receiver_row(8, 8, 5)});
        CHECK(behind[0] == behind[1]);
        CHECK(sides.cpp(receiver_row(8, 8, infinity)) == sides.cpp(receiver_row(8, 8, 5)));
    }
}

TEST_CASE("behind an opaque caster T is 0 exactly, and at its own depth it does not count") {
    const auto context = context_or_skip();
    if (!context) return;
    for (const bool density : {false, true})
        for (const char* filter : {"bilinear", "none", "gaussian", "pcf"}) {
            CAPTURE(std::string{filter});
            BothSides sides{context, {filter, 1.f, density, 0.f, 16, 0.25f}};
            const Row at = receiver_row(8.3f, 7.9f, 0.25f),
                      behind = receiver_row(8.3f, 7.9f, 0.26f);
            const Table found = sides.glsl({at, behind});
            CHECK(found[0][0] > 0.5f);
            CHECK(sides.cpp(at)[0] > 0.5f);
            CHECK(found[1][0] == 0.f);
            CHECK(sides.cpp(behind)[0] == 0.f);
        }
}

TEST_CASE("a bias of auto is the strand's width, at least that of the light") {
    const auto context = context_or_skip();
    if (!context) return;
    // A single opaque sheet: T jumps from 1 to 0 where the bias ends.
    const float sheet = 0.25f, range = 3.f, least_bias = 0.01f;
    for (const float given : {-1.f, 0.f, 0.06f})
        for (const float width : {0.f, 0.002f, 0.3f}) {
            const float bias = given < 0.f ? std::max(width, least_bias) : given;
            CAPTURE(bias);
            BothSides sides{context, {"none", 0.5f, false, given, 16, sheet}};
            Row in_front = receiver_row(10, 10, sheet + bias / range - 1e-4f);
            Row behind = receiver_row(10, 10, sheet + bias / range + 1e-4f);
            in_front[3] = behind[3] = width;
            in_front[11] = behind[11] = on_strand;  // which sees the sheet where it is
            const Table found = sides.glsl({in_front, behind});
            CHECK(found[0][0] > 0.f);
            CHECK(sides.cpp(in_front)[0] > 0.f);
            CHECK(found[1][0] == 0.f);
            CHECK(sides.cpp(behind)[0] == 0.f);
        }
}

// Weights of texels that a filter just touches are differences of nearly equal numbers.
TEST_CASE("no filter makes T leave 0 .. 1 at the edge of what is dark") {
    const auto context = context_or_skip();
    if (!context) return;
    Random random;
    for (const char* filter : {"bartlett", "gaussian", "box"}) {
        CAPTURE(std::string{filter});
        for (const float radius : {0.7f, 8.f, 32.f}) {
            BothSides sides{context, {filter, radius, false, 0.f, 4, 0.f}};
            Table given;
            for (int i = 0; i < (radius > 8.f ? 200 : 2000); ++i) {
                // Beside the map, with its corner just inside the filter.
                const float touch = 4.f + radius - std::pow(10.f, random(-7, 0));
                given.push_back(receiver_row(touch, random.below(2) ? touch : 2.f, 0.9f));
            }
            const Table found = sides.glsl(given);
            for (std::size_t i = 0; i < given.size(); ++i) {
                CAPTURE(harness::text_of(given[i]));
                REQUIRE((found[i][0] >= 0.f && found[i][0] <= 1.f));
                const float cpp = sides.cpp(given[i])[0];
                REQUIRE((cpp >= 0.f && cpp <= 1.f));
            }
            CHECK(sides.glsl({receiver_row(2, 2, 0.9f)})[0][0] < 1.f);
        }
    }
}
