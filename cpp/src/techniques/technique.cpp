#include "opacity/technique.hpp"

#include <numeric>

#include "map/fragments.hpp"
#include "map/lookup.hpp"
#include "opacity/core/error.hpp"
#include "opacity/core/nearest_name.hpp"
#include "techniques/registry.hpp"

namespace opacity {

Defines light_defines(const LightSpace& space) {
    if (space.is_one_map()) return {};
    return {
        {space.is_parallel() ? "LIGHT_SPLITS" : "LIGHT_FACES", std::to_string(space.face_count())}};
}

Shader ShadowInputs::caster_shader(const std::string& fragment, bool optical_depth,
                                   Defines defines) const {
    for (const auto& define : light_defines(space)) defines.push_back(define);
    if (optical_depth) defines.emplace_back("OPTICAL_DEPTH", "1");
    if (has_opaque) defines.emplace_back("READS_OPAQUE_DEPTH", "1");
    if (paper_deposit) defines.emplace_back("PAPER_DEPOSIT", "1");
    return {.vertex = "casters.vert.glsl", .fragment = fragment, .defines = std::move(defines)};
}

Reads ShadowInputs::caster_reads(bool optical_depth, Reads more) const {
    if (optical_depth) more.push_back(&translucent.opacity);
    if (has_opaque) more.push_back(&opaque_depth);
    return more;
}

FragmentSource ShadowInputs::fragments(PassContext& context, bool optical_depth) const {
    std::span<const float> opaque;
    if (has_opaque) opaque = context.memory<float>(opaque_depth);
    return {casters, translucent.shapes(), space, opaque, paper_deposit, optical_depth};
}

LookUp Technique::look_up(const ShadowInputs& inputs, Reads reads,
                          std::function<std::unique_ptr<TexelMap>(PassContext&)> on_cpu) const {
    reads.insert(reads.end(),
                 {&inputs.light, &inputs.opaque_depth, &bias, &filter_radius, &filter_width});
    const bool bilinear = filter.is("box") && filter_width.is_auto() && filter_radius.get() == 0.5;
    Defines defines{{"FILTER_" + (bilinear ? "bilinear" : filter.get()), "1"}};
    if (filter_domain.is("density")) defines.emplace_back("DENSITY_FILTER", "1");
    for (const auto& define : light_defines(inputs.space)) defines.push_back(define);
    if (inputs.space.strand_detail < 1.0) defines.emplace_back("FEWER_STRANDS", "1");
    return {.reads = std::move(reads), .defines = std::move(defines), .on_cpu = std::move(on_cpu)};
}

std::vector<std::string> technique_names() {
    std::vector<std::string> names;
    for (const RegistryRow& row : registry_rows()) names.emplace_back(row.name);
    for (const RegisteredTechnique& row : registered_techniques()) names.push_back(row.name);
    return names;
}

std::unique_ptr<Technique> make_technique(std::string_view name) {
    for (const RegistryRow& row : registry_rows())
        if (row.name == name) return row.make();
    for (const RegisteredTechnique& row : registered_techniques())
        if (row.name == name) return row.make();
    const std::vector<std::string> names = technique_names();
    const std::string list = std::accumulate(
        names.begin(), names.end(), std::string{},
        [](const std::string& a, const std::string& b) { return a.empty() ? b : a + ", " + b; });
    throw ParameterError("there is no technique \"" + std::string{name} + "\"",
                         "did you mean \"" + nearest_name(name, names) + "\"? There are " + list);
}

}  // namespace opacity
