#include "techniques/depth_bounds.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "map/depth_bits.hpp"
#include "map/fragments.hpp"

namespace opacity::techniques {
namespace {

constexpr float no_first = 1.f, no_last = 0.f;  // where no caster is

// `pick` takes the depth so far, and the fragment.
template <class Pick>
std::function<void(PassContext&)> depth_on_cpu(const ShadowInputs& inputs, Texture& depth,
                                               Pick pick) {
    return [inputs, &depth, pick](PassContext& context) {
        const std::span<float> map = context.memory<float>(depth);
        for_each_fragment(inputs.fragments(context, false), [&](const Fragment& fragment) {
            map[fragment.texel] = pick(map[fragment.texel], fragment);
        });
    };
}

using OnCpu = std::function<void(PassContext&)>;

OnCpu first_on_cpu(const ShadowInputs& inputs, Texture& start, int depth_bits) {
    return depth_on_cpu(inputs, start, [depth_bits](float depth, const Fragment& fragment) {
        return std::min(depth, rounded_depth(fragment.depth, depth_bits));
    });
}

OnCpu both_on_cpu(const ShadowInputs& inputs, const DepthBounds& bounds) {
    return [inputs, bounds](PassContext& context) {
        const auto starts = context.memory<float>(bounds.start);
        const auto ends = context.memory<float>(bounds.end);
        for_each_fragment(inputs.fragments(context, false), [&](const Fragment& fragment) {
            float &first = starts[fragment.texel], &last = ends[fragment.texel];
            first = std::min(first, fragment.depth);
            last = std::max(last, fragment.depth_end);
        });
    };
}

Defines bits_define(int depth_bits) {
    if (depth_bits == 32) return {};
    return {{"DEPTH_BITS", std::to_string(depth_bits)}};
}

// A pass that scatters into maps of these depths, and fills them first.
struct Filled {
    Texture& depth;
    float none;
};
void add_scattered_depths(FrameGraph& graph, const Scatter& scatter, const std::string& name,
                          const std::vector<Filled>& maps, Defines defines) {
    std::vector<Resource*> stores;
    for (const Filled& map : maps) stores.push_back(&map.depth);
    graph.add({.name = name,
               .shader = scatter.shader("scatter_bounds.glsl", false, std::move(defines)),
               .draws = &scatter.inputs().translucent,
               .view = &scatter.inputs().light,
               .reads = scatter.reads(false),
               .stores = std::move(stores),
               .execute = [scatter, maps](PassContext& context) {
                   for (const Filled& map : maps) context.fill(map.depth, map.none);
                   context.note(scatter.run(context));
               }});
}

}  // namespace

Texture& add_first_depth(FrameGraph& graph, const ShadowInputs& inputs, int depth_bits) {
    Texture& start = graph.texture("start", inputs.map(Format::depth32f));
    graph.add({.name = "start_depth",
               .shader = inputs.caster_shader("bounds.frag.glsl", false, bits_define(depth_bits)),
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = inputs.caster_reads(false),
               .writes = {&start},
               .state = {.depth = Depth::less, .clear_depth = 1.f},
               .on_cpu = first_on_cpu(inputs, start, depth_bits)});
    return start;
}

Texture& add_last_depth(FrameGraph& graph, const ShadowInputs& inputs) {
    Texture& end = graph.texture("end", inputs.map(Format::depth32f));
    const auto last = [](float depth, const Fragment& fragment) {
        return std::max(depth, fragment.depth_end);
    };
    graph.add({.name = "end_depth",  // reversed: the farthest caster wins
               .shader = inputs.caster_shader("bounds.frag.glsl", false, {{"LAST_DEPTH", "1"}}),
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = inputs.caster_reads(false),
               .writes = {&end},
               .state = {.depth = Depth::greater, .clear_depth = 0.f},
               .on_cpu = depth_on_cpu(inputs, end, last)});
    return end;
}

Texture& add_last_depth_mirrored(FrameGraph& graph, const ShadowInputs& inputs,
                                 bool by_depth_range) {
    Texture& mirrored = graph.texture("mirrored_end", inputs.map(Format::depth32f));
    Texture& end = graph.texture("end", inputs.map(Format::r32f));
    const auto last = [](float depth, const Fragment& fragment) {
        return std::min(depth, 1.f - fragment.depth_end);
    };
    const std::string way = by_depth_range ? "DEPTH_RANGE" : "MIRRORED";
    graph.add(
        {.name = "end_depth",
         .shader = inputs.caster_shader("bounds.frag.glsl", false, {{way, "1"}}),
         .draws = &inputs.translucent,
         .view = &inputs.light,
         .reads = inputs.caster_reads(false),
         .writes = {&mirrored},
         .state = {.depth = Depth::less, .clear_depth = 1.f, .swaps_depth_range = by_depth_range},
         .on_cpu = depth_on_cpu(inputs, mirrored, last)});
    graph.add({.name = "mirror",
               .shader = {.compute = "mirror.comp.glsl"},
               .only_with = &inputs.translucent,
               .reads = {&mirrored},
               .stores = {&end},
               .execute =
                   [&end](PassContext& context) {
                       context.dispatch(end.desc().width * end.desc().height);
                   },
               .on_cpu =
                   [&mirrored, &end](PassContext& context) {
                       std::ranges::transform(context.memory<float>(mirrored),
                                              context.memory<float>(end).begin(),
                                              [](float depth) { return 1.f - depth; });
                   }});
    return end;
}

DepthBounds add_both_depths(FrameGraph& graph, const ShadowInputs& inputs) {
    Texture& start = graph.texture("start", inputs.map(Format::r32f));
    Texture& end = graph.texture("end", inputs.map(Format::r32f));
    graph.add({.name = "bounds",
               .shader = inputs.caster_shader("bounds.frag.glsl", false, {{"ONE_PASS", "1"}}),
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = inputs.caster_reads(false),
               .writes = {{&start, 0, float4{no_first}}, {&end, 0, float4{no_last}}},
               .state = {.blend = Blend::bounds},
               .on_cpu = both_on_cpu(inputs, {start, end})});
    return {start, end};
}

Texture& scatter_first_depth(FrameGraph& graph, const Scatter& scatter, int depth_bits) {
    const ShadowInputs& inputs = scatter.inputs();
    Texture& start = graph.texture("start", inputs.map(Format::r32f));
    add_scattered_depths(graph, scatter, "start_depth", {{start, no_first}},
                         bits_define(depth_bits));
    return start;
}

DepthBounds scatter_both_depths(FrameGraph& graph, const Scatter& scatter) {
    const ShadowInputs& inputs = scatter.inputs();
    Texture& start = graph.texture("start", inputs.map(Format::r32f));
    Texture& end = graph.texture("end", inputs.map(Format::r32f));
    add_scattered_depths(graph, scatter, "bounds", {{start, no_first}, {end, no_last}},
                         {{"LAST_TOO", "1"}});
    return {start, end};
}

}  // namespace opacity::techniques
