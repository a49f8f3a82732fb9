#include "render/picture.hpp"

#include <algorithm>

namespace opacity::render {
namespace {

constexpr int subset_count = 3;  // Yuksel and Keyser 2008, section 4

TextureDesc picture_desc(const RenderSettings& settings) {
    return {.format = Format::rgba32f,
            .width = settings.width.get(),
            .height = settings.height.get(),
            .oversampling = settings.antialiasing.get()};
}

// Single samples: what covers a sample in part has no mean before it is put together.
TextureDesc sample_desc(const RenderSettings& settings, Format format, std::size_t layers) {
    const int n = settings.antialiasing.get();
    return {.format = format,
            .width = n * settings.width.get(),
            .height = n * settings.height.get(),
            .layers = int(layers)};
}

float4 premultiplied(const float4& b) {
    return {b[0] * b[3], b[1] * b[3], b[2] * b[3], b[3]};
}

Pass before_solids(Pass pass, const Texture& solid_depth) {
    pass.reads.push_back(&solid_depth);
    pass.shader.defines.emplace_back("READS_SOLID_DEPTH", "1");
    return pass;
}

}  // namespace

const Resource& Picture::add(FrameGraph& graph, const PictureInputs& inputs) {
    shading_.add(graph, inputs);
    const SceneLists& lists = inputs.lists;
    const std::size_t lights = inputs.lights.size();
    Texture& image = graph.texture("image", picture_desc(inputs.settings));
    const bool all_solid = lists.parted.shapes().empty() && lists.blended.shapes().empty();
    if (all_solid && lights == 1) {
        add_solids(graph, inputs, 0, &image);
        return image;
    }
    Texture& lit = graph.texture("lit", sample_desc(inputs.settings, Format::rgba32f, lights));
    for (std::size_t i = 0; i < lights; ++i) add_solids(graph, inputs, i, {&lit, int(i)});
    Layers layers{{&lit}, {}};
    if (!all_solid) {
        const Texture& solid_depth = add_solid_depth(graph, inputs);
        if (!lists.parted.shapes().empty()) add_parts(graph, inputs, solid_depth, layers);
        if (!lists.blended.shapes().empty()) add_blended(graph, inputs, solid_depth, layers);
    }
    add_composition(graph, std::move(layers), image);
    return image;
}

void Picture::add_solids(FrameGraph& graph, const PictureInputs& inputs, std::size_t light,
                         const Target& target) const {
    const LightScope scope{graph, inputs, light};
    TextureDesc desc = target.texture->desc();
    desc.format = Format::depth32f;
    desc.layers = 0;
    Texture& depth = graph.texture("camera_depth", desc);
    Pass pass = shading_.pass("lighting", inputs, light, inputs.lists.solid, false);
    pass.writes = {target, &depth};
    pass.state = {.depth = Depth::greater,
                  .clear_depth = 0.f,
                  .clear_color = light == 0 ? premultiplied(inputs.background) : float4{}};
    graph.add(std::move(pass));
}

// Apart from the lights, so that what is tested against it stays when one of them changes.
Texture& Picture::add_solid_depth(FrameGraph& graph, const PictureInputs& inputs) const {
    Texture& depth =
        graph.texture("solid_depth", sample_desc(inputs.settings, Format::depth32f, 0));
    Pass pass = shading_.unlit_pass("solid_depth", "solid.frag.glsl", inputs.lists.solid);
    pass.writes = {&depth};
    pass.state = {.depth = Depth::greater, .clear_depth = 0.f};
    graph.add(std::move(pass));
    return depth;
}

// Each part is drawn as if opaque, and as if the others were not there.
void Picture::add_parts(FrameGraph& graph, const PictureInputs& inputs, const Texture& solid_depth,
                        Layers& layers) const {
    const std::size_t lights = inputs.lights.size();
    Texture& parts = graph.texture(
        "parts", sample_desc(inputs.settings, Format::rgba32f, subset_count * lights));
    for (std::size_t light = 0; light < lights; ++light) {
        const LightScope scope{graph, inputs, light};
        for (int part = 0; part < subset_count; ++part) {
            const std::string name = "subset_" + std::to_string(part + 1);
            Texture& depth =
                graph.texture(name + "_depth", sample_desc(inputs.settings, Format::depth32f, 0));
            Pass pass = before_solids(shading_.pass(name, inputs, light, inputs.lists.parted, false,
                                                    {{"BEFORE_SOLIDS", "1"}}),
                                      solid_depth);
            pass.writes = {{&parts, int(light) * subset_count + part}, &depth};
            pass.state = {.depth = Depth::greater,
                          .clear_depth = 0.f,
                          .selection = {.part = part, .parts = subset_count}};
            graph.add(std::move(pass));
        }
    }
    layers.reads.push_back(&parts);
    layers.defines.emplace_back("PARTS", std::to_string(subset_count));
}

void Picture::add_blended(FrameGraph& graph, const PictureInputs& inputs,
                          const Texture& solid_depth, Layers& layers) {
    const std::size_t lights = inputs.lights.size();
    if (inputs.compositing == Compositing::maps)
        return add_weighted(graph, inputs, solid_depth, layers);
    Texture& over = graph.texture("over", sample_desc(inputs.settings, Format::rgba32f, lights));
    if (inputs.compositing == Compositing::exact)
        lists_.add(graph, inputs, shading_, solid_depth, over);
    else
        add_sorted(graph, inputs, solid_depth, over);
    layers.reads.push_back(&over);
    layers.defines.emplace_back("OVER", "1");
}

void Picture::add_sorted(FrameGraph& graph, const PictureInputs& inputs, const Texture& solid_depth,
                         Texture& over) const {
    for (std::size_t light = 0; light < inputs.lights.size(); ++light) {
        const LightScope scope{graph, inputs, light};
        Pass pass = before_solids(shading_.pass("translucent", inputs, light, inputs.lists.blended,
                                                true, {{"BLENDED", "1"}}),
                                  solid_depth);
        pass.writes = {{&over, int(light)}};
        pass.tests = &solid_depth;
        pass.state = {
            .depth = Depth::greater, .blend = Blend::over, .selection = {.back_to_front = true}};
        graph.add(std::move(pass));
    }
}

void Picture::add_weighted(FrameGraph& graph, const PictureInputs& inputs,
                           const Texture& solid_depth, Layers& layers) {
    const std::size_t lights = inputs.lights.size();
    maps_.add(graph, inputs);
    Texture& weighted =
        graph.texture("weighted", sample_desc(inputs.settings, Format::rgba32f, lights));
    Texture& optical_depth =
        graph.texture("optical_depth", sample_desc(inputs.settings, Format::r32f, 0));
    for (std::size_t light = 0; light < lights; ++light) {
        const LightScope scope{graph, inputs, light};
        Defines defines{{"WEIGHTED", "1"}};
        if (light == 0) defines.emplace_back("WRITES_OPTICAL_DEPTH", "1");
        Pass pass = before_solids(shading_.pass("translucent", inputs, light, inputs.lists.blended,
                                                true, std::move(defines)),
                                  solid_depth);
        maps_.add_look_up(pass);
        pass.writes = {{&weighted, int(light)}};
        if (light == 0) pass.writes.emplace_back(&optical_depth);
        pass.tests = &solid_depth;
        pass.state = {.depth = Depth::greater, .blend = Blend::add};
        graph.add(std::move(pass));
    }
    layers.reads.insert(layers.reads.end(), {&weighted, &optical_depth});
    layers.defines.emplace_back("WEIGHTED", "1");
}

void Picture::add_composition(FrameGraph& graph, Layers layers, Texture& image) {
    graph.add({.name = "composition",
               .shader = {.compute = "compose.comp.glsl", .defines = std::move(layers.defines)},
               .reads = std::move(layers.reads),
               .stores = {&image},
               .execute = [&image](PassContext& context) {
                   context.dispatch(image.desc().width * image.desc().height);
               }});
}

}  // namespace opacity::render
