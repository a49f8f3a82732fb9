#include "options.hpp"

#include <charconv>
#include <cstdio>
#include <cstring>

#include "opacity/core/error.hpp"

namespace opacity::demo {

const char* const usage =
    R"(opacity_demo [FILE...]              a window: orbit, move the light, switch technique and layers
opacity_demo [FILE...] --headless -o out.png

  FILE                 .hair, .obj, or demo:hair (the default)
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

ParamValue value_of(const std::string& text) {
    const char *begin = text.data(), *end = begin + text.size();
    std::int64_t integer = 0;
    if (const auto [rest, error] = std::from_chars(begin, end, integer);
        error == std::errc{} && rest == end)
        return integer;
    double number = 0.0;
    if (const auto [rest, error] = std::from_chars(begin, end, number);
        error == std::errc{} && rest == end)
        return number;
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

}  // namespace

Options parse(int count, const char* const* arguments) {
    Options options;
    for (int i = 1; i < count; ++i) {
        const std::string option = arguments[i];
        const auto next = [&]() -> std::string {
            if (i + 1 >= count)
                throw ParameterError(option + " needs a value",
                                     "opacity_demo --help lists the options");
            return arguments[++i];
        };
        if (option == "--help" || option == "-h")
            options.help = true;
        else if (option == "--headless")
            options.headless = true;
        else if (option == "-o" || option == "--output")
            options.output = next();
        else if (option == "--technique")
            options.technique = next();
        else if (option == "--param")
            options.params.push_back(assignment(option, next()));
        else if (option == "--set")
            options.settings.push_back(assignment(option, next()));
        else if (option == "--light")
            options.light = direction_of(next());
        else if (option == "--up")
            options.y_up = next() == "y";
        else if (option == "--frames")
            options.frames = std::atoi(next().c_str());
        else if (option.starts_with("-"))
            throw ParameterError("there is no option " + option, "opacity_demo --help lists them");
        else
            options.files.push_back(option);
    }
    if (options.files.empty()) options.files = {"demo:hair"};
    if (options.headless && options.output.empty() && !options.help)
        throw ParameterError("--headless shows nothing",
                             "say where to save the picture: -o out.png");
    return options;
}

}  // namespace opacity::demo
