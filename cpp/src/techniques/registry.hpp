// The techniques by name: the table that CMake generates from techniques/CMakeLists.txt, and after
// it what is registered while the program runs.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "opacity/core/source.hpp"
#include "opacity/technique.hpp"

namespace opacity {

struct RegistryRow {
    std::string_view name;
    std::unique_ptr<Technique> (*make)();
};

std::span<const RegistryRow> registry_rows();

struct RegisteredTechnique {
    std::string shader_path() const { return "techniques/" + name + ".glsl"; }

    std::string name;
    std::string shader;                                // the text of it
    std::function<std::unique_ptr<Technique>()> make;  // called only when it is asked for
    bool replaceable = false;                          // by another one that is
};

// a-z, 0-9 and _, a letter first: what may name a file, a uniform, a scope of the report.
bool is_word(std::string_view name);

// All of them, or none: ParameterError for a name that is no word, or taken.
void register_techniques(std::vector<RegisteredTechnique> techniques);
std::vector<RegisteredTechnique> registered_techniques();
// Moves when one is registered, and with it the text of shaders.
Revision registered_revision();

}  // namespace opacity
