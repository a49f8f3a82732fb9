#include "techniques/bounding_opacity_maps.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "opacity/core/split.hpp"
#include "techniques/layers_on_cpu.hpp"

namespace opacity::techniques {
namespace {

constexpr int targets_per_pass = 8;  // what OpenGL 4.5 guarantees

}  // namespace

LookUp BoundingOpacityMaps::build(FrameGraph& graph, const ShadowInputs& inputs) {
    const Bounds bounds = add_bounds(graph, inputs);
    auto& planes = graph.value("planes", std::vector<float>{});
    const SplitSearch search{layers, similarity, bias, own_correction, search_request_};
    const bool searches = split.is("auto") && layers.get() > 1;
    std::optional<SplitSearch::Trials> trials;
    if (!searches)
        planes.set(layer_planes(layers.get(), fixed_ratio()));
    else if (search_frames.get() == 1)
        search.add_at_once(graph, inputs, add_histogram(graph, inputs, bounds), planes);
    else
        trials.emplace(search.begin_trial(graph, inputs, planes));
    Texture& opacity = add_layers(graph, inputs, bounds, "opacity", {layers, planes, layers.get()});
    Reads reads{&bounds.start, &bounds.end, &opacity, &layers, &planes};
    if (trials) {
        const DrawnLayers drawn{opacity, planes, bounds};
        const bool rebuilds = similarity.is("error");
        reads.push_back(&search.add_trial(graph, inputs, *trials, drawn,
                                          rebuilds ? add_histogram(graph, inputs, bounds) : drawn));
    }
    LookUp result = look_up(inputs, std::move(reads),
                            layers_look_up({bounds.start, bounds.end, opacity, planes}));
    result.own_correction = own_correction.get() && !inputs.paper_deposit;
    return result;
}

// One layer has no plane to place.
double BoundingOpacityMaps::fixed_ratio() const {
    return split.is("logarithmic") ? 1.0 : split.is("hybrid") ? split_ratio.get() : 0.0;
}

Bounds BoundingOpacityMaps::add_bounds(FrameGraph& graph, const ShadowInputs& inputs) const {
    Texture& start = graph.texture("start", inputs.map(Format::depth32f));
    Texture& end = graph.texture("end", inputs.map(Format::depth32f));
    const Reads reads = inputs.caster_reads(false);
    graph.add({.name = "start_depth",
               .shader = inputs.caster_shader("bounds.frag.glsl", false),
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = reads,
               .writes = {&start},
               .state = {.depth = Depth::less, .clear_depth = 1.f},
               .on_cpu = first_depth_on_cpu(inputs, start)});
    graph.add({.name = "end_depth",  // reversed: the farthest caster wins
               .shader = inputs.caster_shader("bounds.frag.glsl", false, {{"LAST_DEPTH", "1"}}),
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = reads,
               .writes = {&end},
               .state = {.depth = Depth::greater, .clear_depth = 0.f},
               .on_cpu = last_depth_on_cpu(inputs, end)});
    return {start, end};
}

Texture& BoundingOpacityMaps::add_layers(FrameGraph& graph, const ShadowInputs& inputs,
                                         const Bounds& bounds, const std::string& name,
                                         const Planes& planes, int block_stride) const {
    const int target_count = (planes.count + planes_per_target - 1) / planes_per_target;
    Texture& map = graph.texture(name, inputs.map(Format::rgba32f, target_count));
    const Reads reads =
        inputs.caster_reads(true, {&planes.layers, &planes.planes, &bounds.start, &bounds.end});
    for (int first = 0; first < target_count; first += targets_per_pass) {
        const int count = std::min(targets_per_pass, target_count - first);
        std::vector<Target> writes;
        for (int target = first; target < first + count; ++target)
            writes.emplace_back(&map, target);
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
                   .on_cpu = layers_on_cpu(inputs, {bounds.start, bounds.end, map, planes.planes},
                                           first, count, block_stride)});
    }
    return map;
}

DrawnLayers BoundingOpacityMaps::add_histogram(FrameGraph& graph, const ShadowInputs& inputs,
                                               const Bounds& bounds) const {
    const int count = fine_layer_count(inputs.space.width_px());
    auto& fine_layers = graph.value("fine/layers", 0);
    auto& fine_planes = graph.value("fine/planes", std::vector<float>{});
    fine_layers.set(count);
    fine_planes.set(layer_planes(count, fine_ratio));
    Texture& map = add_layers(graph, inputs, bounds, "histogram", {fine_layers, fine_planes, count},
                              block_stride(inputs.space.width_px()));
    return {map, fine_planes, bounds};
}

}  // namespace opacity::techniques
