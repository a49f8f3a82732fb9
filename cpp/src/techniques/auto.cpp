#include "techniques/auto.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>

namespace opacity::techniques {
namespace {

// From so many entries a texel on, layers are made in less time than lists (docs/comparison.md).
constexpr double most_listed = 8.0;
// What lists take: exact.hpp.
constexpr double bytes_a_texel = 28.0, bytes_an_entry = 32.0;

// Not less than the depth error that 16 layers were measured to have, and the power of the layers
// that it falls by.
struct LayerError {
    double with_16, power;
};
constexpr LayerError layer_errors[] = {{0.003, 1.2}, {0.013, 0.5}, {0.01, 0.8}};  // by Kind
constexpr int least_layers = 4, too_many_layers = 65;

std::string told(const char* text, double a, double b) {
    char line[160];
    std::snprintf(line, sizeof line, text, a, b);
    return line;
}

// What both have, such as the filter; layers are chosen.
void copy_params(const ParamOwner& from, ParamOwner& to) {
    for (ParamBase* param : to.params())
        for (const ParamBase* own : from.params())
            if (own->name() == param->name() && own->name() != "layers")
                param->assign(own->value());
}

}  // namespace

const std::shared_ptr<Technique>& Auto::exact() {
    std::shared_ptr<Technique>& technique = made_[0];
    if (!technique) technique = make_technique("exact");
    copy_params(*this, *technique);
    return technique;
}

const std::shared_ptr<Technique>& Auto::layered_maps(int layer_count) {
    std::shared_ptr<Technique>& technique = made_[layer_count];
    if (!technique) technique = make_technique("adaptive_opacity_maps");
    copy_params(*this, *technique);
    technique->param("layers").assign(std::int64_t{layer_count});
    return technique;
}

int Auto::layers_for_budget() const {
    const LayerError& error = layer_errors[std::size_t(load_.worst_kind())];
    const double ratio = error.with_16 / std::max(error_budget.get(), 1e-9);
    const double needed = 16.0 * std::pow(ratio, 1.0 / error.power);
    return int(std::clamp(std::ceil(needed), double(least_layers), double(too_many_layers)));
}

Technique::Delegate Auto::delegate(const Scene& scene, const LightSpace& space) {
    load_.update(scene);
    const double texels = double(space.width_px()) * space.height_px();
    const double entries = load_.entries(space.texels_per_unit);
    const double mib = (bytes_a_texel * texels + bytes_an_entry * entries) / (1 << 20);
    const double mean = entries / texels;
    const bool fits = mib <= memory.get(), are_few = mean <= most_listed;
    const int wanted = layers.is_auto() ? layers_for_budget() : layers.get();
    if (fits && are_few)
        return {exact(), told("exact: some %.1f entries a texel, lists of %.0f MiB", mean, mib)};
    if (fits && wanted == too_many_layers)
        return {exact(), told("exact: some %.1f entries a texel, and layers miss error_budget %g",
                              mean, error_budget.get())};
    const int count = std::min(wanted, too_many_layers - 1);
    return {layered_maps(count),
            "adaptive_opacity_maps, " + std::to_string(count) + " layers: " +
                (fits ? told("some %.1f entries a texel, error_budget %g", mean, error_budget.get())
                      : told("lists of %.0f MiB exceed memory %g", mib, double(memory.get())))};
}

LookUp Auto::build(FrameGraph& graph, const ShadowInputs& inputs) {
    return exact()->build(graph, inputs);
}

void Auto::needs_recompute() {
    for (const auto& [layers, technique] : made_) technique->needs_recompute();
}

}  // namespace opacity::techniques
