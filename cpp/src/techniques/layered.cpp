#include "techniques/layered.hpp"

#include <algorithm>
#include <utility>

#include "techniques/layers_on_cpu.hpp"

namespace opacity::techniques {
namespace {

constexpr int targets_per_pass = 8;  // what OpenGL 4.5 guarantees

}  // namespace

Texture& Layered::add_first_depth(FrameGraph& graph, const ShadowInputs& inputs) {
    Texture& start = graph.texture("start", inputs.map(Format::depth32f));
    graph.add({.name = "start_depth",
               .shader = inputs.caster_shader("bounds.frag.glsl", false),
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = inputs.caster_reads(false),
               .writes = {&start},
               .state = {.depth = Depth::less, .clear_depth = 1.f},
               .on_cpu = first_depth_on_cpu(inputs, start)});
    return start;
}

Texture& Layered::add_last_depth(FrameGraph& graph, const ShadowInputs& inputs) {
    Texture& end = graph.texture("end", inputs.map(Format::depth32f));
    graph.add({.name = "end_depth",  // reversed: the farthest caster wins
               .shader = inputs.caster_shader("bounds.frag.glsl", false, {{"LAST_DEPTH", "1"}}),
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = inputs.caster_reads(false),
               .writes = {&end},
               .state = {.depth = Depth::greater, .clear_depth = 0.f},
               .on_cpu = last_depth_on_cpu(inputs, end)});
    return end;
}

DrawnLayers Layered::add_layers(FrameGraph& graph, const ShadowInputs& inputs,
                                const LayerSpan& span, const std::string& name,
                                const Planes& planes, int block_stride) const {
    const int target_count = (planes.count + planes_per_target - 1) / planes_per_target;
    const DrawnLayers drawn{graph.texture(name, inputs.map(Format::rgba32f, target_count)),
                            planes.planes, span};
    Reads reads{&planes.layers, &planes.planes};
    span.add_to(reads);
    reads = inputs.caster_reads(true, std::move(reads));
    for (int first = 0; first < target_count; first += targets_per_pass) {
        const int count = std::min(targets_per_pass, target_count - first);
        std::vector<Target> writes;
        for (int target = first; target < first + count; ++target)
            writes.emplace_back(&drawn.map, target);
        const std::string part =
            first == 0 ? "" : "_" + std::to_string(first / targets_per_pass + 1);
        const Defines defines{{"PASS_opacity", "1"},
                              {"TARGETS", std::to_string(count)},
                              {"FIRST_TARGET", std::to_string(first)},
                              {"BLOCK_STRIDE", std::to_string(block_stride)}};
        graph.add({.name = name + part,
                   .shader = inputs.caster_shader(shader_path(), true, defines),
                   .draws = &inputs.translucent,
                   .view = &inputs.light,
                   .reads = reads,
                   .writes = std::move(writes),
                   .state = {.blend = Blend::add},
                   .on_cpu = layers_on_cpu(inputs, drawn, first, count, block_stride)});
    }
    return drawn;
}

LookUp Layered::layers_look_up(const ShadowInputs& inputs, const DrawnLayers& drawn,
                               Reads more) const {
    Reads reads{&drawn.map, &layers, &drawn.planes};
    drawn.span.add_to(reads);
    reads.insert(reads.end(), more.begin(), more.end());
    LookUp result = look_up(inputs, std::move(reads), look_up_on_cpu(drawn));
    result.own_correction = own_correction.get() && !inputs.paper_deposit;
    return result;
}

}  // namespace opacity::techniques
