// A technique that its description makes, and no class of its own.
#pragma once

#include <atomic>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "opacity/technique.hpp"
#include "opacity/technique_description.hpp"

namespace opacity::techniques {

// What is registered under a name, until something else is.
struct Script {
    explicit Script(TechniqueDescription d) : description{std::move(d)} {}
    const TechniqueDescription description;
    std::atomic<bool> is_replaced{false};
};

class ScriptedTechnique : public Technique {
   public:
    explicit ScriptedTechnique(std::shared_ptr<const Script> script);

    std::string_view summary() const override { return description().summary; }
    std::string_view paper() const override { return description().paper; }
    LookUp build(FrameGraph& graph, const ShadowInputs& inputs) override;

   private:
    const TechniqueDescription& description() const { return script_->description; }

    std::shared_ptr<const Script> script_;
    std::vector<std::unique_ptr<ParamBase>> described_;
};

// ParameterError that names the field which is wrong.
void check(const TechniqueDescription& description);

}  // namespace opacity::techniques
