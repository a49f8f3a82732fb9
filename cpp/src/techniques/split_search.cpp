#include "techniques/split_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "opacity/core/split.hpp"
#include "scene/bias.hpp"

namespace opacity::techniques {
namespace {

constexpr int block_size_px = 4;

// Texels that a search looks at: those of a map of this size, spread over the whole, and of those
// so many with casters, with the empty ones between them.
constexpr int sampled_size_px = 128;
constexpr std::size_t sampled_texels = 4096;

// The read-back holds one image a layer.
struct ReadBack {
    std::vector<float> targets, start, end;
    std::vector<float> planes;
    int width_px, height_px;

    ReadBack(PassContext& context, const DrawnLayers& drawn)
        : targets{context.read<float>(drawn.map)},
          start{context.read<float>(*drawn.span.start)},
          end{context.read<float>(*drawn.span.end)},
          planes{drawn.planes.get()},
          width_px{drawn.map.desc().width},
          height_px{drawn.map.desc().height} {}

    int layers() const { return int(planes.size()) - 1; }
    float plane(std::size_t texel, int k) const {
        return targets[(std::size_t(k / planes_per_target) * start.size() + texel) *
                           planes_per_target +
                       k % planes_per_target];
    }
};

// The same texels for whatever layers of the same casters.
std::vector<std::size_t> sampled(const ReadBack& drawn) {
    std::vector<std::size_t> texels;
    std::size_t covered = 0;
    const auto is_sampled = [stride = block_stride(drawn.width_px)](int i) {
        return i / block_size_px % stride == 0;
    };
    for (int y = 0; y < drawn.height_px; ++y)
        for (int x = 0; x < drawn.width_px; ++x) {
            if (!is_sampled(x) || !is_sampled(y)) continue;
            texels.push_back(std::size_t(y) * drawn.width_px + x);
            covered += drawn.plane(texels.back(), drawn.layers() - 1) > 0.f;
        }
    const std::size_t stride = std::max<std::size_t>(1, covered / sampled_texels);
    std::vector<std::size_t> some;
    for (std::size_t i = 0; i < texels.size(); i += stride) some.push_back(texels[i]);
    return some;
}

// Profiles that own what they show.
struct Sample {
    std::vector<float> planes, values, biases;

    // `bias` as a part of the light's depth range.
    Sample(const ReadBack& drawn, double bias) : planes{drawn.planes} {
        for (std::size_t texel : sampled(drawn)) {
            for (int k = 0; k < drawn.layers(); ++k) values.push_back(drawn.plane(texel, k));
            const float range = drawn.end[texel] - drawn.start[texel];
            biases.push_back(range > 0.f ? float(std::min(1.0, bias / double(range))) : 1.f);
        }
    }
    OpticalDepthProfiles profiles() const { return {planes, values, biases}; }
};

// Of receivers on the casters themselves, as a part of the light's depth range.
double relative_bias(const ShadowInputs& inputs, const AutoParam<double>& bias) {
    const double width = mean_strand_width(inputs.translucent.shapes());
    return (bias.is_auto() ? width : bias.get()) / inputs.space.depth_range;
}

std::string ratio_text(const char* before, std::size_t trial) {
    char text[64];
    std::snprintf(text, sizeof text, "%s %.1f", before, trial_ratio(trial));
    return text;
}

// "trial 4 of 11: ratio 0.3", and what was found once the last has its score.
std::string progress(std::span<const double> scores, bool is_trial) {
    const std::string trial = "trial " + std::to_string(scores.size()) + " of " +
                              std::to_string(split_trials) + ": " +
                              ratio_text("ratio", scores.size() - 1);
    if (scores.size() < split_trials) return trial;
    const std::string found = ratio_text("split ratio", best_trial(scores));
    return is_trial ? trial + "; " + found : found;
}

}  // namespace

int fine_layer_count(int map_width_px) {
    return map_width_px <= 1024 ? 64 : map_width_px <= 2048 ? 32 : 16;
}

int block_stride(int map_width_px) {
    return std::max(1, map_width_px / sampled_size_px);
}

void SplitSearch::add_at_once(FrameGraph& graph, const ShadowInputs& inputs,
                              const DrawnLayers& histogram,
                              Value<std::vector<float>>& planes) const {
    graph.add(
        {.name = "split_search",
         .only_with = &inputs.translucent,
         .reads = {&histogram.map, &histogram.planes, histogram.span.start, histogram.span.end,
                   &layers, &similarity, &bias, &own_correction, &request},
         .values = {&planes},
         .execute = [search = *this, measure = measure(inputs), histogram, &planes,
                     bias_ls = relative_bias(inputs, bias)](PassContext& context) {
             const Sample fine{{context, histogram}, bias_ls};
             const int count = search.layers.get();
             const std::size_t trial =
                 find_split_trial(FineProfiles{fine.profiles()}, count, measure);
             context.set(planes, layer_planes(count, trial_ratio(trial)));
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
    const std::size_t trial = scores.size() < split_trials ? scores.size() : best_trial(scores);
    planes.set(layer_planes(layers.get(), trial_ratio(trial)));
    return trials;
}

const Source& SplitSearch::add_trial(FrameGraph& graph, const ShadowInputs& inputs,
                                     const Trials& trials, const DrawnLayers& drawn,
                                     const DrawnLayers& fine) const {
    const bool has_fine = &fine.map != &drawn.map;
    Reads reads{&drawn.map,
                &drawn.planes,
                drawn.span.start,
                drawn.span.end,
                &trials.searched,
                &inputs.light,
                &inputs.translucent.opacity,
                &layers,
                &similarity,
                &bias,
                &own_correction,
                &request};
    if (has_fine) reads.insert(reads.end(), {&fine.map, &fine.planes});
    graph.add({.name = "split_search",
               .only_with = &inputs.translucent,
               .reads = std::move(reads),
               .values = {&trials.scores, &trials.opaque},
               .execute = [measure = measure(inputs), trials, drawn, fine, has_fine,
                           &opaque_depth = inputs.opaque_depth,
                           bias_ls = relative_bias(inputs, bias)](PassContext& context) {
                   std::vector<double> scores = trials.scores.get();
                   const bool is_trial = scores.size() < split_trials;
                   if (scores.empty()) context.set(trials.opaque, opaque_depth.revision());
                   if (is_trial) {
                       const Sample layers{{context, drawn}, bias_ls};
                       const Sample exact = has_fine ? Sample{{context, fine}, bias_ls} : layers;
                       scores.push_back(
                           split_score(measure, layers.profiles(), FineProfiles{exact.profiles()}));
                       context.set(trials.scores, scores);
                   }
                   context.note(progress(scores, is_trial));
               }});
    return trials.scores;
}

}  // namespace opacity::techniques
