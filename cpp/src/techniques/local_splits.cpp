#include "techniques/local_splits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/parallel.hpp"
#include "map/split_score.hpp"
#include "opacity/core/error.hpp"

namespace opacity::techniques {
namespace {

// Of one texel: a score of each trial, and their weight.
constexpr std::size_t score_channels = split_trials + 1;
constexpr int score_layers = (int(score_channels) + planes_per_target - 1) / planes_per_target;
using Scores = std::array<float, score_channels>;

constexpr float equal_scores = 1e-4f, own_weight = 8.f;  // of split_ratios.comp.glsl

void require_local(const Choice& similarity) {
    if (similarity.is("correlation") || similarity.is("paper_correlation"))
        throw ParameterError("bounding_opacity_maps.similarity = " + similarity.get() +
                                 " compares whole images, and a texel is none",
                             "choose error or absolute_difference, or split = \"auto\"");
}

std::size_t place_of(std::size_t texel_count, std::size_t texel, std::size_t channel) {
    return (channel / planes_per_target * texel_count + texel) * planes_per_target +
           channel % planes_per_target;
}

// What the passes are made of.
struct LocalSearch {
    SplitMeasure measure;
    DrawnLayers histogram;
    Value<std::vector<float>>& planes;
    Value<float>& bias;  // of receivers, in light space
    Texture &scores, &ratios;
    int region_px;

    std::size_t texel_count() const {
        return std::size_t(scores.desc().width) * std::size_t(scores.desc().height);
    }
    Defines defines(const Choice& similarity) const {
        Defines all{{"CELLS", std::to_string(histogram.layer_count())},
                    histogram.image_define(),
                    {"CURVES", std::to_string(split_trials)},
                    {"SIMILARITY_" + similarity.get(), "1"}};
        if (measure.has_moments) all.emplace_back("MEAN_DEPTHS", "1");
        if (measure.look_up.few_casters) all.emplace_back("FEW_CASTERS", "1");
        if (measure.look_up.own_correction) all.emplace_back("OWN_CORRECTION", "1");
        return all;
    }
    void score_on_cpu(PassContext& context) const;
    void pick_on_cpu(PassContext& context) const;
};

void LocalSearch::score_on_cpu(PassContext& context) const {
    const std::span<const float> cells = histogram.planes.get();
    const auto fine = context.memory<float>(histogram.map);
    const auto start = context.memory<float>(*histogram.span.start);
    const auto end = context.memory<float>(*histogram.span.end);
    const auto found = context.memory<float>(scores);
    const std::size_t count = texel_count(), planes_a_trial = planes.get().size() / split_trials;
    parallel_for(count, [&](std::size_t texel) {
        std::array<float, FineTexel::most_cells> sums;
        for (std::size_t k = 0; k + 1 < cells.size(); ++k)
            sums[k] = fine[place_of(count, texel, k)];
        const float range = end[texel] - start[texel];
        const FineTexel one{cells, std::span{sums}.first(cells.size() - 1),
                            range > bias.get() ? bias.get() / range : 1.f};
        const auto score = [&](std::size_t trial) {
            const std::span<const float> all = planes.get();
            return one.score(measure, all.subspan(trial * planes_a_trial, planes_a_trial));
        };
        for (std::size_t trial = 0; trial < score_channels; ++trial)
            found[place_of(count, texel, trial)] = !(one.optical_depth() > 0.f) ? 0.f
                                                   : trial < split_trials       ? score(trial)
                                                                          : one.optical_depth();
    });
}

// The first trial that is no worse than the best.
float best_ratio(const Scores& sums) {
    const float weight = sums.back(), least = *std::min_element(sums.begin(), sums.end());
    if (!(weight > 0.f)) return 0.f;
    const float enough = std::sqrt(least / weight) + equal_scores;
    std::size_t best = 0;
    while (best + 1 < split_trials && std::sqrt(sums[best] / weight) > enough) ++best;
    return float(best) / float(split_trials - 1);
}

void LocalSearch::pick_on_cpu(PassContext& context) const {
    const auto all = context.memory<float>(scores);
    const auto found = context.memory<float>(ratios);
    const int width = scores.desc().width, height = scores.desc().height;
    const int across = ratios.desc().width;
    parallel_for(found.size(), [&](std::size_t region) {
        const int left = int(region) % across * region_px, right = left + region_px - 1;
        const int top = int(region) / across * region_px, bottom = top + region_px - 1;
        Scores sums{};
        for (int y = std::max(top - 1, 0); y <= std::min(bottom + 1, height - 1); ++y)
            for (int x = std::max(left - 1, 0); x <= std::min(right + 1, width - 1); ++x) {
                const bool is_own = x >= left && x <= right && y >= top && y <= bottom;
                for (std::size_t i = 0; i < score_channels; ++i)
                    sums[i] += (is_own ? own_weight : 1.f) *
                               all[place_of(texel_count(), std::size_t(y) * width + x, i)];
            }
        found[region] = best_ratio(sums);
    });
}

std::function<void(PassContext&)> for_all(const Texture& texture) {
    return [&texture](PassContext& context) {
        context.dispatch(texture.desc().width * texture.desc().height);
    };
}

}  // namespace

LocalCurves add_local_splits(FrameGraph& graph, const ShadowInputs& inputs,
                             const SplitSearch& search, const DrawnLayers& histogram,
                             Value<std::vector<float>>& planes, int region_px) {
    require_local(search.similarity);
    auto& cells = graph.value("cells", std::vector<float>{});
    cells.set(histogram.planes.get());
    auto& bias = graph.value("receiver_bias", 0.f);
    bias.set(float(relative_bias(inputs, search.bias)));
    TextureDesc regions = inputs.map(Format::r32f);
    regions.width = (regions.width + region_px - 1) / region_px;
    regions.height = (regions.height + region_px - 1) / region_px;
    const LocalSearch local{
        search.measure(inputs),
        histogram,
        planes,
        bias,
        graph.texture("split_scores", inputs.map(Format::rgba32f, score_layers)),
        graph.texture("split_ratios", regions),
        region_px};
    graph.add({.name = "split_scores",
               .shader = {.compute = "split_scores.comp.glsl",
                          .defines = local.defines(search.similarity)},
               .only_with = &inputs.translucent,
               .reads = {&histogram.map, &cells, &planes, &search.layers, histogram.span.start,
                         histogram.span.end, &bias},
               .stores = {&local.scores},
               .execute = for_all(local.scores),
               .on_cpu = [local](PassContext& context) { local.score_on_cpu(context); }});
    graph.add({.name = "split_ratios",
               .shader = {.compute = "split_ratios.comp.glsl",
                          .defines = {{"CURVES", std::to_string(split_trials)},
                                      {"REGION_PX", std::to_string(region_px)}}},
               .only_with = &inputs.translucent,
               .reads = {&local.scores},
               .stores = {&local.ratios},
               .execute = for_all(local.ratios),
               .on_cpu = [local](PassContext& context) { local.pick_on_cpu(context); }});
    return {&local.ratios, region_px};
}

}  // namespace opacity::techniques
