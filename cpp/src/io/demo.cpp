#include "io/demo.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "opacity/core/error.hpp"
#include "opacity/core/nearest_name.hpp"
#include "opacity/io/load.hpp"

namespace opacity {
namespace {

struct Demo {
    std::string name;
    std::string primitive;  // an option of this name says how many
    std::size_t usual, most;
    std::vector<ShapePtr> (*make)(const demo::Request&);
    std::vector<std::string> styles = {};  // the default first
};

const std::vector<Demo>& demos() {
    static const std::vector<Demo> all{
        {"hair", "segments", 150'000, 100'000'000, demo::hair, {"wavy", "straight", "curly"}},
        {"fur", "segments", 400'000, 100'000'000, demo::fur},
        {"grass", "segments", 90'000, 100'000'000, demo::grass},
        {"dense_grass", "segments", 500'000, 100'000'000, demo::dense_grass},
        {"tree", "leaves", 30'000, 10'000'000, demo::tree},
        {"sparse_tree", "leaves", 3'000, 10'000'000, demo::sparse_tree},
        {"smoke", "voxels", 250'000, 100'000'000, demo::smoke},
        {"clouds", "voxels", 500'000, 100'000'000, demo::clouds},
        {"plume", "particles", 16'000, 100'000'000, demo::plume},
        {"teapot", "segments", 300'000, 100'000'000, demo::teapot},
        {"mixed", "primitives", 100'000, 100'000'000, demo::mixed},
    };
    return all;
}

// The place of a name in a list, or a ParameterError that suggests one.
std::size_t place(const std::vector<std::string>& names, std::string_view name,
                  const std::string& noun) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return std::size_t(found - names.begin());
    std::string list;
    for (const std::string& known : names) list += (list.empty() ? "" : ", ") + known;
    throw ParameterError("there is no " + noun + " \"" + std::string{name} + "\"",
                         "did you mean \"" + nearest_name(name, names) + "\"? There are: " + list);
}

std::uint64_t whole_number(std::string_view text, const std::string& option, std::uint64_t least,
                           std::uint64_t most) {
    const char* end = text.data() + text.size();
    std::uint64_t value = 0;
    const auto [stop, failure] = std::from_chars(text.data(), end, value);
    const bool whole = failure == std::errc{} && stop == end;
    if (!whole || value < least || value > most)
        throw ParameterError(
            option + " = \"" + std::string{text} + "\"",
            "write a whole number in " + std::to_string(least) + ".." + std::to_string(most));
    return value;
}

void assign(demo::Request& request, const Demo& demo, std::string_view option,
            std::string_view text) {
    std::vector<std::string> options{demo.primitive, "seed"};
    if (!demo.styles.empty()) options.push_back("style");
    const std::size_t which = place(options, option, "option of this demo");
    const std::string full_name = "demo:" + demo.name + " " + options[which];
    if (which == 0)
        request.count = whole_number(text, full_name, 1, demo.most);
    else if (which == 1)
        request.seed = static_cast<unsigned>(
            whole_number(text, full_name, 0, std::numeric_limits<unsigned>::max()));
    else
        request.style = demo.styles[place(demo.styles, text, "style of this demo")];
}

}  // namespace

double demo::Request::size(double least, double most) const {
    return std::clamp(std::sqrt(double(usual) / double(count)), least, most);
}

std::vector<ShapePtr> demo::load(std::string_view request) {
    const std::size_t question = request.find('?');
    const Demo& demo = demos()[place(demo_names(), request.substr(0, question), "demo")];
    Request asked{demo.usual, demo.usual, 1};
    if (!demo.styles.empty()) asked.style = demo.styles.front();
    std::string_view left = question == request.npos ? "" : request.substr(question + 1);
    while (!left.empty()) {
        const std::string_view pair = left.substr(0, left.find('&'));
        left.remove_prefix(std::min(pair.size() + 1, left.size()));
        const std::size_t equals = std::min(pair.find('='), pair.size());
        assign(asked, demo, pair.substr(0, equals), pair.substr(std::min(equals + 1, pair.size())));
    }
    return demo.make(asked);
}

std::vector<std::string> demo_names() {
    std::vector<std::string> names;
    for (const Demo& demo : demos()) names.push_back(demo.name);
    return names;
}

}  // namespace opacity
