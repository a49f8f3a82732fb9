// A plugin is a shared library, built against the installed headers, whose techniques join the
// registry when it is loaded. It brings the text of their shaders along, which may #include the
// engine's own. docs/plugins.md walks through one: the three files of a technique, and
//     opacity_add_plugin(first_hit)
// in CMake, which writes the entry point below.
#pragma once

#include <cstddef>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "opacity/core/error.hpp"
#include "opacity/core/source.hpp"
#include "opacity/technique.hpp"

namespace opacity {

// A file that is no plugin, or none of this engine.
struct PluginError : Error {
    using Error::Error;
};

struct PluginTechnique {
    const char* name;    // a word of a-z, 0-9 and _; also that of what make returns
    const char* shader;  // the text of techniques/<name>.glsl
    std::unique_ptr<Technique> (*make)();  // called only when the technique is asked for
};

template <class T>
std::unique_ptr<Technique> plugin_technique() {
    return std::make_unique<T>();
}

// What the entry point returns. Nothing behind `interface` is looked at unless that is the
// engine's.
struct Plugin {
    const char* interface;  // first in all versions: the headers that the plugin was built with
    Revision (*engine)();   // the copy of the engine that it is linked to
    const PluginTechnique* techniques;
    std::size_t count;
};

// Opens the library and registers its techniques under their names, which it returns; none of them
// is made before it is asked for. A library that is loaded already stays as it is; none is
// unloaded. PluginError, and the registry is as it was, where the file is no library, has no entry
// point, was built against other headers, or brings a name that is taken.
std::vector<std::string> load_plugin(const std::filesystem::path& path);

}  // namespace opacity

// The entry point, once in a plugin, around its techniques:
//     OPACITY_PLUGIN({"first_hit", first_hit_glsl, opacity::plugin_technique<FirstHit>})
// OPACITY_INTERFACE is what opacity_add_plugin defines, or ${opacity_INTERFACE} of the CMake
// package.
#define OPACITY_PLUGIN(...)                                                             \
    extern "C" [[gnu::visibility("default")]] const opacity::Plugin* opacity_plugin() { \
        static const opacity::PluginTechnique techniques[] = {__VA_ARGS__};             \
        static const opacity::Plugin plugin{OPACITY_INTERFACE, &opacity::next_revision, \
                                            techniques, std::size(techniques)};         \
        return &plugin;                                                                 \
    }
