// The renderer without OpenGL: what it answers, what it refuses, and what it does not do again.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "opacity/core/error.hpp"
#include "scratch_folder.hpp"
#include "small_renderer.hpp"

using namespace opacity;
using namespace small;
using doctest::Approx;

namespace {

Renderer cpu_renderer(const std::shared_ptr<Scene>& scene,
                      std::shared_ptr<Technique> technique = {}) {
    Renderer renderer = Renderer::on_cpu(scene, std::move(technique));
    renderer.settings().map_size.assign(std::int64_t{32});
    return renderer;
}

Positions some_points() {
    std::vector<double> xyz;
    for (int i = 0; i < 60; ++i)
        xyz.insert(xyz.end(), {0.04 * i - 1.2, 0.3 * std::sin(double(i)), 0.01 * i});
    return Positions{std::move(xyz)};
}

const PassReport& row_of(const Renderer& renderer, const std::string& name) {
    for (const PassReport& row : renderer.report())
        if (row.name == name) return row;
    FAIL("no pass ", name);
    throw name;
}

using Status = PassReport::Status;

// Draws with a shader, and has no other form.
class ShaderOnly : public Technique {
   public:
    ShaderOnly() : Technique{"bounding_opacity_maps"} {}
    std::string_view summary() const override { return "Wants a GPU."; }
    std::string_view paper() const override { return "none"; }
    LookUp build(FrameGraph& graph, const ShadowInputs& inputs) override {
        Texture& map = graph.texture("shader_map", inputs.map(Format::r32f));
        graph.add({.name = "deposit",
                   .shader = inputs.caster_shader(shader_path(), false),
                   .draws = &inputs.translucent,
                   .view = &inputs.light,
                   .writes = {&map}});
        return look_up(inputs, {&map});
    }
};

// Its pass has a form in C++ that draws all the same.
class DrawsOnCpu : public Technique {
   public:
    DrawsOnCpu() : Technique{"bounding_opacity_maps"} {}
    std::string_view summary() const override { return "Draws without a GPU."; }
    std::string_view paper() const override { return "none"; }
    LookUp build(FrameGraph& graph, const ShadowInputs& inputs) override {
        Texture& map = graph.texture("shader_map", inputs.map(Format::r32f));
        graph.add({.name = "deposit",
                   .shader = inputs.caster_shader(shader_path(), false),
                   .draws = &inputs.translucent,
                   .view = &inputs.light,
                   .writes = {&map},
                   .on_cpu = [](PassContext& context) { context.draw(); }});
        return look_up(inputs, {&map});
    }
};

}  // namespace

TEST_CASE("without OpenGL every technique answers: sheets, opaque casters, nothing") {
    // Two sheets above each other, an opaque square beside them, and light from above.
    const auto sheet = square(2, 1, 0.5f, {1, 1, 1}), second = square(1, 1, 0.2f, {1, 1, 1});
    double4x4 beside = identity;
    beside[3] = 3.0;
    const auto opaque = square(2, 0.5, 1.f, {1, 1, 1});
    opaque->set_transform(beside);
    const Positions points{
        std::vector<double>{0, 0, 3, 0, 0, 1.5, 0, 0, 0, 3, 0, 0, 3, 0, 2.5, -9, 9, 0}};
    for (const std::string& name : technique_names()) {
        CAPTURE(name);
        Renderer renderer = cpu_renderer(
            scene_of({sheet, second, opaque}, DirectionalLight{{0, 0, -1}}), make_technique(name));
        CHECK(renderer.is_on_cpu());
        const std::vector<float> t = renderer.transmittance(points);
        const double expected[] = {1.0, 0.5, 0.4, 0.0, 1.0, 1.0};
        REQUIRE(t.size() == 6);
        for (std::size_t i = 0; i < 6; ++i)
            CHECK(std::abs(t[i] - seen_by(name, expected[i])) <= bound_of(name));
        CHECK(renderer.transmittance(*second).size() == 4);
        CHECK(renderer.transmittance(Positions{std::vector<double>{}}).empty());
    }
}

TEST_CASE("without OpenGL a scene without casters, or without a light, lets all light through") {
    const auto one = [](const std::vector<float>& t) {
        return std::ranges::all_of(t, [](float v) { return v == 1.f; });
    };
    for (const std::string& name : technique_names()) {
        CHECK(one(cpu_renderer(scene_of({}, DirectionalLight{}), make_technique(name))
                      .transmittance(some_points())));
        const auto dark = std::make_shared<Scene>();
        dark->add(square(1, 1, 0.5f, {1, 1, 1}));
        CHECK(one(cpu_renderer(dark, make_technique(name)).transmittance(some_points())));
    }
}

TEST_CASE("without OpenGL pictures and the context are errors that say what to do") {
    Renderer renderer = cpu_renderer(hairy_scene());
    for (const std::string& message :
         {message_of<ContextError>([&] { renderer.render(); }),
          message_of<ContextError>([&] { renderer.receivers(); }),
          message_of<ContextError>([&] { static_cast<void>(renderer.context()); })}) {
        CHECK(contains(message, "CPU"));
        CHECK(contains(message, "device=\"gpu\""));
    }
    CHECK_THROWS_AS(Renderer::on_cpu(nullptr), ParameterError);
    CHECK_THROWS_AS(renderer.transmittance(some_points(), 1), ParameterError);
    CHECK_THROWS_AS(renderer.transmittance(Positions{std::vector<double>{NAN, 0, 0}}),
                    ParameterError);
    // It answers as before.
    const std::vector<float> t = renderer.transmittance(some_points());
    CHECK(t == cpu_renderer(hairy_scene()).transmittance(some_points()));
}

TEST_CASE("a pass without a form in C++ is an error that names it, and what to do") {
    Renderer renderer = cpu_renderer(hairy_scene(), std::make_shared<ShaderOnly>());
    for (int frame = 0; frame < 2; ++frame) {  // the second is not taken for cached
        const std::string message =
            message_of<ParameterError>([&] { renderer.transmittance(some_points()); });
        CHECK(contains(message, "\"bounding_opacity_maps/deposit\""));
        CHECK(contains(message, "device=\"gpu\""));
    }
    renderer.set_technique(std::make_shared<DrawsOnCpu>());
    const std::string message =
        message_of<ParameterError>([&] { renderer.transmittance(some_points()); });
    CHECK(contains(message, "\"bounding_opacity_maps/deposit\""));
    CHECK(contains(message, ".on_cpu"));

    renderer.set_technique(make_technique("bounding_opacity_maps"));
    CHECK(renderer.transmittance(some_points()) ==
          cpu_renderer(hairy_scene()).transmittance(some_points()));
}

TEST_CASE("without OpenGL the report tells what ran, what was kept, and what nobody needs") {
    const auto scene = hairy_scene();
    Renderer renderer = cpu_renderer(scene);
    const Positions points = some_points();
    const std::vector<float> first = renderer.transmittance(points);
    const std::string technique = "bounding_opacity_maps/";
    for (const char* pass : {"bounds", "opacity"})
        CHECK(row_of(renderer, technique + pass).status == Status::ran);
    CHECK(row_of(renderer, "opaque_depth").status == Status::ran);
    CHECK(row_of(renderer, "transmittance").status == Status::ran);
    CHECK(row_of(renderer, "lighting").status == Status::culled);

    CHECK(renderer.transmittance(points) == first);
    for (const char* pass : {"bounds", "opacity"})
        CHECK(row_of(renderer, technique + pass).status == Status::cached);
    CHECK(row_of(renderer, "transmittance").status == Status::cached);

    scene->shapes()[0]->set_opacity({0.9f});  // the bounds stay
    CHECK(renderer.transmittance(points) != first);
    CHECK(row_of(renderer, technique + "bounds").status == Status::cached);
    CHECK(row_of(renderer, technique + "opacity").status == Status::ran);
    CHECK(contains(row_of(renderer, technique + "opacity").why, "opacity"));

    scene->shapes()[0]->set_color({{0, 0, 1}});
    renderer.transmittance(points);
    CHECK(row_of(renderer, technique + "opacity").status == Status::cached);

    scene->shapes()[0]->set_casts(false);  // nothing translucent is left
    renderer.transmittance(points);
    for (const char* pass : {"bounds", "opacity"})
        CHECK(row_of(renderer, technique + pass).status == Status::culled);
}

TEST_CASE("without OpenGL maps can be read: bounds, and layers that only grow") {
    Renderer renderer = cpu_renderer(hairy_scene());
    renderer.transmittance(some_points());
    const TextureContent start = renderer.read("bounding_opacity_maps/start");
    const TextureContent end = renderer.read("bounding_opacity_maps/end");
    const TextureContent opacity = renderer.read("bounding_opacity_maps/opacity");
    CHECK(start.width == 32);
    CHECK(start.layers == 0);
    CHECK(opacity.channels == 4);
    CHECK(opacity.layers == 4);  // 16 planes
    REQUIRE(opacity.values.size() == std::size_t(4 * 4 * 32 * 32));
    int covered = 0;
    for (std::size_t texel = 0; texel < 32 * 32; ++texel) {
        const auto plane = [&](std::size_t k) {
            return opacity.values[4 * (k / 4 * 32 * 32 + texel) + k % 4];
        };
        const bool empty = start.values[texel] == 1.f && end.values[texel] == 0.f;
        if (!empty) CHECK(start.values[texel] <= end.values[texel]);
        for (std::size_t k = 0; k + 1 < 16; ++k) REQUIRE(plane(k) <= plane(k + 1));
        CHECK((plane(15) > 0.f) == !empty);
        covered += !empty;
    }
    CHECK(covered > 100);
    CHECK_THROWS_WITH_AS(renderer.read("bounding_opacity_maps/opacty"),
                         doctest::Contains("bounding_opacity_maps/opacity"), ParameterError);
}

TEST_CASE("without OpenGL the same question has the same bits for an answer") {
    const auto scene = hairy_scene();
    for (const std::string& name : technique_names()) {
        CAPTURE(name);
        const std::vector<float> points =
            cpu_renderer(scene, make_technique(name)).transmittance(some_points());
        Renderer renderer = cpu_renderer(scene, make_technique(name));
        for (int again = 0; again < 4; ++again) {
            CHECK(renderer.transmittance(some_points()) == points);
            renderer.invalidate();
        }
        // In parts, and in another order.
        const Positions all = some_points();
        for (std::size_t i = all.size(); i-- > 0;) {
            const double3 p = all[i];
            const std::vector<double> one{p.begin(), p.end()};
            CHECK(renderer.transmittance(Positions{one})[0] == points[i]);
        }
    }
}

TEST_CASE("T goes into the caller's memory, which must be as long") {
    const auto scene = hairy_scene();
    Renderer renderer = cpu_renderer(scene);
    const Shape& hair = *scene->shapes()[0];
    std::vector<float> at_points(some_points().size()), at_shape(hair.points().size());
    renderer.transmittance(some_points(), 0, at_points);
    CHECK(at_points == renderer.transmittance(some_points()));
    renderer.transmittance(hair, 0, at_shape);
    CHECK(at_shape == cpu_renderer(scene).transmittance(hair));
    at_points.pop_back();
    CHECK_THROWS_WITH_AS(renderer.transmittance(some_points(), 0, at_points),
                         doctest::Contains("59"), ParameterError);
}

TEST_CASE("receivers outside the map are told, and have T = 1") {
    Renderer renderer = cpu_renderer(hairy_scene());
    const Positions far{std::vector<double>{1e4, 0, 0, -1e4, 0, 0, 0, 1e4, 0}};
    for (const float t : renderer.transmittance(far)) CHECK(t == 1.f);
    CHECK(contains(row_of(renderer, "transmittance").note, "3 of 3 receivers outside the map"));
}

TEST_CASE("an interrupted answer is completed the next time") {
    Renderer renderer = cpu_renderer(hairy_scene());
    int passes = 0;
    renderer.set_interrupt_check([&] {
        if (++passes == 3) throw ParameterError("stopped", "go on");
    });
    CHECK_THROWS_AS(renderer.transmittance(some_points()), ParameterError);
    CHECK(renderer.transmittance(some_points()) ==
          cpu_renderer(hairy_scene()).transmittance(some_points()));
}
