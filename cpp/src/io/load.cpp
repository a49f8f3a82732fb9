#include "opacity/io/load.hpp"

#include <charconv>
#include <functional>
#include <limits>

#include "io/file.hpp"
#include "opacity/core/error.hpp"
#include "opacity/core/nearest_name.hpp"
#include "opacity/core/param.hpp"

namespace opacity {
namespace {

struct Format {
    const char* suffix;
    std::vector<ShapePtr> (*load)(const std::filesystem::path&, const Logger&);
};
// Of a format that is one file, without a second that could be missing.
template <std::vector<ShapePtr> (*read)(const std::filesystem::path&)>
std::vector<ShapePtr> alone(const std::filesystem::path& path, const Logger&) {
    return read(path);
}
constexpr Format formats[] = {
    {".hair", alone<load_hair>}, {".obj", load_obj}, {".gltf", load_gltf}, {".glb", load_gltf}};

struct DemoOption {
    const char* name;
    std::uint64_t value, min, max;
};
struct Demo {
    const char* name;
    std::vector<DemoOption> options;
    std::function<std::vector<ShapePtr>(const std::vector<DemoOption>&)> make;
};

std::vector<Demo> demos() {
    constexpr std::uint64_t largest_seed = std::numeric_limits<unsigned>::max();
    return {{"hair",
             {{"segments", 150'000, 1, 100'000'000}, {"seed", 1, 0, largest_seed}},
             [](const std::vector<DemoOption>& options) {
                 return demo_hair(options[0].value, static_cast<unsigned>(options[1].value));
             }}};
}

// The entry of this name, or a ParameterError that suggests one.
template <class Entry>
Entry& named(std::vector<Entry>& entries, std::string_view name, const std::string& noun) {
    std::vector<std::string> names;
    std::string list;
    for (Entry& entry : entries) {
        if (name == entry.name) return entry;
        names.emplace_back(entry.name);
        list += (list.empty() ? "" : ", ") + names.back();
    }
    throw ParameterError("there is no " + noun + " \"" + std::string{name} + "\"",
                         "did you mean \"" + nearest_name(name, names) + "\"? There are: " + list);
}

void assign(DemoOption& option, std::string_view text, const std::string& demo) {
    const char* end = text.data() + text.size();
    std::uint64_t value = 0;
    const auto [stop, failure] = std::from_chars(text.data(), end, value);
    const bool whole = failure == std::errc{} && stop == end;
    if (!whole || value < option.min || value > option.max)
        throw ParameterError(
            "demo:" + demo + " " + option.name + " = \"" + std::string{text} + "\"",
            "write a whole number in " + std::to_string(option.min) + ".." +
                std::to_string(option.max));
    option.value = value;
}

// hair?segments=1000000&seed=7
std::vector<ShapePtr> make_demo(std::string_view request) {
    std::vector<Demo> all = demos();
    const std::size_t question = request.find('?');
    Demo& demo = named(all, request.substr(0, question), "demo");
    std::string_view left = question == request.npos ? "" : request.substr(question + 1);
    while (!left.empty()) {
        const std::string_view pair = left.substr(0, left.find('&'));
        left.remove_prefix(std::min(pair.size() + 1, left.size()));
        const std::size_t equals = std::min(pair.find('='), pair.size());
        DemoOption& option = named(demo.options, pair.substr(0, equals), "option of this demo");
        assign(option, pair.substr(std::min(equals + 1, pair.size())), demo.name);
    }
    return demo.make(demo.options);
}

}  // namespace

std::vector<ShapePtr> load(const std::string& path_or_name, const Logger& log) {
    constexpr std::string_view demo_prefix = "demo:";
    if (path_or_name.starts_with(demo_prefix))
        return make_demo(std::string_view{path_or_name}.substr(demo_prefix.size()));
    const std::string suffix = lower_suffix(path_or_name);
    std::string list;
    for (const Format& format : formats) {
        if (suffix == format.suffix) return format.load(path_or_name, log);
        list += std::string{list.empty() ? "" : ", "} + format.suffix;
    }
    throw FileFormatError(path_or_name + " has a suffix that is not read: \"" + suffix + "\"",
                          "convert it to one of " + list + ", or pass demo:hair");
}

}  // namespace opacity
