#include "techniques/depth_bounds.hpp"

#include <algorithm>
#include <utility>

#include "map/depth_bits.hpp"
#include "map/fragments.hpp"

namespace opacity::techniques {
namespace {

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

}  // namespace

Texture& add_first_depth(FrameGraph& graph, const ShadowInputs& inputs, int depth_bits) {
    Texture& start = graph.texture("start", inputs.map(Format::depth32f));
    Defines defines;
    if (depth_bits < 32) defines.emplace_back("DEPTH_BITS", std::to_string(depth_bits));
    const auto first = [depth_bits](float depth, const Fragment& fragment) {
        return std::min(depth, rounded_depth(fragment.depth, depth_bits));
    };
    graph.add({.name = "start_depth",
               .shader = inputs.caster_shader("bounds.frag.glsl", false, std::move(defines)),
               .draws = &inputs.translucent,
               .view = &inputs.light,
               .reads = inputs.caster_reads(false),
               .writes = {&start},
               .state = {.depth = Depth::less, .clear_depth = 1.f},
               .on_cpu = depth_on_cpu(inputs, start, first)});
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

}  // namespace opacity::techniques
