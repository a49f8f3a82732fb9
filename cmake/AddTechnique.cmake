# A technique is three files that share its name, and one line in cpp/src/techniques/CMakeLists.txt:
#
#     opacity_add_technique(deep_opacity_maps)
#
#     techniques/deep_opacity_maps.hpp           class opacity::techniques::DeepOpacityMaps : public Technique
#     techniques/deep_opacity_maps.cpp           what it builds
#     shaders/techniques/deep_opacity_maps.glsl  all of its stages
#
# The line compiles the pair and adds a row to the table that opacity::registry_rows() returns, in the order of the lines.
# One that hands all work to others has no shader: opacity_add_technique(auto DELEGATES).
# A technique from elsewhere says where: opacity_add_technique(mine DIRECTORY src SHADER_DIRECTORY shaders/techniques).
include(TechniqueFiles)

function(opacity_add_technique name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "DELEGATES" "DIRECTORY;SHADER_DIRECTORY" "")
    set(directory ${PROJECT_SOURCE_DIR}/cpp/src/techniques)
    set(shader_directory ${PROJECT_SOURCE_DIR}/cpp/shaders/techniques)
    set(header techniques/${name}.hpp)
    if(arg_DIRECTORY)
        cmake_path(ABSOLUTE_PATH arg_DIRECTORY OUTPUT_VARIABLE directory)
        set(header ${directory}/${name}.hpp)
    endif()
    if(arg_SHADER_DIRECTORY)
        cmake_path(ABSOLUTE_PATH arg_SHADER_DIRECTORY OUTPUT_VARIABLE shader_directory)
    endif()
    if(arg_DELEGATES)
        set(shader_directory "")
    endif()

    opacity_technique_files(opacity_add_technique ${name} ${directory} "${shader_directory}" class)
    target_sources(opacity PRIVATE ${directory}/${name}.cpp)
    set_property(TARGET opacity APPEND_STRING PROPERTY OPACITY_REGISTRY_INCLUDES "#include \"${header}\"\n")
    set_property(TARGET opacity APPEND_STRING PROPERTY OPACITY_REGISTRY_ROWS
        "    {\"${name}\", [] { return std::unique_ptr<Technique>(std::make_unique<techniques::${class}>()); }},\n")
endfunction()

# After the last technique: writes the table.
function(opacity_write_registry target)
    get_target_property(includes ${target} OPACITY_REGISTRY_INCLUDES)
    get_target_property(rows ${target} OPACITY_REGISTRY_ROWS)
    if(NOT rows)
        message(FATAL_ERROR "No technique is registered: cpp/src/techniques/CMakeLists.txt has no opacity_add_technique line.")
    endif()
    set(registry ${CMAKE_CURRENT_BINARY_DIR}/registry_rows.cpp)
    file(CONFIGURE OUTPUT ${registry} @ONLY CONTENT [[
// Generated from the opacity_add_technique lines in cpp/src/techniques/CMakeLists.txt.
#include "techniques/registry.hpp"

#include <memory>
#include <span>

@includes@
namespace opacity {

static const RegistryRow rows[] = {
@rows@};

std::span<const RegistryRow> registry_rows() { return rows; }

}  // namespace opacity
]])
    target_sources(${target} PRIVATE ${registry})
endfunction()
