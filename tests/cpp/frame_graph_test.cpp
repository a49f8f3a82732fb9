// The graph decides what runs; none of it needs a GPU.
#include <doctest/doctest.h>

#include <map>
#include <string>
#include <vector>

#include "opacity/core/error.hpp"
#include "opacity/graph/frame_graph.hpp"
#include "opacity/scene/mesh.hpp"

using namespace opacity;

namespace {

// Remembers what it was asked to do, and keeps the bytes that were written.
struct RecordingDevice : Device {
    std::vector<std::string> calls;
    std::map<std::string, std::vector<std::byte>> contents;
    Revision shaders = next_revision();

    Revision shader_revision() override { return shaders; }
    void allocate(const Resource& r) override { calls.push_back("allocate " + r.name()); }
    void release(const Resource& r) noexcept override { calls.push_back("release " + r.name()); }
    void clear(const Pass& p) override { calls.push_back("clear " + p.name); }
    void draw(const Pass& p, const Uniforms&, const ShapeFilter&) override {
        calls.push_back("draw " + p.name);
    }
    void dispatch(const Pass& p, std::array<int, 3>, const Uniforms&) override {
        calls.push_back("dispatch " + p.name);
    }
    void dispatch_shapes(const Pass& p, const ShapeFilter&) override {
        calls.push_back("dispatch shapes of " + p.name);
    }
    void fill(const Texture&, float) override {}
    void zero(const Resource& r) override { contents[r.name()].assign(16, std::byte{0}); }
    void write(const Resource& r, std::span<const std::byte> c) override {
        contents[r.name()].assign(c.begin(), c.end());
    }
    void read(const Resource& r, std::span<std::byte> c) override {
        const auto& stored = contents[r.name()];
        std::copy_n(stored.begin(), std::min(stored.size(), c.size()), c.begin());
    }
    void finish() override {}
    bool did(const std::string& call) const {
        return std::find(calls.begin(), calls.end(), call) != calls.end();
    }
};

ShapePtr triangle() {
    return std::make_shared<Mesh>(Positions{std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}},
                                  std::vector<std::uint32_t>{0, 1, 2});
}

// Two passes in a row, as a technique would declare them: "depth" draws, "light" reads it.
struct TwoPasses {
    RecordingDevice device;
    FrameGraph graph{device};
    DrawList casters{"casters"};
    View view{"light"};
    Value<int> color{"color", 1};
    const Texture* goal = nullptr;

    TwoPasses() { casters.update({triangle()}); }
    void frame() {
        device.calls.clear();
        graph.begin();
        Texture& depth =
            graph.texture("depth", {.format = Format::depth32f, .width = 4, .height = 4});
        Texture& image = graph.texture("image", {.width = 4, .height = 4});
        graph.add({.name = "depth",
                   .shader = {.vertex = "v", .fragment = "f"},
                   .draws = &casters,
                   .view = &view,
                   .writes = {&depth}});
        graph.add({.name = "light",
                   .reads = {&depth, &color},
                   .writes = {&image},
                   .execute = [](PassContext&) {}});
        goal = &image;
        graph.run(image);
    }
    std::string status(const std::string& pass) const {
        for (const PassReport& row : graph.report())
            if (row.name == pass) return to_string(row.status);
        return "absent";
    }
    std::string why(const std::string& pass) const {
        for (const PassReport& row : graph.report())
            if (row.name == pass) return row.why;
        return "absent";
    }
};

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        CHECK(!error.fix().empty());
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("a pass runs again exactly when a declared read moved") {
    TwoPasses t;
    t.frame();
    CHECK(t.status("depth") == "ran");
    CHECK(t.why("depth") == "first run");
    t.frame();
    CHECK(t.status("depth") == "cached");
    CHECK(t.status("light") == "cached");
    CHECK(t.device.calls.empty());

    t.color.set(2);
    t.frame();
    CHECK(t.status("depth") == "cached");
    CHECK(t.status("light") == "ran");
    CHECK(t.why("light") == "moved: color");

    t.view.update(identity, {{"u_x", 1.f}});
    t.frame();
    CHECK(t.status("depth") == "ran");
    CHECK(t.why("depth") == "moved: light");
    CHECK(t.why("light") == "moved: depth");  // what is downstream follows
}

TEST_CASE("setting a value to what it holds moves nothing") {
    TwoPasses t;
    t.frame();
    t.color.set(1);
    t.view.update(identity, {});
    t.frame();
    CHECK(t.status("light") == "cached");
    CHECK(t.status("depth") == "cached");
}

TEST_CASE("a pass that nothing needs is culled, and says so") {
    TwoPasses t;
    t.device.calls.clear();
    t.graph.begin();
    Texture& unused = t.graph.texture("unused", {});
    Texture& image = t.graph.texture("image", {});
    t.graph.add({.name = "wasted", .writes = {&unused}, .execute = [](PassContext&) {
                     FAIL("a culled pass ran");
                 }});
    t.graph.add({.name = "light", .writes = {&image}, .execute = [](PassContext&) {}});
    t.graph.run(image);
    CHECK(t.status("wasted") == "culled");
    CHECK(t.why("wasted").find("image") != std::string::npos);
    CHECK_FALSE(t.device.did("allocate unused"));
}

TEST_CASE("a pass without shapes is culled, but what it would write is cleared once") {
    TwoPasses t;
    t.casters.update({});
    t.frame();
    CHECK(t.status("depth") == "culled");
    CHECK(t.why("depth") == "no casters");
    CHECK(t.device.did("clear depth"));
    CHECK_FALSE(t.device.did("draw depth"));
    CHECK(t.status("light") == "ran");
    t.frame();
    CHECK(t.status("depth") == "culled");
    CHECK(t.device.calls.empty());
    t.casters.update({triangle()});
    t.frame();
    CHECK(t.status("depth") == "ran");
}

TEST_CASE("a described-anew texture loses its content, and its writer runs") {
    TwoPasses t;
    const auto frame = [&](int size) {
        t.graph.begin();
        Texture& image = t.graph.texture("image", {.width = size, .height = size});
        t.graph.add({.name = "light", .writes = {&image}, .execute = [](PassContext&) {}});
        t.graph.run(image);
    };
    frame(4);
    frame(4);
    CHECK(t.status("light") == "cached");
    frame(8);
    CHECK(t.status("light") == "ran");
}

TEST_CASE("a pass that throws stays to be run, with all after it") {
    TwoPasses t;
    bool fail = true;
    int runs = 0;
    const auto frame = [&] {
        t.graph.begin();
        Texture& a = t.graph.texture("a", {});
        Texture& b = t.graph.texture("b", {});
        t.graph.add({.name = "first", .writes = {&a}, .execute = [&](PassContext&) {
                         if (fail) throw Error("x", "y");
                     }});
        t.graph.add({.name = "second", .reads = {&a}, .writes = {&b}, .execute = [&](PassContext&) {
                         ++runs;
                     }});
        t.graph.run(b);
    };
    CHECK_THROWS_AS(frame(), Error);
    fail = false;
    frame();
    CHECK(t.status("first") == "ran");
    CHECK(runs == 1);
}

TEST_CASE("a frame can be stopped between passes, and goes on where it was") {
    TwoPasses t;
    int asked = 0;
    t.graph.set_interrupt_check([&] {
        if (++asked == 2) throw Error("interrupted", "go on");
    });
    CHECK_THROWS_AS(t.frame(), Error);
    CHECK(t.device.did("draw depth"));
    t.frame();
    CHECK(t.status("depth") == "cached");
    CHECK(t.status("light") == "ran");
}

TEST_CASE("a pass about shapes is culled while there are none") {
    RecordingDevice device;
    FrameGraph graph{device};
    DrawList casters{"casters"};
    int searches = 0;
    const auto frame = [&] {
        graph.begin();
        Texture& image = graph.texture("image", {});
        graph.add({.name = "search",
                   .only_with = &casters,
                   .stores = {&image},
                   .execute = [&](PassContext&) { ++searches; }});
        graph.run(image);
    };
    frame();
    CHECK(searches == 0);
    CHECK(graph.report()[0].why == "no casters");
    CHECK(device.contents["image"].size() == 16);  // zeroed: whoever reads it finds nothing
    casters.update({triangle()});
    frame();
    CHECK(searches == 1);
}

TEST_CASE("a search that finds the same value leaves what follows cached") {
    RecordingDevice device;
    FrameGraph graph{device};
    Value<int> scene{"scene", 1};
    Value<float> split{"split", 0.f};
    int lit = 0;
    const auto frame = [&](float found) {
        graph.begin();
        Texture& image = graph.texture("image", {});
        graph.add({.name = "search",
                   .reads = {&scene},
                   .values = {&split},
                   .execute = [&, found](PassContext& c) {
                       c.set(split, found);
                       c.note("found");
                   }});
        graph.add(
            {.name = "light", .reads = {&split}, .writes = {&image}, .execute = [&](PassContext&) {
                 ++lit;
             }});
        graph.run(image);
    };
    frame(0.5f);
    scene.set(2);
    frame(0.5f);
    CHECK(lit == 1);
    CHECK(graph.report()[0].note == "found");
    scene.set(3);
    frame(0.6f);
    CHECK(lit == 2);
    frame(0.6f);
    CHECK(graph.report()[0].note == "found");  // kept while the pass is cached
}

TEST_CASE("a texture with more layers than before is written by all who write a layer") {
    RecordingDevice device;
    FrameGraph graph{device};
    for (const int layers : {2, 3, 3}) {
        graph.begin();
        Texture& lit = graph.texture("lit", {.width = 4, .height = 4, .layers = layers});
        for (int layer = 0; layer < layers; ++layer)
            graph.add({.name = "light" + std::to_string(layer),
                       .writes = {{&lit, layer}},
                       .execute = [](PassContext&) {}});
        const bool as_before =
            !graph.report().empty() && graph.report().size() == std::size_t(layers);
        graph.run(lit);
        for (const PassReport& row : graph.report())
            CHECK(std::string{to_string(row.status)} == (as_before ? "cached" : "ran"));
    }
}

TEST_CASE("what a pass did not declare, it cannot touch") {
    RecordingDevice device;
    FrameGraph graph{device};
    Value<int> secret{"secret", 1};
    const auto run = [&](std::function<void(PassContext&)> execute) {
        graph.begin();
        Texture& image = graph.texture("image", {});
        graph.add({.name = "light", .writes = {&image}, .execute = std::move(execute)});
        graph.run(image);
    };
    CHECK(message_of([&] {
              run([&](PassContext& c) { c.set(secret, 2); });
          }).find("add &secret to .values") != std::string::npos);
    graph.begin();
    Texture& other = graph.texture("other", {});
    CHECK(message_of([&] {
              Texture& image = graph.texture("image", {});
              graph.add({.name = "light", .writes = {&image}, .execute = [&](PassContext& c) {
                             c.read<float>(other);
                         }});
              graph.run(image);
          }).find(".reads") != std::string::npos);
    CHECK(secret.get() == 1);
}

TEST_CASE("declarations that cannot work are refused with the line to change") {
    RecordingDevice device;
    FrameGraph graph{device};
    graph.begin();
    Texture& a = graph.texture("a", {});
    const auto nothing = [](PassContext&) {};
    CHECK(message_of([&] {
              graph.add({.name = "loop", .reads = {&a}, .writes = {&a}, .execute = nothing});
          }).find("writes itself") != std::string::npos);
    graph.add({.name = "one", .writes = {&a}, .execute = nothing});
    CHECK(message_of([&] {
              graph.add({.name = "two", .writes = {&a}, .execute = nothing});
          }).find("one writer") != std::string::npos);
    CHECK(message_of([&] { graph.add({.name = "one", .execute = nothing}); }).find("twice") !=
          std::string::npos);
    CHECK(message_of([&] { graph.add({.name = "idle"}); }).find("does nothing") !=
          std::string::npos);
    CHECK(message_of([&] { graph.find("nowhere"); }).find("render a frame first") !=
          std::string::npos);
}

TEST_CASE("names are scoped, resources of a frame that are not declared again are freed") {
    RecordingDevice device;
    FrameGraph graph{device};
    graph.begin();
    {
        const FrameGraph::Scope scope{graph, "maps"};
        Texture& a = graph.texture("a", {});
        CHECK(a.name() == "maps/a");
        CHECK(a.shader_name() == "a");
        graph.add({.name = "pass", .writes = {&a}, .execute = [](PassContext&) {}});
        graph.run(a);
    }
    CHECK(graph.report().front().name == "maps/pass");
    graph.begin();
    Texture& b = graph.texture("b", {});
    graph.run(b);
    CHECK(device.did("release maps/a"));
    CHECK_THROWS_AS(graph.find("maps/a"), ParameterError);
}

TEST_CASE("graph_dot() draws every pass and what flows between them") {
    TwoPasses t;
    t.frame();
    const std::string dot = t.graph.graph_dot();
    CHECK(dot.find("\"pass depth\" -> \"depth\"") != std::string::npos);
    CHECK(dot.find("\"depth\" -> \"pass light\"") != std::string::npos);
    CHECK(dot.find("\"casters.geometry\" -> \"pass depth\"") != std::string::npos);
}
