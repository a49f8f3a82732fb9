// Here, and not beside the techniques, since it looks at the shader as the device will read it.
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "gl/shader_library.hpp"
#include "opacity/technique_description.hpp"
#include "techniques/registry.hpp"
#include "techniques/scripted_technique.hpp"

namespace opacity {
namespace {

using techniques::Script;
using techniques::ScriptedTechnique;

// ShaderError for a file of the engine that does not exist. What else may be wrong takes a driver.
void check_files(const RegisteredTechnique& row, const TechniqueDescription& description) {
    gl::ShaderLibrary library;
    library.add(row.shader_path(), row.shader);
    library.expand(row.shader_path());
    for (const PassDescription& pass : description.passes)
        if (!pass.fragment.empty()) library.text(pass.fragment);
}

}  // namespace

void register_technique(TechniqueDescription description) {
    techniques::check(description);
    static std::mutex mutex;
    static std::map<std::string, std::shared_ptr<Script>> current;
    const auto script = std::make_shared<Script>(std::move(description));
    RegisteredTechnique row{
        .name = script->description.name,
        .shader = script->description.shader,
        .make = [script] { return std::make_unique<ScriptedTechnique>(script); },
        .replaceable = true};
    check_files(row, script->description);
    const std::lock_guard lock{mutex};
    register_techniques({row});
    std::shared_ptr<Script>& place = current[row.name];
    if (place) place->is_replaced = true;
    place = script;
}

}  // namespace opacity
