#include "gl/shader_library.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

#include "gl/embedded_shaders.hpp"
#include "gl/glsl_namespace.hpp"
#include "opacity/core/error.hpp"
#include "opacity/core/nearest_name.hpp"
#include "opacity/core/param.hpp"

namespace opacity::gl {
namespace {

namespace fs = std::filesystem;

fs::path directory_from_environment() {
    const char* variable = std::getenv("OPACITY_SHADER_DIR");
    return variable ? variable : "";
}

[[noreturn]] void reject_path(const std::string& where, const std::string& path,
                              const std::vector<std::string>& known) {
    const std::string nearest = nearest_name(path, known);
    throw ShaderError(where + "there is no shader \"" + path + "\"",
                      nearest.empty()
                          ? "add one: the shader library is empty"
                          : "did you mean \"" + nearest + "\"? Paths start at the library's root");
}

std::string trimmed(const std::string& line) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos) return {};
    return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
}

// The word after '#', and the rest of the line; both empty where the line is no directive.
std::pair<std::string, std::string> directive(const std::string& line) {
    const std::string text = trimmed(line);
    if (!text.starts_with('#')) return {};
    const std::string body = trimmed(text.substr(1));
    const auto end =
        std::find_if_not(body.begin(), body.end(), [](unsigned char c) { return std::isalpha(c); });
    return {std::string{body.begin(), end}, trimmed(std::string{end, body.end()})};
}

}  // namespace

// ---- where text comes from ----

ShaderLibrary::ShaderLibrary() : ShaderLibrary{directory_from_environment()} {}

ShaderLibrary::ShaderLibrary(fs::path directory) : directory_{std::move(directory)} {
    std::error_code ignored;
    if (!directory_.empty() && !fs::is_directory(directory_, ignored)) {
        throw ShaderError(
            "the shader directory \"" + directory_.string() + "\" does not exist",
            "set OPACITY_SHADER_DIR to the project's cpp/shaders, or unset it to use the "
            "shaders that are built in");
    }
    last_look_ = stamps();
}

std::vector<ShaderLibrary::Stamp> ShaderLibrary::stamps() const {
    std::vector<Stamp> found;
    if (directory_.empty()) return found;
    // Error codes throughout: an editor may take a file away between two calls.
    std::error_code error;
    for (fs::recursive_directory_iterator file{directory_, error}, end; !error && file != end;
         file.increment(error)) {
        if (file->path().extension() != ".glsl") continue;
        std::error_code gone;
        const auto time = file->last_write_time(gone);
        const auto size_bytes = file->file_size(gone);
        if (!gone)
            found.push_back(
                {file->path().lexically_relative(directory_).generic_string(), time, size_bytes});
    }
    std::sort(found.begin(), found.end(),
              [](const Stamp& a, const Stamp& b) { return a.path < b.path; });
    return found;
}

Revision ShaderLibrary::revision() {
    std::vector<Stamp> now = stamps();
    if (now != last_look_) {
        last_look_ = std::move(now);
        revision_ = next_revision();
    }
    return revision_;
}

void ShaderLibrary::add(std::string path, std::string text) {
    std::string& place = added_[std::move(path)];
    if (place == text) return;
    place = std::move(text);
    revision_ = next_revision();
}

std::vector<std::string> ShaderLibrary::paths() const {
    std::vector<std::string> found;
    for (const auto& [path, text] : added_) found.push_back(path);
    for (const Stamp& stamp : stamps()) found.push_back(stamp.path);
    if (directory_.empty()) {
        for (const EmbeddedShader& shader : embedded_shaders()) found.emplace_back(shader.path);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

bool ShaderLibrary::find(const std::string& path, std::string& text) const {
    if (const auto added = added_.find(path); added != added_.end()) {
        text = added->second;
        return true;
    }
    if (directory_.empty()) {
        for (const EmbeddedShader& shader : embedded_shaders()) {
            if (shader.path == path) return text = shader.text, true;
        }
        return false;
    }
    std::error_code ignored;
    if (!fs::is_regular_file(directory_ / path, ignored)) return false;
    std::ifstream file{directory_ / path, std::ios::binary};
    text.assign(std::istreambuf_iterator<char>{file}, {});
    return file.is_open();
}

std::string ShaderLibrary::text(const std::string& path) const {
    std::string text;
    if (!find(path, text)) reject_path("", path, paths());
    return text;
}

// ---- expansion ----

// One run of expand(). Every included file is wrapped in an #ifndef guard rather than left out
// the second time: a technique's file includes the same library in several #ifdef PASS_<name>
// branches, and only the preprocessor knows which of them is the first that counts.
class ShaderLibrary::Expansion {
   public:
    Expansion(const ShaderLibrary& library, const Aliases& aliases, const Namespaces& spaces,
              ExpandedShader& result)
        : library_{library},
          aliases_{aliases},
          spaces_{spaces},
          result_{result},
          settled_(result.files.size(), false),
          open_(result.files.size(), false) {}

    void file(const std::string& name, const std::string& where, bool always_seen) {
        if (spaces_.contains(name)) return namespaced(spaces_.at(name), where);
        const std::string path = aliases_.contains(name) ? aliases_.at(name) : name;
        std::string text;
        if (!library_.find(path, text)) reject_path(where, path, known_names());
        const std::size_t index = index_of(path);
        if (settled_[index] || open_[index]) return;
        const std::string guard = "INCLUDED_FILE_" + std::to_string(index);
        result_.text += "#ifndef " + guard + "\n#define " + guard + "\n";
        // Open: in a cycle of includes, the guard is defined already. Settled: nothing encloses
        // it that could be skipped, so that later includes of it need not be written at all.
        open_[index] = true;
        lines(text, path, index, always_seen);
        open_[index] = false;
        settled_[index] = always_seen;
        result_.text += "#endif\n";
    }

   private:
    // Expanded apart: what stands outside of the namespace already is not what stands in it.
    void namespaced(const NamespacedFile& included, const std::string& where) {
        ExpandedShader inside{"", result_.files};
        Expansion{library_, aliases_, {}, inside}.file(included.path, where, false);
        result_.files = inside.files;
        settled_.resize(result_.files.size(), false);
        open_.resize(result_.files.size(), false);
        result_.text += text_in_namespace(inside.text, included.space);
    }

    void lines(const std::string& text, const std::string& path, std::size_t index,
               bool always_seen) {
        std::istringstream stream{text};
        std::string line;
        int branches = 0;
        line_directive(1, index);
        for (int number = 1; std::getline(stream, line); ++number) {
            const auto [word, rest] = directive(line);
            if (word == "include") {
                const std::string where = path + ":" + std::to_string(number) + ": ";
                file(included_name(rest, where), where, always_seen && branches == 0);
                line_directive(number + 1, index);
                continue;
            }
            if (word == "if" || word == "ifdef" || word == "ifndef") ++branches;
            if (word == "endif") --branches;
            // Only the whole has a version; a file may have one for its editor's sake.
            result_.text += (word == "version" ? "" : line) + "\n";
            // A skipped branch skips #line, but the lines of its includes count.
            if (word == "endif" || word == "else" || word == "elif")
                line_directive(number + 1, index);
        }
    }

    static std::string included_name(const std::string& rest, const std::string& where) {
        const std::size_t end =
            rest.size() > 1 && rest[0] == '"' ? rest.find('"', 1) : std::string::npos;
        if (end != std::string::npos) return rest.substr(1, end - 1);
        throw ShaderError(where + "#include " + rest + " has no file name in quotes",
                          "write #include \"lib/name.glsl\"");
    }

    void line_directive(int next_line, std::size_t index) {
        result_.text += "#line " + std::to_string(next_line) + " " + std::to_string(index) + "\n";
    }

    std::size_t index_of(const std::string& path) {
        auto& files = result_.files;
        const auto found = std::find(files.begin(), files.end(), path);
        const auto index = std::size_t(found - files.begin());
        if (found == files.end()) {
            files.push_back(path);
            settled_.push_back(false);
            open_.push_back(false);
        }
        return index;
    }

    std::vector<std::string> known_names() const {
        std::vector<std::string> names = library_.paths();
        for (const auto& [name, path] : aliases_) names.push_back(name);
        return names;
    }

    const ShaderLibrary& library_;
    const Aliases& aliases_;
    const Namespaces& spaces_;
    ExpandedShader& result_;
    std::vector<bool> settled_, open_;  // for each of result_.files
};

ExpandedShader ShaderLibrary::expand(const std::string& path, const Defines& defines,
                                     const Aliases& aliases, const Namespaces& spaces) const {
    ExpandedShader result;
    result.text = "#version 450 core\n";
    for (const auto& [name, value] : defines) {
        result.text += "#define " + name + (value.empty() ? "" : " " + value) + "\n";
    }
    Expansion{*this, aliases, spaces, result}.file(path, "", true);
    return result;
}

// ---- messages ----

namespace {

// Takes a number off the front; -1 where there is none.
int take_number(std::string_view& text) {
    int number = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || number < 0) return -1;
    text.remove_prefix(std::size_t(end - text.data()));
    return number;
}

}  // namespace

std::string ExpandedShader::with_file_name(std::string_view message) const {
    const std::string_view severity = message.starts_with("ERROR: ")     ? "ERROR: "
                                      : message.starts_with("WARNING: ") ? "WARNING: "
                                                                         : "";
    std::string_view rest = message.substr(severity.size());
    const int index = take_number(rest);
    if (index < 0 || std::size_t(index) >= files.size()) return std::string{message};
    // Mesa "0:12(3): error", NVIDIA "0(12) : error", others "ERROR: 0:12: ".
    if (!rest.starts_with(':') && !rest.starts_with('(')) return std::string{message};
    rest.remove_prefix(1);
    const int line = take_number(rest);
    if (line < 0) return std::string{message};
    if (rest.starts_with('(')) rest.remove_prefix(std::min(rest.find(')'), rest.size()));
    if (rest.starts_with(')')) rest.remove_prefix(1);
    return std::string{severity} + files[std::size_t(index)] + ":" + std::to_string(line) +
           std::string{rest};
}

std::string ExpandedShader::with_file_names(const std::string& compiler_log) const {
    std::istringstream stream{compiler_log};
    std::string line, result;
    while (std::getline(stream, line)) result += with_file_name(line) + "\n";
    return result;
}

std::string ExpandedShader::first_place(const std::string& log) const {
    std::size_t first = std::string::npos;
    std::string place = files.front();
    for (const std::string& file : files) {
        const std::size_t at = log.find(file + ":");
        if (at >= first) continue;
        first = at;
        const std::size_t digits = at + file.size() + 1;
        place =
            log.substr(at, std::min(log.find_first_not_of("0123456789", digits), log.size()) - at);
    }
    return place;
}

}  // namespace opacity::gl
