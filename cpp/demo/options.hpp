// The command line of opacity_demo.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "opacity/core/math.hpp"
#include "opacity/core/param.hpp"

namespace opacity::demo {

struct Options {
    std::vector<std::string> files = {};
    std::string output = {};  // where to save the picture; needed when headless
    std::string technique = "bounding_opacity_maps";
    std::vector<std::pair<std::string, ParamValue>> params = {};    // of the technique
    std::vector<std::pair<std::string, ParamValue>> settings = {};  // of the renderer
    std::optional<double3> light = {};
    bool y_up = false;
    bool headless = false;
    bool help = false;
    int frames = 0;  // close the window after so many; 0: when the user does
};

// ParameterError for what it cannot understand.
Options parse(int count, const char* const* arguments);
extern const char* const usage;

}  // namespace opacity::demo
