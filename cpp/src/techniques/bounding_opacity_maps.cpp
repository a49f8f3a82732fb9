#include "techniques/bounding_opacity_maps.hpp"

#include <optional>
#include <utility>

#include "opacity/core/split.hpp"
#include "techniques/histogram.hpp"

namespace opacity::techniques {

LookUp BoundingOpacityMaps::build(FrameGraph& graph, const ShadowInputs& inputs) {
    const LayerSpan span{&add_first_depth(graph, inputs), &add_last_depth(graph, inputs)};
    auto& planes = graph.value("planes", std::vector<float>{});
    const SplitSearch search{layers, similarity, bias, own_correction, search_request_};
    const bool searches = split.is("auto") && layers.get() > 1;
    std::optional<SplitSearch::Trials> trials;
    if (!searches)
        planes.set(layer_planes(layers.get(), fixed_ratio()));
    else if (search_frames.get() == 1)
        search.add_at_once(graph, inputs, add_histogram(graph, inputs, span, fine_ratio), planes);
    else
        trials.emplace(search.begin_trial(graph, inputs, planes));
    const DrawnLayers drawn = add_layers(graph, inputs, span, planes, {});
    Reads more;
    if (trials) {
        const bool rebuilds = similarity.is("error");
        more.push_back(
            &search.add_trial(graph, inputs, *trials, drawn,
                              rebuilds ? add_histogram(graph, inputs, span, fine_ratio) : drawn));
    }
    return layers_look_up(inputs, drawn, false, std::move(more));
}

// One layer has no plane to place.
double BoundingOpacityMaps::fixed_ratio() const {
    return split.is("logarithmic") ? 1.0 : split.is("hybrid") ? split_ratio.get() : 0.0;
}

}  // namespace opacity::techniques
