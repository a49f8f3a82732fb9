// The renderer: the picture that it must be, whatever happened before.
#include "opacity/renderer.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <optional>

#include "gl_context.hpp"
#include "scratch_folder.hpp"
#include "small_renderer.hpp"

using namespace opacity;
using namespace small;
using doctest::Approx;

namespace {

// ---- techniques that declare too little ----

// Bounding opacity maps whose look-up lacks one of its reads.
class Forgetful : public Technique {
   public:
    explicit Forgetful(std::string forgotten)
        : Technique{"bounding_opacity_maps"}, forgotten_{std::move(forgotten)} {}
    std::string_view summary() const override { return "Forgets a read."; }
    std::string_view paper() const override { return "none"; }
    LookUp build(FrameGraph& graph, const ShadowInputs& inputs) override {
        LookUp look_up = complete_->build(graph, inputs);
        const auto forgotten = [this](const Source* read) {
            return read->name().substr(read->name().rfind('/') + 1) == forgotten_;
        };
        REQUIRE(std::erase_if(look_up.reads, forgotten) == 1);
        return look_up;
    }

   private:
    std::string forgotten_;
    std::unique_ptr<Technique> complete_ = make_technique("bounding_opacity_maps");
};

// A pass that draws with opacities and planes without declaring that it reads them.
class Careless : public Technique {
   public:
    Careless() : Technique{"bounding_opacity_maps"} {}
    std::string_view summary() const override { return "Declares nothing."; }
    std::string_view paper() const override { return "none"; }
    LookUp build(FrameGraph& graph, const ShadowInputs& inputs) override {
        Texture& opacity = graph.texture("opacity", inputs.map(Format::rgba32f, 1));
        const Defines defines{{"PASS_opacity", "1"},
                              {"WRITES_PLANES", "1"},
                              {"TARGETS", "1"},
                              {"FIRST_TARGET", "0"},
                              {"BLOCK_STRIDE", "1"}};
        graph.add({.name = "deposit",
                   .shader = inputs.caster_shader(shader_path(), true, defines),
                   .draws = &inputs.translucent,
                   .view = &inputs.light,
                   .writes = {&opacity}});
        return {.reads = {&opacity}};
    }
};

// ---- shaders on disk ----

// The shaders of a folder of their own, for renderers made while it lives.
class ShaderFolder {
   public:
    ShaderFolder() {
        if (const char* before = std::getenv("OPACITY_SHADER_DIR")) before_ = before;
        std::filesystem::copy(OPACITY_SOURCE_DIR "/cpp/shaders", folder_.path(),
                              std::filesystem::copy_options::recursive);
        setenv("OPACITY_SHADER_DIR", folder_.path().c_str(), 1);
    }
    ~ShaderFolder() {
        before_ ? setenv("OPACITY_SHADER_DIR", before_->c_str(), 1)
                : unsetenv("OPACITY_SHADER_DIR");
    }
    std::string text(const std::string& file) const {
        std::ifstream stream{folder_.file(file), std::ios::binary};
        return {std::istreambuf_iterator<char>{stream}, {}};
    }
    void write(const std::string& file, const std::string& text) const {
        folder_.write(file, text);
    }
    // Puts `after` where `before` stood, once; returns the line on which that is.
    int replace(const std::string& file, const std::string& before,
                const std::string& after) const {
        std::string changed = text(file);
        const std::size_t place = changed.find(before);
        REQUIRE(place != std::string::npos);
        const auto at = changed.begin() + std::ptrdiff_t(place);
        const auto line = 1 + std::count(changed.begin(), at, '\n');
        write(file, changed.replace(place, before.size(), after));
        return int(line);
    }

   private:
    ScratchFolder folder_;
    std::optional<std::string> before_;
};

const PassReport& row_of(const Renderer& renderer, const std::string& name) {
    for (const PassReport& row : renderer.report())
        if (row.name == name) return row;
    FAIL("no pass ", name);
    throw name;
}

// ---- pictures in closed form ----

double dot(const double3& a, const double3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double3 cross(const double3& a, const double3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double3 sum(const double3& a, const double3& b, double factor = 1.0) {
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
double3 unit(const double3& v) {
    return sum({}, v, 1.0 / std::sqrt(dot(v, v)));
}

// Where the line of sight through the middle of a pixel meets the plane z = 0.
double3 seen_on_ground(const Camera& camera, const Image& image, int x, int y) {
    const double3 ahead = unit(sum(camera.target(), camera.eye(), -1.0));
    const double3 right = unit(cross(ahead, camera.up())), up = cross(right, ahead);
    const double tangent = std::tan(camera.fov_deg() * std::numbers::pi / 360.0);
    const double across = (2.0 * (x + 0.5) / image.width - 1.0) * image.width / image.height;
    const double upward = 1.0 - 2.0 * (y + 0.5) / image.height;
    const double3 sight = sum(sum(ahead, right, tangent * across), up, tangent * upward);
    return sum(camera.eye(), sight, -camera.eye()[2] / sight[2]);
}

// Blinn 1977 on a surface whose normal is z: ambient, diffuse and the highlight, in the
// renderer's own default amounts.
double shaded(double color, double light, const double3& travel, const double3& to_eye, double t) {
    const double3 to_light = sum({}, unit(travel), -1.0);
    const double facing = std::max(0.0, to_light[2]);
    const double highlight = std::pow(std::max(0.0, unit(sum(to_light, to_eye))[2]), 40.0);
    return 0.12 * color + t * light * (color * facing + (facing > 0.0 ? 0.25 * highlight : 0.0));
}

}  // namespace

TEST_CASE("a read that the look-up uses and the technique does not return is named") {
    if (!context_or_skip()) return;
    Renderer renderer = small_renderer(hairy_scene());
    renderer.settings().strand_look_up.assign(std::string{"per_sample"});  // by lighting itself
    const Image expected = renderer.render();
    const std::pair<const char*, const char*> inputs[] = {{"planes", "u_planes"},
                                                          {"layers", "u_layers"},
                                                          {"start", "t_start"},
                                                          {"end", "t_end"},
                                                          {"opacity", "t_opacity"}};
    for (const auto& [forgotten, input] : inputs) {
        renderer.set_technique(std::make_shared<Forgetful>(forgotten));
        const std::string message = message_of<ShaderError>([&] { renderer.render(); });
        CHECK(contains(message, input));
        CHECK(contains(message, "\"lighting\""));
        CHECK(contains(message, ".reads"));
        for (const auto& [other, unnamed] : inputs)
            if (std::string{unnamed} != input) CHECK_FALSE(contains(message, unnamed));
        renderer.set_technique(make_technique("bounding_opacity_maps"));
        CHECK(same(renderer.render(), expected));
    }
}

TEST_CASE("a pass that declares less than its shader uses is an error before it draws") {
    if (!context_or_skip()) return;
    Renderer renderer = small_renderer(hairy_scene(), {}, std::make_shared<Careless>());
    for (int frame = 0; frame < 2; ++frame) {  // the second is not taken for cached
        const std::string message = message_of<ShaderError>([&] { renderer.render(); });
        CHECK(contains(message, "\"bounding_opacity_maps/deposit\""));
        for (const char* input : {"b_opacity", "u_opacity_stride", "t_start", "t_end",
                                  "t_opaque_depth", "u_layers", "u_planes"})
            CHECK(contains(message, input));
    }
    renderer.set_technique(make_technique("bounding_opacity_maps"));
    CHECK(same(renderer.render(), small_renderer(hairy_scene()).render()));
}

TEST_CASE("a shader edited on disk is drawn with at the next frame") {
    if (!context_or_skip()) return;
    const Image embedded = small_renderer(hairy_scene()).render();
    const ShaderFolder shaders;
    Renderer renderer = small_renderer(hairy_scene());
    CHECK(same(renderer.render(), embedded));
    renderer.render();
    CHECK(row_of(renderer, "lighting").status == PassReport::Status::cached);

    const std::string original = shaders.text("lib/samples.glsl");
    shaders.replace("lib/samples.glsl", "vec4(samples_color, 1.0)",
                    "vec4(0.5 * samples_color, 1.0)");
    const Image halved = renderer.render();
    CHECK(row_of(renderer, "lighting").status == PassReport::Status::ran);
    CHECK(contains(row_of(renderer, "lighting").why, "shaders"));
    for (std::size_t i = 0; i < halved.rgba.size(); ++i)
        CHECK(halved.rgba[i] == (i % 4 == 3 ? 1.f : 0.5f) * embedded.rgba[i]);
    CHECK_FALSE(same(halved, embedded));
    renderer.render();
    CHECK(row_of(renderer, "lighting").status == PassReport::Status::cached);

    shaders.write("lib/samples.glsl", original);
    CHECK(same(renderer.render(), embedded));
}

TEST_CASE("a shader broken on disk is an error with its place, until it is repaired") {
    if (!context_or_skip()) return;
    const ShaderFolder shaders;
    Renderer renderer = small_renderer(hairy_scene());
    const Image first = renderer.render();
    const std::pair<const char*, const char*> places[] = {
        {"lighting/surface.frag.glsl", "vec3 to_eye"},
        {"lib/shading.glsl", "float facing"},
        {"lib/layers.glsl", "int layer = layer_of(layers.curve, first)"}};
    for (const auto& [file, text] : places) {
        const std::string original = shaders.text(file);
        const int line = shaders.replace(file, text, std::string{"no_glsl "} + text);
        const std::string place = std::string{file} + ":" + std::to_string(line);
        for (int frame = 0; frame < 2; ++frame) {
            const std::string message = message_of<ShaderError>([&] { renderer.render(); });
            CHECK_MESSAGE(contains(message, place), message);
        }
        shaders.write(file, original);
        CHECK(same(renderer.render(), first));
    }
}

TEST_CASE("a square has the colour of Blinn's formula in every pixel, and no shadow on itself") {
    if (!context_or_skip()) return;
    const double3 travels[] = {{0, 0, -1}, {0.5, 0.3, -0.8}, {1, -1, -0.4}, {0.2, 0, 1}};
    for (const double3& travel : travels)
        for (const std::string& technique : technique_names()) {
            const DirectionalLight light{travel, {1.f, 0.5f, 0.25f}, 2.f};
            Renderer renderer =
                small_renderer(scene_of({square(0, 0.7, 1.f, {1.f, 0.6f, 0.3f})}, light), {},
                               make_technique(technique));
            const Image image = renderer.render();
            double worst = 0.0;
            for (int y = 0; y < image.height; ++y)
                for (int x = 0; x < image.width; ++x) {
                    const double3 p = seen_on_ground(above(), image, x, y);
                    const double from_edge = 0.7 - std::max(std::abs(p[0]), std::abs(p[1]));
                    if (std::abs(from_edge) < 1e-3) continue;
                    const double3 to_eye = unit(sum(above().eye(), p, -1.0));
                    const double color[] = {1.0, 0.6, 0.3}, lamp[] = {2.0, 1.0, 0.5};
                    for (int c = 0; c < 3; ++c) {
                        const double value =
                            from_edge < 0.0 ? 0.0 : shaded(color[c], lamp[c], travel, to_eye, 1.0);
                        worst = std::max(worst, std::abs(image.pixel(x, y)[c] - value));
                    }
                    worst =
                        std::max(worst, std::abs(image.pixel(x, y)[3] - double(from_edge > 0.0)));
                }
            CAPTURE(technique);
            CHECK(worst < 1e-4);
        }
}

TEST_CASE("a white square that faces light and camera is 1.37 at its centre, and T dims it") {
    if (!context_or_skip()) return;
    const Camera camera = Camera::look_at({0, 0, 2}, {0, 0, 0}, {0, 1, 0});
    const auto value_under = [&](float opacity, const std::string& technique) {
        // The sheet lies behind the camera, so that only the light sees it.
        Renderer renderer{scene_of({square(0, 1, 1.f, {1, 1, 1}), square(3, 2, opacity, {1, 1, 1})},
                                   DirectionalLight{{0, 0, -1}}),
                          camera, make_technique(technique)};
        make_small(renderer);
        renderer.set_size(11, 9);
        const Image image = renderer.render();
        return double(image.pixel(5, 4)[0]);
    };
    for (const std::string& technique : technique_names()) {
        CAPTURE(technique);
        for (const float opacity : {0.f, 0.4f, 0.9f, 1.f}) {
            const double lit = 0.12 + seen_by(technique, 1.0 - double(opacity)) * 1.25;
            CHECK(std::abs(value_under(opacity, technique) - lit) <= 1.25 * bound_of(technique));
        }
    }
}

TEST_CASE("pictures are premultiplied: an edge is the mean of square and background") {
    if (!context_or_skip()) return;
    const auto picture = [](const float4& background) {
        Renderer renderer = small_renderer(
            scene_of({square(0, 0.7, 1.f, {1.f, 0.5f, 0.f})}, DirectionalLight{{0, 0, -1}}));
        renderer.settings().antialiasing.assign(std::int64_t{4});
        renderer.settings().specular.assign(0.0);  // one colour all over
        renderer.set_background(background);
        return renderer.render();
    };
    const Image transparent = picture({1.f, 1.f, 1.f, 0.f}), tinted = picture({0.f, 1.f, 2.f, .5f});
    const double square[] = {1.12, 0.56, 0.0, 1.0}, behind[] = {0.0, 0.5, 1.0, 0.5};
    int edges = 0, outside = 0;
    for (int y = 0; y < transparent.height; ++y)
        for (int x = 0; x < transparent.width; ++x) {
            const float* pixel = transparent.pixel(x, y);
            const double covered = pixel[3], sixteenths = 16.0 * covered;
            CHECK(sixteenths == std::round(sixteenths));
            edges += covered > 0.0 && covered < 1.0;
            outside += covered == 0.0;
            for (int c = 0; c < 4; ++c) {
                CHECK(pixel[c] == Approx(covered * square[c]).epsilon(1e-5));
                CHECK(tinted.pixel(x, y)[c] ==
                      Approx(covered * square[c] + (1.0 - covered) * behind[c]).epsilon(1e-5));
            }
        }
    CHECK(edges > 20);
    CHECK(outside > 100);
}
