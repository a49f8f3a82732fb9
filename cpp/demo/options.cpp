#include "options.hpp"

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <string_view>
#include <system_error>

#include "opacity/core/error.hpp"

namespace opacity::demo {

const char* const usage =
    R"(opacity_demo [FILE...]              a window: orbit, move the light, switch technique and layers
opacity_demo [FILE...] --headless -o out.png

  FILE                 .hair, .obj, ..., or demo:NAME (default: demo:hair)
  -o, --output PICTURE save a .png: of the only frame, or of the last one in the window
  --technique NAME     the shadow method
  --param K=V          a parameter of the technique; again for more
  --set K=V            a setting of the renderer: width, height, map_size, antialiasing, ...
  --light X,Y,Z        the direction in which light travels
  --up y               files whose y points up
  --frames N           close the window after N frames

In the window: left drag orbits, right drag moves the light, the wheel zooms; T next technique, + and - layers,
R prints what each pass did, S saves a picture, Escape leaves.
)";

namespace {

// Nothing unless all of the text is one number of this kind.
template <class Number>
std::optional<Number> number_of(const std::string& text) {
    Number number{};
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    return error == std::errc{} && rest == end ? std::optional{number} : std::nullopt;
}

ParamValue value_of(const std::string& text) {
    if (const auto integer = number_of<std::int64_t>(text)) return *integer;
    if (const auto number = number_of<double>(text)) return *number;
    if (text == "true" || text == "false") return text == "true";
    return text;
}

std::pair<std::string, ParamValue> assignment(const std::string& option, const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw ParameterError(option + " " + text + " is not NAME=VALUE",
                             "write it as in " + option + " layers=8");
    return {text.substr(0, equals), value_of(text.substr(equals + 1))};
}

double3 direction_of(const std::string& text) {
    double3 v{};
    int used = 0;
    if (std::sscanf(text.c_str(), "%lf,%lf,%lf%n", &v[0], &v[1], &v[2], &used) != 3 ||
        used != int(text.size()))
        throw ParameterError("--light " + text + " is not three numbers",
                             "write it as in --light .5,.3,-.8");
    return v;
}

bool is_y(const std::string& text) {
    if (text != "y" && text != "z")
        throw ParameterError("--up " + text + " is neither y nor z",
                             "write --up y, or leave it out");
    return text == "y";
}

int frames_of(const std::string& text) {
    constexpr int most = 1'000'000'000;
    const int frames = number_of<int>(text).value_or(0);
    if (frames < 1 || frames > most)
        throw ParameterError("--frames " + text + " is not in 1.." + std::to_string(most),
                             "write how many frames to draw, or leave it out to draw on");
    return frames;
}

struct Option {
    std::string_view name, short_name;
    bool takes_value;
    void (*apply)(Options& options, const std::string& name, const std::string& value);
};

using Text = const std::string&;
constexpr Option table[] = {
    {"--help", "-h", false, [](Options& o, Text, Text) { o.help = true; }},
    {"--headless", "", false, [](Options& o, Text, Text) { o.headless = true; }},
    {"--output", "-o", true, [](Options& o, Text, Text value) { o.output = value; }},
    {"--technique", "", true, [](Options& o, Text, Text value) { o.technique = value; }},
    {"--param", "", true,
     [](Options& o, Text name, Text value) { o.params.push_back(assignment(name, value)); }},
    {"--set", "", true,
     [](Options& o, Text name, Text value) { o.settings.push_back(assignment(name, value)); }},
    {"--light", "", true, [](Options& o, Text, Text value) { o.light = direction_of(value); }},
    {"--up", "", true, [](Options& o, Text, Text value) { o.y_up = is_y(value); }},
    {"--frames", "", true, [](Options& o, Text, Text value) { o.frames = frames_of(value); }},
};

const Option& option_of(const std::string& name) {
    for (const Option& option : table)
        if (name == option.name || name == option.short_name) return option;
    throw ParameterError("there is no option " + name, "opacity_demo --help lists them");
}

}  // namespace

Options parse(int count, const char* const* arguments) {
    Options options;
    for (int i = 1; i < count; ++i) {
        const std::string argument = arguments[i];
        if (!argument.starts_with("-")) {
            options.files.push_back(argument);
            continue;
        }
        const Option& option = option_of(argument);
        if (option.takes_value && ++i >= count)
            throw ParameterError(argument + " needs a value",
                                 "opacity_demo --help lists the options");
        option.apply(options, argument, option.takes_value ? arguments[i] : "");
    }
    if (options.files.empty()) options.files = {"demo:hair"};
    if (options.headless && options.output.empty() && !options.help)
        throw ParameterError("--headless shows nothing",
                             "say where to save the picture: -o out.png");
    return options;
}

}  // namespace opacity::demo
