// What the engine says without failing.
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "opacity/core/log.hpp"

namespace opacity::bindings {

// Messages wait here until Python asks for them: a logger that called Python from the middle of a
// frame would need the interpreter while others wait for this thread.
class Messages {
   public:
    void add(LogLevel level, std::string_view message) noexcept;
    // Those since the last call: (level, message) each.
    pybind11::list take();

   private:
    static constexpr std::size_t most_ =
        1000;  // a driver that complains at every draw must not fill the memory
    std::mutex mutex_;
    std::vector<std::pair<LogLevel, std::string>> list_;
};

}  // namespace opacity::bindings
