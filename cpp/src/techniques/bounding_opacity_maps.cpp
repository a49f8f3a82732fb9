#include "techniques/bounding_opacity_maps.hpp"

#include <optional>
#include <utility>

#include "opacity/core/error.hpp"
#include "opacity/core/split.hpp"
#include "techniques/histogram.hpp"
#include "techniques/local_splits.hpp"

namespace opacity::techniques {

LookUp BoundingOpacityMaps::build(FrameGraph& graph, const ShadowInputs& inputs) {
    const DepositWay way = deposit_way(graph, inputs);
    const LayerSpan span = add_span(graph, inputs, way);
    auto& planes = graph.value("planes", std::vector<float>{});
    const Interpolation between = between_planes(inputs);
    const SplitSearch search{layers,    similarity,      bias,   own_correction, interpolation,
                             paper_lut, search_request_, between};
    const auto histogram = [&](bool in_all_texels = false) -> DrawnLayers {
        return add_histogram(graph, inputs, way, span, fine_ratio, in_all_texels);
    };
    LocalCurves curves;
    std::optional<SplitSearch::Trials> trials;
    if (layers.get() == 1 || !is_searched()) {
        planes.set(search.planes(fixed_ratio()));
    } else if (!split.is("auto")) {
        require_one_frame();
        planes.set(trial_planes(layers.get(), paper_lut.get()));
        curves = add_local_splits(graph, inputs, search, histogram(true), planes, region_px());
    } else if (search_frames.get() == 1) {
        search.add_at_once(graph, inputs, histogram(), planes);
    } else {
        trials.emplace(search.begin_trial(graph, inputs, planes));
    }
    const DrawnLayers drawn =
        add_layers(graph, inputs, way, span, planes,
                   {.mean_depths = between != Interpolation::linear, .curves = curves});
    Reads more;
    if (trials) {
        const bool rebuilds = similarity.is("error");
        more.push_back(
            &search.add_trial(graph, inputs, *trials, drawn, rebuilds ? histogram() : drawn));
    }
    return layers_look_up(inputs, drawn, between, std::move(more));
}

LayerSpan BoundingOpacityMaps::add_span(FrameGraph& graph, const ShadowInputs& inputs,
                                        const DepositWay& way) const {
    if (bounds.is("one_pass")) return add_bounds(graph, inputs, way);
    Texture& start = add_first_depth(graph, inputs);
    if (bounds.is("depth_func")) return {&start, &add_last_depth(graph, inputs)};
    return {&start, &add_last_depth_mirrored(graph, inputs, bounds.is("depth_range"))};
}

// Eleven frames would draw eleven maps for what one histogram tells.
void BoundingOpacityMaps::require_one_frame() const {
    if (search_frames.get() != 1)
        throw ParameterError(
            "bounding_opacity_maps.split = " + split.get() + " is found in one frame, not in 11",
            "set search_frames to 1, or split to auto");
}

bool BoundingOpacityMaps::is_searched() const {
    return split.is("auto") || split.is("per_texel") || split.is("per_region");
}

int BoundingOpacityMaps::region_px() const {
    return split.is("per_region") ? region_side_px : 1;
}

// One layer has no plane to place.
double BoundingOpacityMaps::fixed_ratio() const {
    return split.is("logarithmic") ? 1.0 : split.is("hybrid") ? split_ratio.get() : 0.0;
}

}  // namespace opacity::techniques
