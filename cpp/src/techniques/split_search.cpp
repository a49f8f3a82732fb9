#include "techniques/split_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "opacity/core/split.hpp"
#include "scene/bias.hpp"
#include "techniques/histogram.hpp"

namespace opacity::techniques {
namespace {

// Profiles that own what they show.
struct Sample {
    SampledTexels texels;
    std::vector<float> biases;

    // `bias` as a part of the light's depth range.
    Sample(PassContext& context, const SampledLayers& sampled, double bias)
        : texels{read_texels(context, sampled)} {
        for (const float range : texels.depth_ranges)
            biases.push_back(range > 0.f ? float(std::min(1.0, bias / double(range))) : 1.f);
    }
    OpticalDepthProfiles profiles() const {
        return {texels.planes, texels.values, biases, texels.moments};
    }
};

std::string ratio_text(const char* before, std::size_t trial) {
    char text[64];
    std::snprintf(text, sizeof text, "%s %.1f", before, trial_ratio(trial));
    return text;
}

// "trial 4 of 11: ratio 0.3", and what was found once the last has its score.
std::string progress(std::span<const double> scores, Similarity similarity, bool is_trial) {
    const std::string trial = "trial " + std::to_string(scores.size()) + " of " +
                              std::to_string(split_trials) + ": " +
                              ratio_text("ratio", scores.size() - 1);
    if (scores.size() < split_trials) return trial;
    const std::string found = ratio_text("split ratio", best_trial(scores, similarity));
    return is_trial ? trial + "; " + found : found;
}

}  // namespace

double relative_bias(const ShadowInputs& inputs, const AutoParam<double>& bias) {
    const double width = mean_strand_width(inputs.translucent.shapes());
    return (bias.is_auto() ? width : bias.get()) / inputs.space.depth_range;
}

void SplitSearch::add_at_once(FrameGraph& graph, const ShadowInputs& inputs,
                              const DrawnLayers& histogram,
                              Value<std::vector<float>>& planes) const {
    const SampledLayers sampled = add_sampled_layers(graph, inputs, histogram);
    graph.add({.name = "split_search",
               .only_with = &inputs.translucent,
               .reads = sampled.reads({&histogram.planes, &layers, &similarity, &bias,
                                       &own_correction, &interpolation, &paper_lut, &request}),
               .values = {&planes},
               .execute = [search = *this, measure = measure(inputs), sampled, &planes,
                           bias_ls = relative_bias(inputs, bias)](PassContext& context) {
                   const Sample fine{context, sampled, bias_ls};
                   const std::size_t trial = find_split_trial(FineProfiles{fine.profiles()},
                                                              search.layers.get(), measure);
                   context.set(planes, search.planes(trial_ratio(trial)));
                   context.note(ratio_text("split ratio", trial));
               }});
}

SplitSearch::Trials SplitSearch::begin_trial(FrameGraph& graph, const ShadowInputs& inputs,
                                             Value<std::vector<float>>& planes) const {
    const Trials trials{graph.value("scores", std::vector<double>{}),
                        graph.value("searched", std::vector<Revision>{}),
                        graph.value("opaque", Revision{})};
    const std::vector<Revision> now{inputs.light.revision(),
                                    inputs.translucent.geometry.revision(),
                                    inputs.translucent.opacity.revision(),
                                    layers.revision(),
                                    similarity.revision(),
                                    bias.revision(),
                                    own_correction.revision(),
                                    interpolation.revision(),
                                    paper_lut.revision(),
                                    Revision{inputs.paper_deposit},
                                    request.revision()};
    // The opaque casters of this frame are drawn later: that they moved shows in the next one.
    const bool opaque_moved =
        !trials.scores.get().empty() && trials.opaque.get() != inputs.opaque_depth.revision();
    if (now != trials.searched.get() || opaque_moved) {
        trials.scores.set({});
        trials.searched.set(now);
        trials.searched.touch();  // a new search, of whatever
    }
    const std::vector<double>& scores = trials.scores.get();
    const std::size_t trial = scores.size() < split_trials
                                  ? scores.size()
                                  : best_trial(scores, Similarity(similarity.index()));
    planes.set(this->planes(trial_ratio(trial)));
    return trials;
}

const Source& SplitSearch::add_trial(FrameGraph& graph, const ShadowInputs& inputs,
                                     const Trials& trials, const DrawnLayers& drawn,
                                     const DrawnLayers& fine) const {
    const SampledLayers sampled = add_sampled_layers(graph, inputs, drawn);
    std::optional<SampledLayers> exact;
    if (&fine.map != &drawn.map) {
        const FrameGraph::Scope scope{graph, "fine"};
        exact.emplace(add_sampled_layers(graph, inputs, fine));
    }
    Reads reads{&drawn.planes,  &trials.searched, &inputs.light, &inputs.translucent.opacity,
                &layers,        &similarity,      &bias,         &own_correction,
                &interpolation, &paper_lut,       &request};
    sampled.add_to(reads);
    if (exact) {
        exact->add_to(reads);
        reads.push_back(&fine.planes);
    }
    graph.add({.name = "split_search",
               .only_with = &inputs.translucent,
               .reads = std::move(reads),
               .values = {&trials.scores, &trials.opaque},
               .execute = [measure = measure(inputs), trials, sampled, exact,
                           &opaque_depth = inputs.opaque_depth,
                           bias_ls = relative_bias(inputs, bias)](PassContext& context) {
                   std::vector<double> scores = trials.scores.get();
                   const bool is_trial = scores.size() < split_trials;
                   if (scores.empty()) context.set(trials.opaque, opaque_depth.revision());
                   if (is_trial) {
                       const Sample layers{context, sampled, bias_ls};
                       const Sample fine = exact ? Sample{context, *exact, bias_ls} : layers;
                       scores.push_back(
                           split_score(measure, layers.profiles(), FineProfiles{fine.profiles()}));
                       context.set(trials.scores, scores);
                   }
                   context.note(progress(scores, measure.similarity, is_trial));
               }});
    return trials.scores;
}

}  // namespace opacity::techniques
