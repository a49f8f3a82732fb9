#include "techniques/coefficient_maps.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "techniques/coefficients_on_cpu.hpp"

namespace opacity::techniques {
namespace {

constexpr int coefficients_per_target = 4;

Reads reads_of(const Coefficients& coefficients, Reads more = {}) {
    more.insert(more.end(), coefficients.reads.begin(), coefficients.reads.end());
    for (Texture* bound : {coefficients.span.start, coefficients.span.end})
        if (bound) more.push_back(bound);
    return more;
}

Defines defines_of(const Coefficients& coefficients, Defines more = {}) {
    more.emplace_back("COEFFICIENTS", std::to_string(coefficients.count));
    more.insert(more.end(), coefficients.defines.begin(), coefficients.defines.end());
    return more;
}

}  // namespace

Texture& CoefficientMaps::coefficients_texture(FrameGraph& graph, const ShadowInputs& inputs,
                                               Format format, int count) {
    const int targets = (count + coefficients_per_target - 1) / coefficients_per_target;
    return graph.texture("coefficients", inputs.map(format, targets));
}

Coefficients CoefficientMaps::add_coefficients(FrameGraph& graph, const ShadowInputs& inputs,
                                               const Coefficients& coefficients) const {
    for (int first = 0; first < coefficients.targets(); first += targets_per_pass) {
        const int count = std::min(targets_per_pass, coefficients.targets() - first);
        std::vector<Target> writes;
        for (int target = first; target < first + count; ++target)
            writes.emplace_back(&coefficients.map, target);
        Defines defines = defines_of(coefficients, {{"PASS_coefficients", "1"},
                                                    {"TARGETS", std::to_string(count)},
                                                    {"FIRST_TARGET", std::to_string(first)}});
        const std::string part =
            first == 0 ? "" : "_" + std::to_string(first / targets_per_pass + 1);
        graph.add({.name = "coefficients" + part,
                   .shader = inputs.caster_shader(shader_path(), true, std::move(defines)),
                   .draws = &inputs.translucent,
                   .view = &inputs.light,
                   .reads = inputs.caster_reads(true, reads_of(coefficients)),
                   .writes = std::move(writes),
                   .state = {.blend = Blend::add},
                   .on_cpu = coefficients_on_cpu(inputs, coefficients, first, count)});
    }
    const auto kind = static_cast<Prefilter>(prefilter.index());
    Texture& filtered =
        add_prefilter(graph, inputs, coefficients.map, kind, prefilter_radius.get());
    return {
        filtered,           coefficients.count,   coefficients.span,      coefficients.expansion,
        coefficients.reads, coefficients.defines, kind != Prefilter::none};
}

LookUp CoefficientMaps::coefficients_look_up(const ShadowInputs& inputs,
                                             const Coefficients& coefficients, Reads more,
                                             Defines defines) const {
    more.push_back(&coefficients.map);
    LookUp result =
        look_up(inputs, reads_of(coefficients, std::move(more)), look_up_on_cpu(coefficients));
    for (auto& define : defines_of(coefficients, std::move(defines)))
        result.defines.push_back(std::move(define));
    // Once averaged, a caster's own part lies around it, too.
    result.own_correction = corrects(inputs) && !coefficients.is_prefiltered;
    return result;
}

}  // namespace opacity::techniques
