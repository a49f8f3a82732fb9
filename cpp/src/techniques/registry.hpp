// The table that CMake generates from techniques/CMakeLists.txt.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "opacity/technique.hpp"

namespace opacity {

struct RegistryRow {
    std::string_view name;
    std::unique_ptr<Technique> (*make)();
};

std::span<const RegistryRow> registry_rows();

}  // namespace opacity
