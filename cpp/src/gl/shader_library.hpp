// The text of shaders, by path: embedded at build time, or read from the
// directory in OPACITY_SHADER_DIR for hot reload. expand() does what a GLSL
// compiler does not: #include, and lines that can be traced back to their file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "opacity/core/source.hpp"

namespace opacity::gl {

using Defines = std::vector<std::pair<std::string, std::string>>;
// Virtual names: {"technique.glsl", "techniques/deep_opacity_maps.glsl"}.
using Aliases = std::map<std::string, std::string>;
// Virtual names of files that stand in a namespace: {"camera/technique.glsl", {"camera", path}}.
struct NamespacedFile {
    std::string space, path;
};
using Namespaces = std::map<std::string, NamespacedFile>;

// A shader ready to compile. A line of it is known to the compiler as a line of files[index].
struct ExpandedShader {
    std::string text;
    std::vector<std::string> files;

    // A compiler's messages with "lib/deposit.glsl:12" where the driver wrote "3:12(7)" or "3(12)".
    std::string with_file_names(const std::string& compiler_log) const;
    // The first "file:line" in such messages, or else the first file.
    std::string first_place(const std::string& log) const;

   private:
    std::string with_file_name(std::string_view message) const;
};

class ShaderLibrary {
   public:
    // OPACITY_SHADER_DIR where it is set, or else the embedded table.
    ShaderLibrary();
    // ShaderError where it is no directory. Paths are relative to it.
    explicit ShaderLibrary(std::filesystem::path directory);

    // Moves when the text of any shader may have: a file's time or
    // size is another than at the last look, or add() was called.
    Revision revision();

    // A shader registered at run time; it hides a file of the same path.
    void add(std::string path, std::string text);

    std::vector<std::string> paths() const;
    // ShaderError that suggests the nearest path where there is none of this one.
    std::string text(const std::string& path) const;

    // #version, the defines, then the file with each #include replaced by that
    // file's text. Like #pragma once, an include that comes again adds
    // nothing, unless the first stood in a branch that the preprocessor skips.
    ExpandedShader expand(const std::string& path, const Defines& defines = {},
                          const Aliases& aliases = {}, const Namespaces& spaces = {}) const;

   private:
    class Expansion;
    struct Stamp {
        std::string path;
        std::filesystem::file_time_type time;
        std::uintmax_t size_bytes;
        bool operator==(const Stamp&) const = default;
    };

    bool find(const std::string& path, std::string& text) const;
    std::vector<Stamp> stamps() const;

    std::filesystem::path directory_;  // empty: embedded
    std::map<std::string, std::string> added_;
    std::vector<Stamp> last_look_;
    Revision revision_ = next_revision();
};

}  // namespace opacity::gl
