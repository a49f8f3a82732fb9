#include "techniques/scripted_technique.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "opacity/core/error.hpp"
#include "techniques/description_words.hpp"

namespace opacity::techniques {
namespace {

std::unique_ptr<ParamBase> make_param(ParamOwner& owner, const ParamDescription& p) {
    if (const auto* b = std::get_if<bool>(&p.initial))
        return std::make_unique<Param<bool>>(owner, p.name, *b, p.doc);
    if (const auto* i = std::get_if<std::int64_t>(&p.initial))
        return std::make_unique<Param<int>>(owner, p.name, int(*i),
                                            Range{int(p.range.min), int(p.range.max)}, p.doc);
    if (const auto* d = std::get_if<double>(&p.initial))
        return std::make_unique<Param<double>>(owner, p.name, *d, p.range, p.doc);
    return std::make_unique<Choice>(owner, p.name, p.choices, p.doc);
}

// One frame's declarations: the textures by name, and the passes over them.
class Declared {
   public:
    Declared(FrameGraph& graph, const ShadowInputs& inputs, const Technique& technique)
        : graph_{graph}, inputs_{inputs}, technique_{technique} {}

    void texture(const TextureDescription& t) {
        textures_[t.name] =
            &graph_.texture(t.name, inputs_.map(format_words.at(t.format), t.layers));
    }

    void pass(const PassDescription& p) {
        graph_.add(p.over == "texels" ? over_texels(p) : over_casters(p));
    }

    Reads sources(const std::vector<std::string>& names) const {
        Reads found;
        for (const std::string& name : names) {
            const auto texture = textures_.find(name);
            if (texture != textures_.end())
                found.push_back(texture->second);
            else
                found.push_back(&technique_.param(name));
        }
        return found;
    }

   private:
    static Defines own_stage(const PassDescription& p) { return {{"PASS_" + p.name, "1"}}; }

    Pass over_casters(const PassDescription& p) const {
        const Depth depth = depth_words.at(p.depth);
        Pass pass{.name = p.name,
                  .shader = p.fragment.empty()
                                ? inputs_.caster_shader(technique_.shader_path(), p.optical_depth,
                                                        own_stage(p))
                                : inputs_.caster_shader(p.fragment, p.optical_depth),
                  .draws = &inputs_.translucent,
                  .view = &inputs_.light,
                  .reads = inputs_.caster_reads(p.optical_depth, sources(p.reads)),
                  .state = {.depth = depth,
                            .blend = blend_words.at(p.blend),
                            .clear_depth = depth == Depth::greater ? 0.f : 1.f}};
        for (const std::string& name : p.writes) {
            Texture* texture = textures_.at(name);
            for (int layer = 0; layer < std::max(1, texture->desc().layers); ++layer)
                pass.writes.emplace_back(texture, layer);
        }
        return pass;
    }

    Pass over_texels(const PassDescription& p) const {
        Pass pass{.name = p.name,
                  .shader = {.compute = technique_.shader_path(), .defines = own_stage(p)},
                  .only_with = &inputs_.translucent,
                  .reads = sources(p.reads)};
        pass.reads.push_back(&inputs_.light);
        int texels = 0;
        for (const std::string& name : p.writes) {
            pass.stores.push_back(textures_.at(name));
            const TextureDesc& desc = textures_.at(name)->desc();
            texels = std::max(texels, desc.width * desc.height * std::max(1, desc.layers));
        }
        pass.execute = [texels](PassContext& context) { context.dispatch(texels); };
        return pass;
    }

    FrameGraph& graph_;
    const ShadowInputs& inputs_;
    const Technique& technique_;
    std::map<std::string, Texture*> textures_;
};

}  // namespace

ScriptedTechnique::ScriptedTechnique(std::shared_ptr<const Script> script)
    : Technique{script->description.name}, script_{std::move(script)} {
    for (const ParamDescription& param : description().parameters)
        described_.push_back(make_param(*this, param));
}

LookUp ScriptedTechnique::build(FrameGraph& graph, const ShadowInputs& inputs) {
    if (script_->is_replaced)
        throw ParameterError(
            "\"" + name() + "\" was registered again after this technique was made",
            "make it anew, as in renderer.technique = pyopacity.technique(\"" + name() + "\")");
    Declared declared{graph, inputs, *this};
    for (const TextureDescription& texture : description().textures) declared.texture(texture);
    for (const PassDescription& pass : description().passes) declared.pass(pass);
    LookUp result = look_up(inputs, declared.sources(description().look_up));
    result.own_correction = description().own_correction && !inputs.paper_deposit;
    return result;
}

}  // namespace opacity::techniques
