#include "techniques/adaptive_opacity_maps.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "opacity/core/split.hpp"

namespace opacity::techniques {
namespace {

// Cells of the first histogram, and the fewest layers of a trial: where 8 layers are wanted, planes
// by a trial of 16 err a tenth less.
constexpr int least_told = 16;
// After so many frames in which nothing moved: more gain nothing (docs/accuracy.md).
constexpr int resting_frames = 3;

Value<std::vector<float>>& even_planes(FrameGraph& graph, const std::string& name, int count) {
    auto& planes = graph.value(name, std::vector<float>{});
    planes.set(layer_planes(count, 0.0));
    return planes;
}

// What `refine` frames knows of the frames before.
struct Turns {
    Value<int>& last;                    // which of two textures has the newest planes; none: -1
    Value<int>& frames;                  // since something moved
    Value<std::vector<int>>& size;       // of the textures
    Value<std::vector<Revision>>& seen;  // what may move

    explicit Turns(FrameGraph& graph)
        : last{graph.value("last_turn", -1)},
          frames{graph.value("frames_at_rest", 0)},
          size{graph.value("turn_size", std::vector<int>{})},
          seen{graph.value("seen", std::vector<Revision>{})} {}

    void begin(const TextureDesc& desc, const ShadowInputs& inputs) {
        const std::vector<int> size_now{desc.width, desc.height, desc.layers};
        const std::vector<Revision> now{
            inputs.light.revision(), inputs.translucent.geometry.revision(),
            inputs.translucent.opacity.revision(), Revision{inputs.paper_deposit}};
        if (size_now != size.get() || inputs.translucent.shapes().empty()) last.set(-1);
        if (now != seen.get() || last.get() < 0) frames.set(0);
        size.set(size_now);
        seen.set(now);
    }
    // A frame at rest declares what the one before did, so that all is cached.
    bool rests() const { return frames.get() >= resting_frames; }
    int next() const { return rests() ? last.get() : 1 - std::max(last.get(), 0); }
};

}  // namespace

LookUp AdaptiveOpacityMaps::build(FrameGraph& graph, const ShadowInputs& inputs) {
    const DepositWay way = deposit_way(graph, inputs);
    const LayerSpan span = add_bounds(graph, inputs, way);
    const bool has_planes = layers.get() > 1;  // between the bounds
    Laid laid;
    if (has_planes)
        laid = refine.is("frames") ? add_planes_over_frames(graph, inputs, way, span)
                                   : add_planes(graph, inputs, way, span);
    const Interpolation between = between_planes(inputs);
    const DrawnLayers drawn =
        add_layers(graph, inputs, way, span, even_planes(graph, "planes", layers.get()),
                   {.mean_depths = between != Interpolation::linear, .tiles = laid.planes});
    return layers_look_up(inputs, drawn, between, std::move(laid.more));
}

AdaptiveOpacityMaps::Laid AdaptiveOpacityMaps::add_planes(FrameGraph& graph,
                                                          const ShadowInputs& inputs,
                                                          const DepositWay& way,
                                                          const LayerSpan& span) const {
    const LayerCount wanted{layers, layers.get()};
    const DrawnLayers cells = add_cells(graph, inputs, way, span);
    if (refine.is("0")) return {add_planes_by(graph, inputs, cells, wanted)};
    const LayerCount count = trial_count(graph);
    const TilePlanes first = add_trial_planes(graph, inputs, cells, count);
    return {add_planes_by(graph, inputs, add_trial_at(graph, inputs, way, span, first), wanted)};
}

// The newest planes, and those that are laid by them, take turns in two textures.
AdaptiveOpacityMaps::Laid AdaptiveOpacityMaps::add_planes_over_frames(FrameGraph& graph,
                                                                      const ShadowInputs& inputs,
                                                                      const DepositWay& way,
                                                                      const LayerSpan& span) const {
    const LayerCount wanted{layers, layers.get()}, count = trial_count(graph);
    const TextureDesc desc = tile_planes_desc(inputs, count.count, tile.get());
    const TilePlanes turns[] = {{&graph.texture("turn0/tile_planes", desc), tile.get()},
                                {&graph.texture("turn1/tile_planes", desc), tile.get()}};
    Turns state{graph};
    state.begin(desc, inputs);
    const int next = state.next();
    const TilePlanes before =
        state.last.get() < 0
            ? add_trial_planes(graph, inputs, add_cells(graph, inputs, way, span), count)
            : turns[1 - next];
    const DrawnLayers trial = add_trial_at(graph, inputs, way, span, before);
    add_transmittance_planes(graph, inputs, shader_path(), "turn_planes", trial,
                             {turns[next], count, steady_even_part});
    graph.add({.name = "turn",
               .only_with = &inputs.translucent,
               .reads = {turns[next].places},
               .values = {&state.last, &state.frames},
               .execute = [state, next](PassContext& context) {
                   context.set(state.last, next);
                   context.set(state.frames, state.frames.get() + 1);
               }});
    return {add_planes_by(graph, inputs, trial, wanted), {&state.last}};
}

DrawnLayers AdaptiveOpacityMaps::add_cells(FrameGraph& graph, const ShadowInputs& inputs,
                                           const DepositWay& way, const LayerSpan& span) const {
    const FrameGraph::Scope scope{graph, "cells"};
    auto& count = graph.value("layers", 0);
    count.set(least_told);
    return add_trial(graph, inputs, way, span, even_planes(graph, "planes", least_told), count, {});
}

LayerCount AdaptiveOpacityMaps::trial_count(FrameGraph& graph) const {
    auto& count = graph.value("trial/layers", 0);
    count.set(std::max(layers.get(), least_told));
    return {count, count.get()};
}

TilePlanes AdaptiveOpacityMaps::add_trial_planes(FrameGraph& graph, const ShadowInputs& inputs,
                                                 const DrawnLayers& told,
                                                 const LayerCount& count) const {
    const FrameGraph::Scope scope{graph, "trial"};
    return add_planes_by(graph, inputs, told, count);
}

DrawnLayers AdaptiveOpacityMaps::add_trial_at(FrameGraph& graph, const ShadowInputs& inputs,
                                              const DepositWay& way, const LayerSpan& span,
                                              const TilePlanes& planes) const {
    const LayerCount count = trial_count(graph);
    const FrameGraph::Scope scope{graph, "trial"};
    return add_trial(graph, inputs, way, span, even_planes(graph, "planes", count.count),
                     count.source, planes);
}

TilePlanes AdaptiveOpacityMaps::add_planes_by(FrameGraph& graph, const ShadowInputs& inputs,
                                              const DrawnLayers& told,
                                              const LayerCount& count) const {
    const TextureDesc desc = tile_planes_desc(inputs, count.count, tile.get());
    const TilePlanes planes{&graph.texture("tile_planes", desc), tile.get()};
    add_transmittance_planes(graph, inputs, shader_path(), "tile_planes", told,
                             {planes, count, even_part_for(inputs.translucent)});
    return planes;
}

}  // namespace opacity::techniques
