// A context and what OpenGL said about its use.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "opacity/gl/context.hpp"

namespace opacity::bindings {

// Messages wait here until Python asks for them: a logger that called Python from the middle of a
// frame would need the interpreter while others wait for this thread.
class Messages {
   public:
    using List = std::vector<std::pair<LogLevel, std::string>>;

    void add(LogLevel level, std::string_view message) noexcept;
    List take();

   private:
    static constexpr std::size_t most_ =
        1000;  // a driver that complains at every draw must not fill the memory
    std::mutex mutex_;
    List list_;
};

struct LoggedContext {
    std::shared_ptr<gl::Context> context;
    std::shared_ptr<Messages> messages;

    static LoggedContext headless();
};

}  // namespace opacity::bindings
