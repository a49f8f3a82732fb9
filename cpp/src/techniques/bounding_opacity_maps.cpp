#include "techniques/bounding_opacity_maps.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "opacity/core/split.hpp"
#include "opacity/scene/mesh.hpp"
#include "techniques/histogram.hpp"

namespace opacity::techniques {

LookUp BoundingOpacityMaps::build(FrameGraph& graph, const ShadowInputs& inputs) {
    const LayerSpan span{&add_first_depth(graph, inputs), &add_last_depth(graph, inputs)};
    auto& planes = graph.value("planes", std::vector<float>{});
    const Interpolation between = between_planes(inputs);
    const SplitSearch search{layers,        similarity,      bias,   own_correction,
                             interpolation, search_request_, between};
    const bool searches = split.is("auto") && layers.get() > 1;
    std::optional<SplitSearch::Trials> trials;
    if (!searches)
        planes.set(layer_planes(layers.get(), fixed_ratio()));
    else if (search_frames.get() == 1)
        search.add_at_once(graph, inputs, add_histogram(graph, inputs, span, fine_ratio), planes);
    else
        trials.emplace(search.begin_trial(graph, inputs, planes));
    const DrawnLayers drawn =
        add_layers(graph, inputs, span, planes, {.mean_depths = between != Interpolation::linear});
    Reads more;
    if (trials) {
        const bool rebuilds = similarity.is("error");
        more.push_back(
            &search.add_trial(graph, inputs, *trials, drawn,
                              rebuilds ? add_histogram(graph, inputs, span, fine_ratio) : drawn));
    }
    return layers_look_up(inputs, drawn, between, std::move(more));
}

// Coarser sums do not tell where in a layer what it holds lies. A leaf is one caster, and often the
// only one of its layer; strands and media are many.
Interpolation BoundingOpacityMaps::between_planes(const ShadowInputs& inputs) const {
    const bool is_fine = accumulator_bits() == 32 && !inputs.paper_deposit;
    if (interpolation.is("linear") || (interpolation.is("auto") && !is_fine))
        return Interpolation::linear;
    const auto is_surface = [](const ShapePtr& shape) {
        return dynamic_cast<const Mesh*>(shape.get()) != nullptr;
    };
    return std::ranges::any_of(inputs.translucent.shapes(), is_surface)
               ? Interpolation::mean_depth_of_few
               : Interpolation::mean_depth;
}

// One layer has no plane to place.
double BoundingOpacityMaps::fixed_ratio() const {
    return split.is("logarithmic") ? 1.0 : split.is("hybrid") ? split_ratio.get() : 0.0;
}

}  // namespace opacity::techniques
