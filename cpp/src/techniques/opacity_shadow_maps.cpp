#include "techniques/opacity_shadow_maps.hpp"

#include <cmath>

#include "opacity/core/slicing.hpp"
#include "techniques/histogram.hpp"

namespace opacity::techniques {
namespace {

// How much light each cell takes, over all texels.
DepthHistogram lost_light(const SampledTexels& texels) {
    const OpticalDepthProfiles profiles = texels.profiles();
    DepthHistogram histogram{{profiles.planes.begin(), profiles.planes.end()},
                             std::vector<double>(profiles.layers())};
    for (std::size_t t = 0; t < profiles.texel_count(); ++t) {
        const std::span<const float> texel = profiles.texel(t);
        for (std::size_t k = 0; k < profiles.layers(); ++k)
            histogram.masses[k] +=
                std::exp(-at_plane(texel, k)) - std::exp(-at_plane(texel, k + 1));
    }
    return histogram;
}

}  // namespace

LookUp OpacityShadowMaps::build(FrameGraph& graph, const ShadowInputs& inputs) {
    const DepositWay way = deposit_way(graph, inputs);
    auto& planes = graph.value("planes", std::vector<float>{});
    if (slicing.is("density") && !inputs.translucent.shapes().empty())
        add_slices(graph, inputs, way, planes);
    else
        planes.set(gamma_slices(layers.get(), slicing.is("gamma") ? gamma.get() : 1.0));
    const double full = kappa.is_auto() ? full_8_bits : kappa.get();
    const DrawnLayers drawn = add_layers(graph, inputs, way, {}, planes, {.kappa = full});
    const Interpolation between =
        interpolation.is("cubic") ? Interpolation::cubic : Interpolation::linear;
    LookUp look_up = layers_look_up(inputs, drawn, between);
    // Sums of optical depth over a filter would have to be kept for each receiver.
    if (buffers.is("two") && !filter_domain.is("density") && !inputs.translucent.shapes().empty())
        look_up.sweep = layers_sweep(graph, inputs, drawn, between);
    return look_up;
}

void OpacityShadowMaps::add_slices(FrameGraph& graph, const ShadowInputs& inputs,
                                   const DepositWay& way, Planes& planes) const {
    const SampledLayers sampled =
        add_sampled_layers(graph, inputs, add_histogram(graph, inputs, way, {}, 0.0));
    graph.add({.name = "slices",
               .reads = sampled.reads({&sampled.drawn.planes, &layers}),
               .values = {&planes},
               .execute = [sampled, &planes, &layers = layers](PassContext& context) {
                   const auto lost = lost_light(read_texels(context, sampled));
                   context.set(planes, density_slices(layers.get(), lost));
               }});
}

}  // namespace opacity::techniques
