#include "techniques/fourier_opacity_maps.hpp"

#include <utility>
#include <vector>

#include "opacity/core/error.hpp"
#include "techniques/depth_bounds.hpp"

namespace opacity::techniques {

LookUp FourierOpacityMaps::build(FrameGraph& graph, const ShadowInputs& inputs) {
    if (bounds.is("per_texel") && !prefilter.is("none"))
        throw ParameterError(
            name() + ".bounds = per_texel has no mean of neighbours, whose depths differ",
            "set prefilter = none, and filter_radius instead; or bounds = global");
    const Coefficients drawn = add_coefficients(graph, inputs, series(graph, inputs));
    if (window.is("none")) return coefficients_look_up(inputs, drawn);
    auto& factors = graph.value("window_factors", std::vector<float>{});
    factors.set(lanczos_factors(basis_of(basis.get()), std::size_t(drawn.count)));
    return coefficients_look_up(inputs, drawn, {&factors}, {{"WINDOW", "1"}});
}

Coefficients FourierOpacityMaps::series(FrameGraph& graph, const ShadowInputs& inputs) const {
    const int count = coefficients.get();
    const auto& kind = basis_of(basis.get());
    const double free = margin.is_auto() ? kind.margin(std::size_t(count)) : margin.get();
    auto& inset = graph.value("inset", 0.f);
    inset.set(float(free / (1.0 + 2.0 * free)));
    std::vector<float> factors;
    if (window.is("lanczos")) factors = lanczos_factors(kind, std::size_t(count));
    LayerSpan span;
    if (bounds.is("per_texel"))
        span = {&add_first_depth(graph, inputs), &add_last_depth(graph, inputs)};
    const Format format = accumulator.is("float16") ? Format::rgba16f : Format::rgba32f;
    return {coefficients_texture(graph, inputs, format, count),
            count,
            span,
            std::make_shared<Series>(kind, inset.get(), std::move(factors)),
            {&inset},
            {{"BASIS_" + basis.get(), "1"}, {"BOUNDS_" + bounds.get(), "1"}}};
}

}  // namespace opacity::techniques
