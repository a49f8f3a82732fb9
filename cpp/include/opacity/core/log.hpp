// Where messages go that are not errors: OpenGL's debug output, what a context search tried, what a
// model lacks.
#pragma once

#include <functional>
#include <string_view>

namespace opacity {

enum class LogLevel { debug, info, warning, error };

// Called on the thread that renders or loads; must not throw. An empty Logger drops every message.
using Logger = std::function<void(LogLevel, std::string_view message)>;

}  // namespace opacity
