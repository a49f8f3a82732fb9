#include "opacity/plugin.hpp"

#include <dlfcn.h>

#include <mutex>
#include <set>
#include <string_view>
#include <utility>

#include "techniques/registry.hpp"

namespace opacity {
namespace {

constexpr const char* entry_point = "opacity_plugin";
constexpr const char* build_again =
    "build it again against this engine: cmake -Dopacity_DIR=$(pyopacity --cmake-dir)";

// Closed again unless it is kept.
class OpenLibrary {
   public:
    explicit OpenLibrary(const std::filesystem::path& path)
        : handle_{dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)} {
        if (handle_) return;
        const char* reason = dlerror();
        throw PluginError(path.string() + " does not open as a shared library: " +
                              (reason ? reason : "the system does not say why"),
                          std::string{"pass what the plugin's build made, or "} + build_again);
    }
    OpenLibrary(const OpenLibrary&) = delete;
    OpenLibrary& operator=(const OpenLibrary&) = delete;
    ~OpenLibrary() {
        if (handle_) dlclose(handle_);
    }

    const Plugin* plugin() const {
        const auto entry = reinterpret_cast<const Plugin* (*)()>(dlsym(handle_, entry_point));
        return entry ? entry() : nullptr;
    }
    void keep() { handle_ = nullptr; }

   private:
    void* handle_;
};

void check(const Plugin* plugin, const std::string& file) {
    if (!plugin)
        throw PluginError(file + " is no plugin: it has no function " + entry_point,
                          "make it with opacity_add_plugin in its CMakeLists.txt, or write "
                          "OPACITY_PLUGIN in one of its files");
    if (plugin->interface != std::string_view{OPACITY_INTERFACE})
        throw PluginError(file + " was built against the headers of pyopacity " +
                              plugin->interface + "; this engine is " OPACITY_INTERFACE,
                          build_again);
    // Two copies would count their revisions apart, and take different content for the same.
    if (plugin->engine != &next_revision)
        throw PluginError(file + " is linked to another copy of the engine than this process uses",
                          build_again);
}

std::unique_ptr<Technique> make_checked(const PluginTechnique& description,
                                        const std::string& file) {
    std::unique_ptr<Technique> technique = description.make();
    if (technique && technique->name() == description.name) return technique;
    const std::string made = technique ? "\"" + technique->name() + "\"" : "nothing";
    throw PluginError(file + " makes " + made + " for the name \"" + description.name + "\"",
                      "give Technique's constructor the name that OPACITY_PLUGIN has");
}

}  // namespace

std::vector<std::string> load_plugin(const std::filesystem::path& path) {
    std::error_code ignored;
    const std::string file = path.string();
    if (!std::filesystem::is_regular_file(path, ignored))
        throw PluginError("there is no file " + file,
                          "pass the path of the shared library that the plugin's build made");
    OpenLibrary library{std::filesystem::absolute(path)};  // else only system folders are searched
    const Plugin* plugin = library.plugin();
    check(plugin, file);

    std::vector<RegisteredTechnique> techniques;
    std::vector<std::string> names;
    for (const PluginTechnique& technique : std::span{plugin->techniques, plugin->count}) {
        names.emplace_back(technique.name);
        techniques.push_back({technique.name, technique.shader,
                              [&technique, file] { return make_checked(technique, file); }});
    }
    static std::mutex mutex;
    static std::set<const Plugin*> loaded;
    const std::lock_guard lock{mutex};
    if (loaded.contains(plugin)) return names;
    try {
        register_techniques(std::move(techniques));
    } catch (const ParameterError& error) {
        throw PluginError(file + ": " + error.problem(), error.fix());
    }
    loaded.insert(plugin);
    library.keep();
    return names;
}

}  // namespace opacity
