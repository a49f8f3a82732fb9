// The passes that find the split ratio of a technique with layers (thesis, algorithm 5.2.3.1):
// eleven trials in one frame, rebinned from one fine histogram, or one a frame, as in the thesis.
// What a search has found so far is a value of the graph.
#pragma once

#include <vector>

#include "opacity/core/split_search.hpp"
#include "opacity/technique.hpp"
#include "techniques/drawn_layers.hpp"

namespace opacity::techniques {

// Of receivers on the casters themselves, as a part of the light's depth range.
double relative_bias(const ShadowInputs& inputs, const AutoParam<double>& bias);

// What a search is told: how many layers, by which measure, with which bias T is looked up, and
// when to search again.
struct SplitSearch {
    const Param<int>& layers;
    const Choice& similarity;  // in the order of Similarity
    const AutoParam<double>& bias;
    const Param<bool>& own_correction;
    const Choice& interpolation;
    const Param<bool>& paper_lut;
    const Source& request;
    std::vector<float> planes(double ratio) const {
        return layer_planes(layers.get(), ratio, paper_lut.get());
    }
    Interpolation between;  // what `interpolation` means for these casters

    SplitMeasure measure(const ShadowInputs& inputs) const {
        return {Similarity(similarity.index()),
                {own_correction.get() && !inputs.paper_deposit,
                 between == Interpolation::mean_depth_of_few},
                between != Interpolation::linear,
                paper_lut.get()};
    }

    // One frame: sets `planes` to those of the best ratio.
    void add_at_once(FrameGraph& graph, const ShadowInputs& inputs, const DrawnLayers& histogram,
                     Value<std::vector<float>>& planes) const;

    // Eleven frames: the first call lays the planes of this frame's trial, or after the last trial
    // those of the best; the second scores the layers that were drawn at them, for `error`
    // against the fine ones. The look-up reads what it returns, so that a frame needs its trial.
    struct Trials {
        Value<std::vector<double>>& scores;      // of the trials so far
        Value<std::vector<Revision>>& searched;  // what they are made for
        Value<Revision>& opaque;                 // the opaque casters before which they are made
    };
    Trials begin_trial(FrameGraph& graph, const ShadowInputs& inputs,
                       Value<std::vector<float>>& planes) const;
    const Source& add_trial(FrameGraph& graph, const ShadowInputs& inputs, const Trials& trials,
                            const DrawnLayers& drawn, const DrawnLayers& fine) const;
};

}  // namespace opacity::techniques
